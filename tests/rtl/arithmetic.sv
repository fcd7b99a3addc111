// SPDX-License-Identifier: Apache-2.0
// Arithmetic in the number formats of docs/numbers.md: the result of every operation is rounded
// once, to nearest, ties to even. A format is a parameter of 32 bits:
//   [31]    1: fixed point, 0: float
//   [30]    1: there is a sign
//   [29:24] integer bits, the sign included, or exponent bits
//   [23:16] fraction bits, or mantissa bits
//   [15:0]  bias of a float
// The default, 32'h450a000f, is FP16.
// Floats have the shape of IEEE 754 with subnormals, infinities and NaN. Fixed formats are two's
// complement and saturate symmetrically. A zero has no sign. Between the units a number is in
// parts: sign, nan, infinite, and mantissa * 2^exponent.

// The parts of a code.
module unpack #(
  parameter [31:0] FORMAT = 32'h450a000f,
  parameter integer BITS = FORMAT[29:24] + FORMAT[23:16] + (FORMAT[31] ? 0 : FORMAT[30]),
  parameter integer W = FORMAT[31] ? BITS : FORMAT[23:16] + 1
) (
  input logic [BITS-1:0] code,
  output logic sign, output logic nan, output logic infinite,
  output logic signed [9:0] exponent, output logic [W-1:0] mantissa
);
  localparam integer E = FORMAT[29:24];
  localparam integer M = FORMAT[23:16];
  localparam integer B = FORMAT[15:0];
  generate
    if (FORMAT[31]) begin : fixed
      assign sign = FORMAT[30] & code[BITS-1];
      assign nan = 0;
      assign infinite = 0;
      assign exponent = -M;
      assign mantissa = sign ? -code : code;
    end else begin : float
      wire [E-1:0] stored = code[M +: E];
      wire last = &stored;
      wire subnormal = stored == 0;
      assign sign = FORMAT[30] & code[BITS-1];
      assign nan = last & (code[M-1:0] != 0);
      assign infinite = last & (code[M-1:0] == 0);
      assign exponent = $signed({1'b0, stored}) + $signed({9'b0, subnormal}) - B - M;
      assign mantissa = {!subnormal, code[M-1:0]};
    end
  endgenerate
endmodule

// The place of the highest bit that is set; 0 if there is none.
module top_bit #(parameter integer W = 16) (input logic [W-1:0] value, output logic [7:0] place);
  integer i;
  always @* begin
    place = 0;
    for (i = 0; i < W; i = i + 1) if (value[i]) place = i;
  end
endmodule

