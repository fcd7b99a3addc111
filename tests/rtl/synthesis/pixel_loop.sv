// SPDX-License-Identifier: Apache-2.0
// The loop of a pixel: stages 9 to 11 of pe.sv without the registers between them, so that the delay
// between the registers at both ends is what the reuse distance has to hold beside the Pixel Buffer.
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
  logic [15:0] alpha, colour;
  logic is_inside, lives;
  logic [TB-1:0] t_before;
  logic [SB-1:0] sum_before;
  wire [T1B-1:0] whole;
  wire [SB-1:0] weight, share, more;
  wire [TB-1:0] rest, after;
  generate
    if (TUNED) assign whole = {lives & t_before == 0, t_before};
    else assign whole = t_before;
  endgenerate
  product #(.A(ALPHA), .B(T_1), .TO(SUM)) of_weight (alpha, whole, weight);
  sum #(.A(ONE), .B(ALPHA), .TO(T), .MINUS(1)) of_rest (1'b1, alpha, rest);
  product #(.A(T_1), .B(T), .TO(T)) of_after (whole, rest, after);
  product #(.A(SUM), .B(COLOUR), .TO(SUM)) of_share (weight, colour, share);
  sum #(.A(SUM), .B(SUM), .TO(SUM)) of_more (sum_before, share, more);
  wire stops = lives & after < LIVES;
  wire blends = is_inside & lives & !stops;
  always @(posedge clk) begin
    alpha <= alpha_in; colour <= colour_in; is_inside <= inside_in; lives <= live_in;
    t_before <= t_in; sum_before <= sum_in;
    live <= lives & !(is_inside & stops);
    t <= blends ? after : t_before;
    sum_out <= blends ? more : sum_before;
  end
endmodule
