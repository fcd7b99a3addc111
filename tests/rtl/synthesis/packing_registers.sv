// SPDX-License-Identifier: Apache-2.0
// packing_unit.sv between registers.
module packing_registers #(
  parameter ISSUE = 2, parameter WIDTH = 8, parameter SEG = 16, parameter TAG = 16, parameter WRITES = 1,
  parameter COMPLETE = (WIDTH - 1 + SEG) / WIDTH > WRITES ? (WIDTH - 1 + SEG) / WIDTH : WRITES,
  parameter LANES = (COMPLETE + 1) * WIDTH, parameter TASK = TAG + 5
) (
  input logic clk, input logic rst_in,
  input logic [ISSUE-1:0] i_valid_in, input logic [ISSUE*SEG-1:0] i_mask_in, input logic [ISSUE*TAG-1:0] i_tag_in,
  input logic flush_in,
  output logic [COMPLETE:0] p_valid, output logic [(COMPLETE+1)*8-1:0] p_tasks,
  output logic [LANES*TASK-1:0] p_lanes, output logic [7:0] unwritten
);
  logic rst, flush;
  logic [ISSUE-1:0] i_valid;
  logic [ISSUE*SEG-1:0] i_mask;
  logic [ISSUE*TAG-1:0] i_tag;
  wire [COMPLETE:0] valid_now;
  wire [(COMPLETE+1)*8-1:0] tasks_now;
  wire [LANES*TASK-1:0] lanes_now;
  wire [7:0] unwritten_now;
  packing_unit #(.ISSUE(ISSUE), .WIDTH(WIDTH), .SEG(SEG), .TAG(TAG), .WRITES(WRITES)) unit (
    .clk(clk), .rst(rst), .i_valid(i_valid), .i_mask(i_mask), .i_tag(i_tag), .flush(flush),
    .p_valid(valid_now), .p_tasks(tasks_now), .p_lanes(lanes_now), .unwritten(unwritten_now));
  always_ff @(posedge clk) begin
    rst <= rst_in; flush <= flush_in; i_valid <= i_valid_in; i_mask <= i_mask_in; i_tag <= i_tag_in;
    p_valid <= valid_now; p_tasks <= tasks_now; p_lanes <= lanes_now; unwritten <= unwritten_now;
  end
endmodule
