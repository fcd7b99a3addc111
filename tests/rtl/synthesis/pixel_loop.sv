// SPDX-License-Identifier: Apache-2.0
// The two loops of a pixel, for one colour: what comes out of the Pixel Buffer and goes back into it.
// T and `live` depend on T and alpha alone; a sum is read when its addend is there, two stages after
// T, and depends on it alone. Between the two are products that are in no loop, between registers of
// their own. The longer loop is what the reuse distance has to hold beside the Pixel Buffer.
module pixel_loop #(
  parameter TUNED = 0,
  parameter integer SB = TUNED ? 22 : 16, parameter integer TB = TUNED ? 18 : 16
) (
  input logic clk,
  input logic [15:0] alpha_in, input logic [15:0] colour_in, input logic inside_in, input logic live_in,
  input logic [TB-1:0] t_in, input logic [SB-1:0] sum_in,
  output logic live, output logic [TB-1:0] t, output logic [SB-1:0] sum_out
);
  localparam [31:0] FP16 = {2'b01, 6'd5, 8'd10, 16'd15};
  localparam [31:0] ALPHA = TUNED ? {2'b10, 6'd0, 8'd16, 16'd0} : FP16;
  localparam [31:0] T = TUNED ? {2'b10, 6'd0, 8'd18, 16'd0} : FP16;
  localparam [31:0] T_1 = TUNED ? {2'b10, 6'd1, 8'd18, 16'd0} : FP16;
  localparam [31:0] SUM = TUNED ? {2'b10, 6'd6, 8'd16, 16'd0} : FP16;
  localparam [31:0] COLOUR = TUNED ? {2'b00, 6'd4, 8'd12, 16'd8} : FP16;
  localparam [31:0] ONE = {2'b10, 6'd1, 8'd0, 16'd0};
  localparam integer T1B = TUNED ? 19 : 16;
  localparam [TB-1:0] LIVES = TUNED ? 18'd27 : 16'h068e;
  logic [15:0] alpha_before, alpha, colour;
  logic is_inside, lives, blends_1, blends_2;
  logic [TB-1:0] t_before;
  logic [SB-1:0] sum_before, weight_now, share_now;
  logic [TB-1:0] rest_now;
  wire [T1B-1:0] whole;
  wire [SB-1:0] weight, share, more;
  wire [TB-1:0] rest, after;
  generate
    if (TUNED) assign whole = {lives & t_before == 0, t_before};
    else assign whole = t_before;
  endgenerate
  // Before the loops.
  sum #(.A(ONE), .B(ALPHA), .TO(T), .MINUS(1)) of_rest (1'b1, alpha_before, rest);
  // T.
  product #(.A(T_1), .B(T), .TO(T)) of_after (whole, rest_now, after);
  wire stops = lives & after < LIVES;
  wire blends = is_inside & lives & !stops;
  // What is added.
  product #(.A(ALPHA), .B(T_1), .TO(SUM)) of_weight (alpha, whole, weight);
  product #(.A(SUM), .B(COLOUR), .TO(SUM)) of_share (weight_now, colour, share);
  // A sum.
  sum #(.A(SUM), .B(SUM), .TO(SUM)) of_more (sum_before, share_now, more);
  always @(posedge clk) begin
    alpha_before <= alpha_in; colour <= colour_in; is_inside <= inside_in; lives <= live_in;
    t_before <= t_in; sum_before <= sum_in;
    alpha <= alpha_before; rest_now <= rest;
    live <= lives & !(is_inside & stops);
    t <= blends ? after : t_before;
    weight_now <= weight;
    share_now <= share; blends_1 <= blends; blends_2 <= blends_1;
    sum_out <= blends_2 ? more : sum_before;
  end
endmodule