// The code of parts. The lowest bit of the mantissa may stand for all that is finer, if there are
// three bits more than the format keeps.
module round_to #(
  parameter [31:0] FORMAT = 32'h450a000f, parameter integer W = 16,
  parameter integer BITS = FORMAT[29:24] + FORMAT[23:16] + (FORMAT[31] ? 0 : FORMAT[30])
) (
  input logic sign, input logic nan, input logic infinite,
  input logic signed [9:0] exponent, input logic [W-1:0] mantissa, output logic [BITS-1:0] code
);
  localparam integer E = FORMAT[29:24];
  localparam integer M = FORMAT[23:16];
  localparam integer B = FORMAT[15:0];
  wire [7:0] top;
  top_bit #(.W(W)) find_top (.value(mantissa), .place(top));
  generate
    if (FORMAT[31]) begin : fixed
      localparam integer VALUE = BITS - FORMAT[30]; // bits of the magnitude
      localparam integer L = W + 1 + BITS;          // the mantissa at every place that is in range
      localparam [BITS:0] MOST = (1 << VALUE) - 1;
      wire signed [10:0] up = exponent + M; // places to the left, in units of the format
      wire signed [10:0] high = up + $signed({3'b0, top});
      wire [L-1:0] whole = up >= 0 ? {{(BITS + 1){1'b0}}, mantissa} << up
                                   : {{(BITS + 1){1'b0}}, mantissa} >> -up;
      wire half = up < 0 && -up <= W && (mantissa >> (-up - 1)) & 1'b1;
      wire finer = up < -1 && (-up > W ? mantissa != 0 : (mantissa & ~({W{1'b1}} << (-up - 1))) != 0);
      wire [BITS:0] rounded = whole[BITS:0] + {{BITS{1'b0}}, half & (finer | whole[0])};
      wire over = nan | infinite | (mantissa != 0 && high >= VALUE) | rounded > MOST;
      wire [BITS-1:0] magnitude = over ? MOST[BITS-1:0] : rounded[BITS-1:0];
      assign code = !sign || nan ? magnitude : FORMAT[30] ? -magnitude : {BITS{1'b0}};
    end else begin : float
      localparam integer L = W + M + 2;
      wire [L-1:0] left = {mantissa, {(M + 2){1'b0}}} << (W - 1 - top);
      wire signed [10:0] stored = exponent + $signed({3'b0, top}) + B;
      wire signed [10:0] deep = 1 - stored; // places that a subnormal loses
      wire [L-1:0] shifted = deep <= 0 ? left : deep >= L ? {L{1'b0}} : left >> deep;
      wire lost = deep > 0 && (deep >= L ? left != 0 : (left & ~({L{1'b1}} << deep)) != 0);
      wire half = shifted[L-2-M];
      wire finer = lost | shifted[L-3-M:0] != 0;
      wire [M+1:0] rounded = shifted[L-1 -: M+1] + {{(M + 1){1'b0}}, half & (finer | shifted[L-1-M])};
      // A carry out of the mantissa is the next exponent.
      wire signed [10:0] above = deep > 0 ? 11'sd0 : stored - 11'sd1;
      wire [M+11:0] magnitude = ({1'b0, above} << M) + rounded;
      wire over = infinite | magnitude >= {{12{1'b0}}, {(E){1'b1}}, {(M){1'b0}}};
      wire [E+M-1:0] number = nan ? {{(E + 1){1'b1}}, {(M - 1){1'b0}}}
                            : over && (infinite || mantissa != 0) ? {{E{1'b1}}, {M{1'b0}}}
                            : mantissa == 0 ? {(E + M){1'b0}} : magnitude[E+M-1:0];
      if (FORMAT[30]) assign code = {sign & !nan & number != 0, number};
      else assign code = sign & !nan ? {BITS{1'b0}} : number;
    end
  endgenerate
endmodule

// a * b, exactly.
module parts_product #(parameter integer WA = 11, parameter integer WB = 11) (
  input logic a_sign, input logic a_nan, input logic a_infinite,
  input logic signed [9:0] a_exponent, input logic [WA-1:0] a,
  input logic b_sign, input logic b_nan, input logic b_infinite,
  input logic signed [9:0] b_exponent, input logic [WB-1:0] b,
  output logic sign, output logic nan, output logic infinite,
  output logic signed [9:0] exponent, output logic [WA+WB-1:0] mantissa
);
  assign sign = a_sign ^ b_sign;
  assign nan = a_nan | b_nan | (a_infinite & b == 0) | (b_infinite & a == 0);
  assign infinite = (a_infinite | b_infinite) & !nan;
  assign exponent = a_exponent + b_exponent;
  assign mantissa = a * b;
endmodule

// a * b of two formats, rounded to a third.
module product #(
  parameter [31:0] A = 32'h450a000f, parameter [31:0] B = 32'h450a000f,
  parameter [31:0] TO = 32'h450a000f,
  parameter integer BITS_A = A[29:24] + A[23:16] + (A[31] ? 0 : A[30]),
  parameter integer BITS_B = B[29:24] + B[23:16] + (B[31] ? 0 : B[30]),
  parameter integer BITS = TO[29:24] + TO[23:16] + (TO[31] ? 0 : TO[30])
) (input logic [BITS_A-1:0] a, input logic [BITS_B-1:0] b, output logic [BITS-1:0] result);
  localparam integer WA = A[31] ? BITS_A : A[23:16] + 1;
  localparam integer WB = B[31] ? BITS_B : B[23:16] + 1;
  wire as, an, ai, bs, bn, bi, rs, rn, ri;
  wire signed [9:0] ae, be, re;
  wire [WA-1:0] am;
  wire [WB-1:0] bm;
  wire [WA+WB-1:0] rm;
  unpack #(.FORMAT(A)) of_a (a, as, an, ai, ae, am);
  unpack #(.FORMAT(B)) of_b (b, bs, bn, bi, be, bm);
  parts_product #(.WA(WA), .WB(WB)) exact (as, an, ai, ae, am, bs, bn, bi, be, bm, rs, rn, ri, re, rm);
  round_to #(.FORMAT(TO), .W(WA + WB)) rounding (rs, rn, ri, re, rm, result);
endmodule

// Moves a mantissa to the left until its highest bit is set; a zero gets the lowest exponent.
module normalise #(parameter integer WI = 11, parameter integer W = 11) (
  input logic signed [9:0] exponent_in, input logic [WI-1:0] mantissa_in,
  output logic signed [9:0] exponent, output logic [W-1:0] mantissa
);
  wire [7:0] top;
  top_bit #(.W(WI)) find_top (.value(mantissa_in), .place(top));
  wire [W-1:0] wide = mantissa_in;
  assign mantissa = wide << (W - 1 - top);
  assign exponent = mantissa_in == 0 ? -10'sd400 : exponent_in + $signed({2'b0, top}) - (W - 1);
endmodule

// a + b, or a - b, of two formats, rounded to a third.
module sum #(
  parameter [31:0] A = 32'h450a000f, parameter [31:0] B = 32'h450a000f,
  parameter [31:0] TO = 32'h450a000f, parameter integer MINUS = 0,
  parameter integer BITS_A = A[29:24] + A[23:16] + (A[31] ? 0 : A[30]),
  parameter integer BITS_B = B[29:24] + B[23:16] + (B[31] ? 0 : B[30]),
  parameter integer BITS = TO[29:24] + TO[23:16] + (TO[31] ? 0 : TO[30])
) (input logic [BITS_A-1:0] a, input logic [BITS_B-1:0] b, output logic [BITS-1:0] result);
  generate
    if (A[31] && B[31]) begin : fixed // an adder of integers, in the finer unit
      localparam integer F = A[23:16] > B[23:16] ? A[23:16] : B[23:16];
      localparam integer I = A[29:24] > B[29:24] ? A[29:24] : B[29:24];
      localparam integer W = F + I + 2;
      wire signed [W-1:0] left = $signed({A[30] & a[BITS_A-1], a}) <<< (F - A[23:16]);
      wire signed [W-1:0] right = $signed({B[30] & b[BITS_B-1], b}) <<< (F - B[23:16]);
      wire signed [W-1:0] both = MINUS ? left - right : left + right;
      wire [W-1:0] magnitude = both < 0 ? -both : both;
      localparam signed [9:0] UNIT = -F;
      round_to #(.FORMAT(TO), .W(W)) rounding (both < 0, 1'b0, 1'b0, UNIT, magnitude, result);
    end else begin : float // the smaller one is moved to the exponent of the larger one
      localparam integer WA = A[31] ? BITS_A : A[23:16] + 1;
      localparam integer WB = B[31] ? BITS_B : B[23:16] + 1;
      localparam integer K = TO[23:16] + (TO[31] ? TO[29:24] : 1);
      localparam integer WX = WA > WB ? WA : WB;
      localparam integer W = (WX > K ? WX : K) + 3; // three bits for what is finer
      wire as, an, ai, bs, bn, bi;
      wire signed [9:0] ae, be, xe, ye;
      wire [WA-1:0] am;
      wire [WB-1:0] bm;
      wire [W-1:0] x, y;
      unpack #(.FORMAT(A)) of_a (a, as, an, ai, ae, am);
      unpack #(.FORMAT(B)) of_b (b, bs, bn, bi, be, bm);
      normalise #(.WI(WA), .W(W)) normal_a (ae, am, xe, x);
      normalise #(.WI(WB), .W(W)) normal_b (be, bm, ye, y);
      wire b_sign = MINUS ? !bs : bs;
      wire swap = ye > xe || (ye == xe && y > x);
      wire signed [9:0] e = swap ? ye : xe;
      wire [9:0] away = swap ? ye - xe : xe - ye;
      wire [W-1:0] larger = swap ? y : x;
      wire [W-1:0] smaller = swap ? x : y;
      wire [W-1:0] moved = away >= W ? {W{1'b0}} : smaller >> away;
      wire lost = away >= W ? smaller != 0 : (smaller & ~({W{1'b1}} << away)) != 0;
      wire [W-1:0] aligned = {moved[W-1:1], moved[0] | lost};
      wire [W:0] both = as == b_sign ? {1'b0, larger} + {1'b0, aligned} : {1'b0, larger} - {1'b0, aligned};
      wire nan = an | bn | (ai & bi & as != b_sign);
      round_to #(.FORMAT(TO), .W(W + 1)) rounding
        (ai ? as : bi ? b_sign : swap ? b_sign : as, nan, ai | bi, e, both, result);
    end
  endgenerate
endmodule

// Is a larger than b? Both are without a sign.
module exceeds #(parameter integer WA = 11, parameter integer WB = 11, parameter integer W = WA > WB ? WA : WB) (
  input logic signed [9:0] a_exponent, input logic [WA-1:0] a,
  input logic signed [9:0] b_exponent, input logic [WB-1:0] b, output logic result
);
  wire signed [9:0] xe, ye;
  wire [W-1:0] x, y;
  normalise #(.WI(WA), .W(W)) normal_a (a_exponent, a, xe, x);
  normalise #(.WI(WB), .W(W)) normal_b (b_exponent, b, ye, y);
  assign result = xe > ye || (xe == ye && x > y);
endmodule

// What only travels along for some stages.
module travel #(parameter integer BITS = 16, parameter integer STAGES = 1) (
  input logic clk, input logic [BITS-1:0] from, output logic [BITS-1:0] to
);
  logic [STAGES*BITS-1:0] at;
  generate
    if (STAGES == 1) always @(posedge clk) at <= from;
    else always @(posedge clk) at <= {at[(STAGES-1)*BITS-1:0], from};
  endgenerate
  assign to = at[STAGES*BITS-1 -: BITS];
endmodule
