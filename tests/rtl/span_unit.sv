// SPDX-License-Identifier: Apache-2.0
// A Span Unit (docs/span-unit.md) in the number sets `paper` and `tuned` (docs/numbers.md): image
// row y of a splat inside a tile gives the Span Vector. It takes a row in every cycle and gives its
// result 15 cycles later. Distances have the format of the mean; all else is in the list below.
module span_unit #(
  parameter TUNED = 0, // 0: `paper`, ends rounded outward with delta from dw/dy; 1: `tuned`
  parameter integer XI = TUNED ? 18 : 16, parameter integer XF = TUNED ? 12 : 8,
  parameter integer XB = XI + XF,
  parameter integer SB = TUNED ? 24 : 16, parameter integer RB = TUNED ? 20 : 16
) (
  input logic clk, input logic valid,
  input logic signed [XI-1:0] y, input logic signed [XI-1:0] x_begin, // px of the image
  input logic [7:0] columns,                                          // of the tile, 1 .. 128
  // the splat record; q_uncut is Q_th before a cut, from which the opacity follows
  input logic [XB-1:0] mean_x, input logic [XB-1:0] mean_y, input logic [SB-1:0] slope,
  input logic [RB-1:0] radius, input logic [RB-1:0] inverse, input logic [15:0] conic,
  input logic [15:0] c_prime, input logic [RB-1:0] q_threshold, input logic [RB-1:0] q_uncut,
  output logic found, output logic [6:0] x0, output logic [7:0] length, output logic [6:0] base,
  output logic [15:0] g0, output logic [15:0] d0
);
  localparam [31:0] FP16 = {2'b01, 6'd5, 8'd10, 16'd15};
  localparam [31:0] WHOLE = {2'b11, XI[5:0], 8'd0, 16'd0};
  localparam [31:0] PX = {2'b11, XI[5:0], XF[7:0], 16'd0};
  localparam [31:0] SLOPE = TUNED ? {2'b01, 6'd6, 8'd17, 16'd31} : FP16;
  localparam [31:0] RADIUS = TUNED ? {2'b00, 6'd5, 8'd15, 16'd14} : FP16;
  localparam [31:0] INVERSE = TUNED ? {2'b00, 6'd6, 8'd14, 16'd50} : {2'b01, 6'd6, 8'd9, 16'd31};
  localparam [31:0] CONIC = TUNED ? {2'b00, 6'd5, 8'd11, 16'd29} : {2'b01, 6'd6, 8'd9, 16'd31};
  localparam [31:0] Q_TH = TUNED ? {2'b10, 6'd3, 8'd17, 16'd0} : FP16;
  localparam [31:0] SQUARE = {2'b01, 6'd6, TUNED ? 8'd12 : 8'd10, 16'd31};
  localparam [31:0] RATIO = TUNED ? {2'b10, 6'd1, 8'd18, 16'd0} : FP16;
  localparam [31:0] LEVEL = TUNED ? {2'b10, 6'd4, 8'd16, 16'd0} : FP16;
  localparam [31:0] G0 = TUNED ? {2'b10, 6'd3, 8'd13, 16'd0} : FP16;
  localparam [31:0] D0 = TUNED ? {2'b01, 6'd4, 8'd11, 16'd11} : FP16;
  localparam [31:0] ONE = {2'b10, 6'd1, 8'd0, 16'd0};                // a single bit
  localparam [31:0] TWICE = {2'b11, XI[5:0] + 6'd1, XF[7:0] - 8'd1, 16'd0};
  localparam integer QB = TUNED ? 19 : 17; // bits of SQUARE
  localparam integer TB = TUNED ? 19 : 16; // of RATIO
  localparam integer LB = TUNED ? 20 : 16; // of LEVEL
  localparam integer RW = TUNED ? 16 : 11; // of the mantissa of r_x

  // 1: dy.
  wire [XB-1:0] dy_now, dy_2;
  logic [XB-1:0] dy_1;
  sum #(.A(WHOLE), .B(PX), .TO(PX), .MINUS(1)) of_dy (y, mean_y, dy_now);
  travel #(.BITS(XB)) dy_to_2 (clk, dy_1, dy_2);

  // 2: dy / r_y^2 and m dy.
  wire [RB-1:0] inverse_1;
  wire [SB-1:0] slope_1;
  wire [QB-1:0] scaled_now;
  wire [XB-1:0] shift_now;
  logic [QB-1:0] scaled_2;
  logic [XB-1:0] shift_2;
  travel #(.BITS(RB)) inverse_to_1 (clk, inverse, inverse_1);
  travel #(.BITS(SB)) slope_to_1 (clk, slope, slope_1);
  product #(.A(PX), .B(INVERSE), .TO(SQUARE)) of_scaled (dy_1, inverse_1, scaled_now);
  product #(.A(SLOPE), .B(PX), .TO(PX)) of_shift (slope_1, dy_1, shift_now);

  // 3: x = dy^2 / r_y^2 and the centre.
  wire [XB-1:0] mean_x_2, centre_now;
  wire [TB-1:0] x_now;
  logic [TB-1:0] x_3;
  logic [XB-1:0] centre_3;
  travel #(.BITS(XB), .STAGES(2)) mean_x_to_2 (clk, mean_x, mean_x_2);
  product #(.A(SQUARE), .B(PX), .TO(RATIO)) of_x (scaled_2, dy_2, x_now);
  sum #(.A(PX), .B(PX), .TO(PX)) of_centre (mean_x_2, shift_2, centre_now);

  // 4, 5, 6: the root of 1 - x; a row with x > 1 misses the ellipse.
  wire meets_now = x_3 <= (TUNED ? 19'h40000 : 16'h3c00);
  wire meets_8;
  wire signed [9:0] root_e_6;
  wire [15:0] root_6;
  travel #(.BITS(1), .STAGES(5)) meets_to_8 (clk, meets_now, meets_8);
  root_table #(.TUNED(TUNED)) of_root (clk, x_3, root_e_6, root_6);

  // 7: w = r_x times the root, and delta.
  wire [RB-1:0] radius_6;
  wire r_sign, r_nan, r_infinite, w_sign, w_nan, w_infinite;
  wire signed [9:0] r_e, w_e;
  wire [RW-1:0] r_m;
  wire [RW+15:0] w_m;
  wire [XB-1:0] width_now;
  logic [XB-1:0] width_7;
  wire [XB-1:0] centre_7;
  wire delta_now;
  logic delta_7, delta_8;
  travel #(.BITS(RB), .STAGES(6)) radius_to_6 (clk, radius, radius_6);
  travel #(.BITS(XB), .STAGES(4)) centre_to_7 (clk, centre_3, centre_7);
  unpack #(.FORMAT(RADIUS)) of_radius (radius_6, r_sign, r_nan, r_infinite, r_e, r_m);
  parts_product #(.WA(RW), .WB(16)) of_width
    (r_sign, r_nan, r_infinite, r_e, r_m, 1'b0, 1'b0, 1'b0, root_e_6, root_6,
     w_sign, w_nan, w_infinite, w_e, w_m);
  round_to #(.FORMAT(PX), .W(RW + 16)) round_width (w_sign, w_nan, w_infinite, w_e, w_m, width_now);

  // 8: the ends, px.
  wire [XB-1:0] left_now, right_now, centre_8;
  logic signed [XB-1:0] left_8, right_8;
  travel #(.BITS(XB)) centre_to_8 (clk, centre_7, centre_8);
  sum #(.A(PX), .B(PX), .TO(PX), .MINUS(1)) of_left (centre_7, width_7, left_now);
  sum #(.A(PX), .B(PX), .TO(PX)) of_right (centre_7, width_7, right_now);

  // 9: whole pixels, cut at the columns of the tile.
  wire signed [XI-1:0] x_begin_8;
  wire [7:0] columns_8;
  wire signed [XI+1:0] floor_left = left_8 >>> XF;
  wire signed [XI+1:0] floor_right = right_8 >>> XF;
  wire signed [XI+1:0] first_pixel = TUNED ? floor_left + (left_8[XF-1:0] != 0) : floor_left - delta_8;
  wire signed [XI+1:0] last_pixel = TUNED ? floor_right
                                          : floor_right + (right_8[XF-1:0] != 0) + delta_8;
  wire signed [XI+1:0] first_column = x_begin_8;
  wire signed [XI+1:0] last_column = x_begin_8 + $signed({1'b0, columns_8}) - 1;
  wire signed [XI+1:0] first_now = first_pixel > first_column ? first_pixel : first_column;
  wire signed [XI+1:0] last_now = last_pixel < last_column ? last_pixel : last_column;
  logic signed [XI+1:0] first_9, last_9;
  logic found_9, found_10;
  travel #(.BITS(XI), .STAGES(8)) x_begin_to_8 (clk, x_begin, x_begin_8);
  travel #(.BITS(8), .STAGES(8)) columns_to_8 (clk, columns, columns_8);
  wire valid_8;
  travel #(.BITS(1), .STAGES(8)) valid_to_8 (clk, valid, valid_8);

  // 10: the pixel of n = 0: the first one in `paper`, the nearest to the centre in `tuned`.
  wire signed [XB-1:0] centre_9;
  wire signed [XI-1:0] x_begin_9;
  wire half = centre_9[XF-1];
  wire finer = centre_9[XF-2:0] != 0;
  wire signed [XI+1:0] floor_centre = centre_9 >>> XF;
  wire signed [XI+1:0] nearest = floor_centre + (half & (finer | floor_centre[0]));
  wire signed [XI+1:0] base_now = !TUNED || nearest < first_9 ? first_9
                                : nearest > last_9 ? last_9 : nearest;
  logic signed [XI-1:0] base_10;
  logic [6:0] x0_10, offset_10;
  logic [7:0] length_10;
  travel #(.BITS(XB)) centre_to_9 (clk, centre_8, centre_9);
  travel #(.BITS(XI)) x_begin_to_9 (clk, x_begin_8, x_begin_9);

  // 11: u, its distance from the centre.
  wire [XB-1:0] centre_10, u_now, u_12;
  logic [XB-1:0] u_11;
  travel #(.BITS(XB)) centre_to_10 (clk, centre_9, centre_10);
  sum #(.A(WHOLE), .B(PX), .TO(PX), .MINUS(1)) of_u (base_10, centre_10, u_now);
  travel #(.BITS(XB)) u_to_12 (clk, u_11, u_12);

  // 12: A u and 2u + 1.
  wire [15:0] conic_11, conic_12;
  wire [QB-1:0] slanted_now, odd_now;
  logic [QB-1:0] slanted_12, odd_12;
  travel #(.BITS(16), .STAGES(11)) conic_to_11 (clk, conic, conic_11);
  travel #(.BITS(16)) conic_to_12 (clk, conic_11, conic_12);
  product #(.A(CONIC), .B(PX), .TO(SQUARE)) of_slanted (conic_11, u_11, slanted_now);
  sum #(.A(TWICE), .B(ONE), .TO(SQUARE)) of_odd (u_11, 1'b1, odd_now);

  // 13: A u^2 and d0.
  wire [QB-1:0] rise_now;
  logic [QB-1:0] rise_13;
  wire [15:0] d0_now;
  logic [15:0] d0_13;
  product #(.A(SQUARE), .B(PX), .TO(SQUARE)) of_rise (slanted_12, u_12, rise_now);
  product #(.A(CONIC), .B(SQUARE), .TO(D0)) of_d0 (conic_12, odd_12, d0_now);

  // 14: g0 in the format of its terms. 15: g0 in its own.
  wire [LB-1:0] level_13, start_now;
  logic [LB-1:0] start_14;
  wire [15:0] g0_now;
  wire l_sign, l_nan, l_infinite;
  wire signed [9:0] l_e;
  wire [(TUNED ? 20 : 11)-1:0] l_m;
  sum #(.A(SQUARE), .B(LEVEL), .TO(LEVEL)) of_start (rise_13, level_13, start_now);
  unpack #(.FORMAT(LEVEL)) of_level (start_14, l_sign, l_nan, l_infinite, l_e, l_m);
  round_to #(.FORMAT(G0), .W(TUNED ? 20 : 11)) round_g0 (l_sign, l_nan, l_infinite, l_e, l_m, g0_now);
  travel #(.BITS(16), .STAGES(2)) d0_to_15 (clk, d0_13, d0);
  travel #(.BITS(23), .STAGES(5)) span_to_15
    (clk, {found_10, x0_10, length_10, offset_10}, {found, x0, length, base});

  always @(posedge clk) begin
    dy_1 <= dy_now;
    scaled_2 <= scaled_now;
    shift_2 <= shift_now;
    x_3 <= x_now;
    centre_3 <= centre_now;
    width_7 <= width_now;
    delta_7 <= delta_now;
    delta_8 <= delta_7;
    left_8 <= left_now;
    right_8 <= right_now;
    first_9 <= first_now;
    last_9 <= last_now;
    found_9 <= valid_8 & meets_8 & first_now <= last_now;
    found_10 <= found_9;
    base_10 <= base_now[XI-1:0];
    x0_10 <= first_9 - x_begin_9;
    length_10 <= last_9 - first_9 + 1;
    offset_10 <= base_now - x_begin_9;
    u_11 <= u_now;
    slanted_12 <= slanted_now;
    odd_12 <= odd_now;
    rise_13 <= rise_now;
    d0_13 <= d0_now;
    start_14 <= start_now;
    g0 <= g0_now;
  end

  // What the row's q' is at the vertex, beside the stages above.
  generate
    if (TUNED) begin : from_ratio // limit - Q_th (1 - x), where the limit is log2 255 unless cut
      localparam [31:0] LIMIT = {2'b10, 6'd3, 8'd24, 16'd0};
      localparam [31:0] CUT = {2'b11, 6'd4, 8'd17, 16'd0};
      // 1: how much a cut takes away. 2: the limit. 4: 1 - x. 5: Q_th (1 - x). 6: the difference.
      wire [20:0] cut_now;
      wire [19:0] limit_now, limit_5, fall_now, level_now;
      wire [18:0] left_of_x;
      wire [RB-1:0] q_threshold_4;
      logic [20:0] cut_1;
      logic [19:0] limit_2, fall_5, level_6;
      logic [18:0] left_4;
      sum #(.A(Q_TH), .B(Q_TH), .TO(CUT), .MINUS(1)) of_cut (q_uncut, q_threshold, cut_now);
      sum #(.A(LIMIT), .B(CUT), .TO(LEVEL), .MINUS(1)) of_limit (27'd134122994, cut_1, limit_now);
      sum #(.A(ONE), .B(RATIO), .TO(RATIO), .MINUS(1)) of_left_of_x (1'b1, x_3, left_of_x);
      product #(.A(Q_TH), .B(RATIO), .TO(LEVEL)) of_fall (q_threshold_4, left_4, fall_now);
      sum #(.A(LEVEL), .B(LEVEL), .TO(LEVEL), .MINUS(1)) of_level_6 (limit_5, fall_5, level_now);
      travel #(.BITS(RB), .STAGES(4)) q_threshold_to_4 (clk, q_threshold, q_threshold_4);
      travel #(.BITS(20), .STAGES(3)) limit_to_5 (clk, limit_2, limit_5);
      travel #(.BITS(20), .STAGES(7)) level_to_13 (clk, level_6, level_13);
      always @(posedge clk) begin
        cut_1 <= cut_now;
        limit_2 <= limit_now;
        left_4 <= left_of_x;
        fall_5 <= fall_now;
        level_6 <= level_now;
      end
      assign delta_now = 0;
    end else begin : stepwise // C' dy^2 - 2 ln o
      // 1: - 2 ln o = 2 ln 255 - Q_th. 2: C' dy. 3: C' dy^2. 4: the sum.
      wire [15:0] fold_now, fold_3, c_prime_1, vertical_now, level_now;
      wire [QB-1:0] steep_now;
      logic [15:0] fold_1, vertical_3, level_4;
      logic [QB-1:0] steep_2;
      sum #(.A(FP16), .B(FP16), .TO(FP16), .MINUS(1)) of_fold (16'h498b, q_uncut, fold_now);
      product #(.A(PX), .B(INVERSE), .TO(SQUARE)) of_steep (dy_1, c_prime_1, steep_now);
      product #(.A(SQUARE), .B(PX), .TO(LEVEL)) of_vertical (steep_2, dy_2, vertical_now);
      sum #(.A(LEVEL), .B(LEVEL), .TO(LEVEL)) of_level_4 (vertical_3, fold_3, level_now);
      travel #(.BITS(16)) c_prime_to_1 (clk, c_prime, c_prime_1);
      travel #(.BITS(16), .STAGES(2)) fold_to_3 (clk, fold_1, fold_3);
      travel #(.BITS(16), .STAGES(9)) level_to_13 (clk, level_4, level_13);
      // delta is 1 where |dw/dy| = r_x |dy| / (r_y^2 root) exceeds 256, half a unit of the mean
      // being 1/512 px (exactly half a pixel is rounded to 0); no product is rounded.
      // 5: r_x |dy|. 6: over r_y^2. 7: the comparison.
      wire [XB-1:0] dy_4;
      wire [RB-1:0] radius_4, inverse_5;
      wire ys, yn, yi, vs, vn, vi, cs, cn, ci, ps, pn, pi, ts, tn, ti;
      wire signed [9:0] ye, ve, ce, pe, te;
      wire [XB-1:0] ym;
      wire [10:0] vm;
      wire [XB+10:0] pm;
      wire [9:0] cm;
      wire [XB+20:0] tm;
      logic n_5, i_5, n_6, i_6;
      logic signed [9:0] e_5, e_6;
      logic [XB+10:0] m_5;
      logic [XB+20:0] m_6;
      wire beyond;
      travel #(.BITS(XB), .STAGES(2)) dy_to_4 (clk, dy_2, dy_4);
      travel #(.BITS(RB), .STAGES(4)) radius_to_4 (clk, radius, radius_4);
      travel #(.BITS(RB), .STAGES(4)) inverse_to_5 (clk, inverse_1, inverse_5);
      unpack #(.FORMAT(PX)) of_dy_4 (dy_4, ys, yn, yi, ye, ym);
      unpack #(.FORMAT(RADIUS)) of_radius_4 (radius_4, vs, vn, vi, ve, vm);
      parts_product #(.WA(XB), .WB(11)) first_product
        (ys, yn, yi, ye, ym, vs, vn, vi, ve, vm, ps, pn, pi, pe, pm);
      unpack #(.FORMAT(INVERSE)) of_inverse_5 (inverse_5, cs, cn, ci, ce, cm);
      parts_product #(.WA(XB + 11), .WB(10)) second_product
        (1'b0, n_5, i_5, e_5, m_5, cs, cn, ci, ce, cm, ts, tn, ti, te, tm);
      exceeds #(.WA(XB + 21), .WB(16)) of_delta (e_6, m_6, root_e_6 + 10'sd8, root_6, beyond);
      assign delta_now = n_6 | i_6 | beyond;
      always @(posedge clk) begin
        fold_1 <= fold_now;
        steep_2 <= steep_now;
        vertical_3 <= vertical_now;
        level_4 <= level_now;
        {n_5, i_5, e_5, m_5} <= {pn, pi, pe, pm};
        {n_6, i_6, e_6, m_6} <= {tn, ti, te, tm};
      end
    end
  endgenerate
endmodule
