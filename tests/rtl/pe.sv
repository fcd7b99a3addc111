// SPDX-License-Identifier: Apache-2.0
// A PE of the Blending Array (docs/blending-array.md) in the number sets `paper` and `tuned`
// (docs/numbers.md). It takes a task in every cycle; the Pixel Buffer outside gives the pixel's
// state 8 cycles later and gets it back 3 cycles after that, which is the loop of a pixel. T of
// `tuned` is stored modulo 1: 0 stands for 1 while the pixel lives, and for 0 once it has ended.
module pe #(
  parameter TUNED = 0,
  parameter integer AB = 16, parameter integer SB = TUNED ? 22 : 16, parameter integer TB = TUNED ? 18 : 16
) (
  input logic clk, input logic valid,
  input logic [15:0] g0, input logic [15:0] d0, // Span Vector
  input logic signed [7:0] n,                   // px from the base of the span
  input logic [15:0] conic, input logic [15:0] q_inside, // A, and the largest q' inside
  input logic [15:0] red, input logic [15:0] green, input logic [15:0] blue,
  input logic stops_after, // stop rule `after`; else `refuse`
  // state of the pixel, 8 cycles after the task
  input logic live_8, input logic [TB-1:0] t_8,
  input logic [SB-1:0] red_8, input logic [SB-1:0] green_8, input logic [SB-1:0] blue_8,
  // 11 cycles after the task: the class of the task, the state, and the end of the pixel
  output logic useful, output logic boundary, output logic terminated, output logic ended,
  output logic live, output logic [TB-1:0] t,
  output logic [SB-1:0] red_sum, output logic [SB-1:0] green_sum, output logic [SB-1:0] blue_sum
);
  localparam [31:0] FP16 = {2'b01, 6'd5, 8'd10, 16'd15};
  localparam [31:0] CONIC = TUNED ? {2'b00, 6'd5, 8'd11, 16'd29} : {2'b01, 6'd6, 8'd9, 16'd31};
  localparam [31:0] G0 = TUNED ? {2'b10, 6'd3, 8'd13, 16'd0} : FP16;
  localparam [31:0] D0 = TUNED ? {2'b01, 6'd4, 8'd11, 16'd11} : FP16;
  localparam [31:0] TERM = TUNED ? {2'b11, 6'd5, 8'd13, 16'd0} : FP16;
  localparam [31:0] Q = G0;
  localparam [31:0] ALPHA = TUNED ? {2'b10, 6'd0, 8'd16, 16'd0} : FP16;
  localparam [31:0] T = TUNED ? {2'b10, 6'd0, 8'd18, 16'd0} : FP16;     // what is stored
  localparam [31:0] T_1 = TUNED ? {2'b10, 6'd1, 8'd18, 16'd0} : FP16;   // with the 1 that is not
  localparam [31:0] SUM = TUNED ? {2'b10, 6'd6, 8'd16, 16'd0} : FP16;   // and weights
  localparam [31:0] COLOUR = TUNED ? {2'b00, 6'd4, 8'd12, 16'd8} : FP16;
  localparam [31:0] ONE = {2'b10, 6'd1, 8'd0, 16'd0};                   // a single bit
  localparam [31:0] LOW = {2'b11, 6'd5, 8'd0, 16'd0};                   // four bits and a sign
  localparam [31:0] REST = {2'b11, 6'd9, 8'd0, 16'd0};
  localparam [31:0] LOW_SQUARE = {2'b10, 6'd4, 8'd0, 16'd0};
  localparam [31:0] REST_SQUARE = {2'b10, 6'd15, 8'd0, 16'd0};
  localparam integer MB = TUNED ? 18 : 16; // bits of a term
  localparam integer T1B = TUNED ? 19 : 16;
  // 1e-4: the smallest code of T that does not stop a pixel.
  localparam [TB-1:0] LIVES = TUNED ? 18'd27 : 16'h068e;

  // 1: the half-lookup multipliers: products with the low four bits of |n| and of n(n-1), and with
  // what is left of them.
  wire [7:0] magnitude = n < 0 ? -n : n;
  wire [8:0] rest_magnitude = {1'b0, magnitude[7:4], 4'd0};
  wire [4:0] low_n = n < 0 ? -{1'b0, magnitude[3:0]} : {1'b0, magnitude[3:0]};
  wire [8:0] rest_n = n < 0 ? -rest_magnitude : rest_magnitude;
  wire [14:0] square = $signed({{8{n[7]}}, n}) * ($signed({{8{n[7]}}, n}) - 16'sd1);
  wire [MB-1:0] d0_low, d0_rest, a_low, a_rest;
  logic [MB-1:0] d0_low_1, d0_rest_1, a_low_1, a_rest_1;
  product #(.A(D0), .B(LOW), .TO(TERM)) of_d0_low (d0, low_n, d0_low);
  product #(.A(D0), .B(REST), .TO(TERM)) of_d0_rest (d0, rest_n, d0_rest);
  product #(.A(CONIC), .B(LOW_SQUARE), .TO(TERM)) of_a_low (conic, square[3:0], a_low);
  product #(.A(CONIC), .B(REST_SQUARE), .TO(TERM)) of_a_rest (conic, {square[14:4], 4'd0}, a_rest);

  // 2: n d0 and A n(n-1).
  wire [MB-1:0] linear, quadratic;
  logic [MB-1:0] linear_2, quadratic_2;
  sum #(.A(TERM), .B(TERM), .TO(TERM)) of_linear (d0_low_1, d0_rest_1, linear);
  sum #(.A(TERM), .B(TERM), .TO(TERM)) of_quadratic (a_low_1, a_rest_1, quadratic);

  // 3, 4: q. `paper` adds from the left, `tuned` adds both terms first.
  wire [15:0] g0_2, q_now;
  logic [15:0] q_4;
  travel #(.BITS(16), .STAGES(2)) g0_to_2 (clk, g0, g0_2);
  generate
    if (TUNED) begin : from_vertex
      wire [MB-1:0] both;
      logic [MB-1:0] both_3;
      logic [15:0] g0_3;
      sum #(.A(TERM), .B(TERM), .TO(TERM)) of_both (linear_2, quadratic_2, both);
      sum #(.A(G0), .B(TERM), .TO(Q)) of_q (g0_3, both_3, q_now);
      always @(posedge clk) begin
        both_3 <= both;
        g0_3 <= g0_2;
      end
    end else begin : from_start
      wire [15:0] partly;
      logic [15:0] partly_3, quadratic_3;
      sum #(.A(G0), .B(TERM), .TO(Q)) of_partly (g0_2, linear_2, partly);
      sum #(.A(Q), .B(TERM), .TO(Q)) of_q (partly_3, quadratic_3, q_now);
      always @(posedge clk) begin
        partly_3 <= partly;
        quadratic_3 <= quadratic_2;
      end
    end
  endgenerate

  // 5, 6, 7, 8: alpha; is the pixel inside? Codes of positive floats are in the order of values.
  wire [15:0] alpha_8, q_inside_4;
  wire is_inside = TUNED ? q_4 <= q_inside_4 : q_4[15] ? q_4[14:0] <= 15'h7c00 : q_4 <= q_inside_4;
  wire inside_10, valid_10;
  travel #(.BITS(16), .STAGES(4)) q_inside_to_4 (clk, q_inside, q_inside_4);
  travel #(.BITS(1), .STAGES(6)) inside_to_10 (clk, is_inside, inside_10);
  travel #(.BITS(1), .STAGES(10)) valid_to_10 (clk, valid, valid_10);
  exponential_table #(.TUNED(TUNED)) of_alpha (clk, q_4, alpha_8);

  // 9: the state of the pixel arrives: alpha T and 1 - alpha.
  wire [T1B-1:0] t_whole;
  wire [SB-1:0] weight;
  wire [TB-1:0] rest;
  logic [SB-1:0] weight_9;
  logic [TB-1:0] rest_9;
  logic [T1B-1:0] t_9;
  generate
    if (TUNED) assign t_whole = {live_8 & t_8 == 0, t_8};
    else assign t_whole = t_8;
  endgenerate
  product #(.A(ALPHA), .B(T_1), .TO(SUM)) of_weight (alpha_8, t_whole, weight);
  sum #(.A(ONE), .B(ALPHA), .TO(T), .MINUS(1)) of_rest (1'b1, alpha_8, rest);

  // 10: T (1 - alpha) and alpha T times the colour.
  wire [TB-1:0] after;
  wire [SB-1:0] red_now, green_now, blue_now;
  wire [47:0] colours_9;
  logic [TB-1:0] after_10;
  logic [SB-1:0] red_10, green_10, blue_10;
  travel #(.BITS(48), .STAGES(9)) colours_to_9 (clk, {red, green, blue}, colours_9);
  product #(.A(T_1), .B(T), .TO(T)) of_after (t_9, rest_9, after);
  product #(.A(SUM), .B(COLOUR), .TO(SUM)) of_red (weight_9, colours_9[47:32], red_now);
  product #(.A(SUM), .B(COLOUR), .TO(SUM)) of_green (weight_9, colours_9[31:16], green_now);
  product #(.A(SUM), .B(COLOUR), .TO(SUM)) of_blue (weight_9, colours_9[15:0], blue_now);

  // 11: the sums, the end of the pixel, and what is written back.
  wire live_10, stops_after_10;
  wire [TB-1:0] before_10;
  wire [SB-1:0] red_before, green_before, blue_before, red_more, green_more, blue_more;
  wire stops = live_10 & after_10 < LIVES;
  wire blends = live_10 & (stops_after_10 | !stops);
  travel #(.BITS(1), .STAGES(10)) stops_after_to_10 (clk, stops_after, stops_after_10);
  travel #(.BITS(1), .STAGES(2)) live_to_10 (clk, live_8, live_10);
  travel #(.BITS(TB), .STAGES(2)) t_to_10 (clk, t_8, before_10);
  travel #(.BITS(3 * SB), .STAGES(2)) sums_to_10
    (clk, {red_8, green_8, blue_8}, {red_before, green_before, blue_before});
  sum #(.A(SUM), .B(SUM), .TO(SUM)) of_red_sum (red_before, red_10, red_more);
  sum #(.A(SUM), .B(SUM), .TO(SUM)) of_green_sum (green_before, green_10, green_more);
  sum #(.A(SUM), .B(SUM), .TO(SUM)) of_blue_sum (blue_before, blue_10, blue_more);

  always @(posedge clk) begin
    d0_low_1 <= d0_low;
    d0_rest_1 <= d0_rest;
    a_low_1 <= a_low;
    a_rest_1 <= a_rest;
    linear_2 <= linear;
    quadratic_2 <= quadratic;
    q_4 <= q_now;
    weight_9 <= weight;
    rest_9 <= rest;
    t_9 <= t_whole;
    after_10 <= after;
    red_10 <= red_now;
    green_10 <= green_now;
    blue_10 <= blue_now;
    useful <= valid_10 & inside_10 & blends;
    boundary <= valid_10 & !inside_10;
    terminated <= valid_10 & inside_10 & !blends;
    ended <= valid_10 & stops;
    live <= live_10 & !(valid_10 & stops);
    t <= valid_10 & blends ? after_10 : before_10;
    red_sum <= valid_10 & blends ? red_more : red_before;
    green_sum <= valid_10 & blends ? green_more : green_before;
    blue_sum <= valid_10 & blends ? blue_more : blue_before;
  end
endmodule
