// SPDX-License-Identifier: Apache-2.0
// The two functions of docs/numbers.md that are looked up. The entries are files of hexadecimal
// numbers, which degs_rtl_tables writes from the tables of the model.

// The root of 1 - x for x in 0 .. 1, in three stages. `paper`: 256 values in FP16. `tuned`: 1 - x
// moves by pairs of bits to 1/4 .. 1, where 32 cells have a value and a rise in uq1.15.
module root_table #(
  parameter TUNED = 0, parameter integer XB = TUNED ? 19 : 16
) (
  input logic clk, input logic [XB-1:0] x,
  output logic signed [9:0] exponent, output logic [15:0] mantissa
);
  generate
    if (TUNED) begin : linear
      logic [15:0] values [0:31], rises [0:31];
      initial $readmemh("tuned_root_values.hex", values);
      initial $readmemh("tuned_root_rises.hex", rises);
      // 1: the distance to 1, and its place among the cells, which are 3/128 wide.
      wire [18:0] left = 19'h40000 - x;
      logic [3:0] pairs;
      integer i;
      always @* begin
        pairs = 9;
        for (i = 0; i < 9; i = i + 1) if (left[2*i +: 2] != 0) pairs = 8 - i;
        if (left[18]) pairs = 0;
      end
      wire [18:0] reduced = (left << {pairs, 1'b0}) - 19'h10000; // 0 .. 3/4
      wire [6:0] thirds = reduced[17:11];                        // of a cell
      wire [12:0] division = thirds * 6'd43;                     // by 3, for 0 .. 127
      wire [4:0] cell_now = thirds == 7'd96 ? 5'd31 : division[11:7];
      logic [4:0] cell_1;
      logic [12:0] part_1; // of 6144
      logic [3:0] pairs_1, pairs_2;
      // 2: the cell, and the product with the part.
      logic [15:0] value_2;
      logic [28:0] rise_2;
      // 3: the product over 6144, rounded; the sum.
      wire [17:0] halves = rise_2[28:11];
      wire [34:0] thirded = halves * 17'd43691;
      wire [15:0] whole = thirded[32:17];
      wire [28:0] rest = rise_2 - whole * 13'd6144;
      wire [15:0] rise = whole + (rest > 3072 || (rest == 3072 && whole[0]));
      always @(posedge clk) begin
        cell_1 <= cell_now;
        part_1 <= reduced - cell_now * 13'd6144;
        pairs_1 <= pairs;
        value_2 <= pairs_1 == 9 ? 16'd0 : values[cell_1];
        rise_2 <= pairs_1 == 9 ? 29'd0 : rises[cell_1] * part_1;
        pairs_2 <= pairs_1;
        mantissa <= value_2 + rise;
        exponent <= -10'sd15 - $signed({6'b0, pairs_2});
      end
    end else begin : nearest
      logic [15:0] values [0:255];
      initial $readmemh("paper_root_values.hex", values);
      localparam [31:0] FP16 = {2'b01, 6'd5, 8'd10, 16'd15};
      // 1: the cell, the whole part of 256 x.
      wire s, n, i;
      wire signed [9:0] e;
      wire [10:0] m;
      unpack #(.FORMAT(FP16)) of_x (x, s, n, i, e, m);
      wire [10:0] cell_now = m >> -(e + 10'sd8);
      logic [7:0] cell_1;
      // 2: its value.
      logic [15:0] value_2;
      // 3: the value in parts.
      wire rs, rn, ri;
      wire signed [9:0] re;
      wire [10:0] rm;
      unpack #(.FORMAT(FP16)) of_root (value_2, rs, rn, ri, re, rm);
      always @(posedge clk) begin
        cell_1 <= cell_now > 255 ? 8'd255 : cell_now[7:0];
        value_2 <= values[cell_1];
        exponent <= re;
        mantissa <= rm;
      end
    end
  endgenerate
endmodule

// alpha, at most 0.99, of q in four stages: exp(-q / 2) in `paper`, 2^-q in `tuned`. The fraction of
// the binary logarithm is looked up in 16 cells with a value and a fall, the whole part shifts.
module exponential_table #(
  parameter TUNED = 0, parameter integer AB = 16
) (input logic clk, input logic [15:0] q, output logic [AB-1:0] alpha);
  localparam [31:0] FP16 = {2'b01, 6'd5, 8'd10, 16'd15};
  localparam [31:0] CONSTANT = {2'b10, 6'd0, 8'd24, 16'd0};                      // uq0.24
  localparam [31:0] VALUES = TUNED ? {2'b10, 6'd1, 8'd15, 16'd0} : FP16;         // uq1.15
  localparam [31:0] PART = {2'b10, 6'd0, TUNED ? 8'd9 : 8'd20, 16'd0};           // uq0.9, uq0.20
  localparam [31:0] ALPHA = TUNED ? {2'b10, 6'd0, 8'd16, 16'd0} : FP16;          // uq0.16
  localparam integer PB = TUNED ? 9 : 20;
  localparam integer VW = TUNED ? 16 : 11;
  localparam [15:0] MOST = TUNED ? 16'd64881 : 16'h3bec;                         // 0.99
  logic [15:0] values [0:15], falls [0:15];
  logic [6:0] whole_now, whole_2, whole_3;
  logic [3:0] cell_now;
  logic [PB-1:0] part_now, part_2;
  logic above_now, above_2, above_3; // alpha above 1
  generate
    if (TUNED) begin : binary
      initial $readmemh("tuned_exponential_values.hex", values);
      initial $readmemh("tuned_exponential_falls.hex", falls);
      // 1: q waits, so that both number sets take as long.
      logic [15:0] q_1;
      always @(posedge clk) q_1 <= q;
      always @* begin
        {whole_now, cell_now, part_now} = q_1;
        above_now = 0;
      end
    end else begin : natural
      initial $readmemh("paper_exponential_values.hex", values);
      initial $readmemh("paper_exponential_falls.hex", falls);
      // 1: q log2(e) / 2.
      wire [15:0] binary;
      product #(.A(FP16), .B(CONSTANT), .TO(FP16)) scale (q, 24'd12102203, binary);
      logic [15:0] binary_1;
      always @(posedge clk) binary_1 <= binary;
      wire s, n, i;
      wire signed [9:0] e;
      wire [10:0] m;
      unpack #(.FORMAT(FP16)) of_binary (binary_1, s, n, i, e, m);
      wire [40:0] fixed = {30'd0, m} << (e + 10'sd24); // units of 2^-24
      always @* begin
        {cell_now, part_now} = fixed[23:0];
        whole_now = i | n | fixed[40:24] > 126 ? 7'd126 : fixed[30:24];
        above_now = s & !n;
      end
    end
  endgenerate
  // 2: the cell. 3: the part of its fall. 4: the difference, shifted and limited.
  logic [15:0] value_2, fall_2, value_3, part_3;
  wire [15:0] part_of_fall, difference;
  product #(.A(VALUES), .B(PART), .TO(VALUES)) interpolate (fall_2, part_2, part_of_fall);
  sum #(.A(VALUES), .B(VALUES), .TO(VALUES), .MINUS(1)) subtract (value_3, part_3, difference);
  wire ds, dn, di;
  wire signed [9:0] de;
  wire [VW-1:0] dm;
  wire [15:0] shifted;
  unpack #(.FORMAT(VALUES)) of_difference (difference, ds, dn, di, de, dm);
  round_to #(.FORMAT(ALPHA), .W(VW)) rounding
    (ds, dn, di, de - $signed({3'b0, whole_3}), dm, shifted);
  always @(posedge clk) begin
    value_2 <= values[cell_now];
    fall_2 <= falls[cell_now];
    part_2 <= part_now;
    whole_2 <= whole_now;
    above_2 <= above_now;
    value_3 <= value_2;
    part_3 <= part_of_fall;
    whole_3 <= whole_2;
    above_3 <= above_2;
    alpha <= above_3 || shifted > MOST ? MOST : shifted;
  end
endmodule
