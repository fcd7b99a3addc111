// SPDX-License-Identifier: Apache-2.0
// A Packing Unit in registers: compacts the masks of the segments that its Issue Bank issues behind
// the tasks of the open packet, the lowest pixels first, and gives complete packets
// (docs/packing-unit.md). The bank decides what fits, so that at most `COMPLETE` packets become
// complete in a cycle; they are written WRITES per cycle.
module packing_unit #(
  parameter ISSUE = 2, parameter WIDTH = 8, parameter SEG = 16,
  parameter TAG = 32,     // bits of a task beside its pixel inside the segment
  parameter WRITES = 1,
  parameter COMPLETE = (WIDTH - 1 + SEG) / WIDTH > WRITES ? (WIDTH - 1 + SEG) / WIDTH : WRITES,
  parameter LANES = (COMPLETE + 1) * WIDTH, parameter TASK = TAG + 5
) (
  input logic clk, input logic rst,
  input logic [ISSUE-1:0] i_valid, input logic [ISSUE*SEG-1:0] i_mask, input logic [ISSUE*TAG-1:0] i_tag,
  input logic flush,
  // packets of this cycle, complete ones first; the last one may be the flushed one
  output logic [COMPLETE:0] p_valid, output logic [(COMPLETE+1)*8-1:0] p_tasks,
  output logic [LANES*TASK-1:0] p_lanes,
  output logic [7:0] unwritten // complete packets that have not been written before this cycle
);
  logic [TASK-1:0] open [0:WIDTH-1];
  logic [7:0] tasks, waiting;
  logic [TASK-1:0] lane [0:LANES-1];
  logic [7:0] base, rank, complete;
  integer j, k, l, p;

  always_comb begin
    for (l = 0; l < LANES; l++) begin
      lane[l] = 0;
      if (l < WIDTH && l < tasks) lane[l] = open[l % WIDTH];
    end
    base = tasks;
    for (k = 0; k < ISSUE; k++) begin
      rank = base; // a task's place is the number of tasks before it: a prefix sum
      for (j = 0; j < SEG; j++)
        if (i_valid[k] && i_mask[k*SEG+j]) begin
          for (l = 0; l < LANES; l++) if (rank == l) lane[l] = lane[l] | {i_tag[k*TAG +: TAG], j[4:0]};
          rank = rank + 1;
        end
      base = rank;
    end
    complete = base / WIDTH;
    for (p = 0; p <= COMPLETE; p++) begin
      p_valid[p] = p < complete || (flush && p == complete && base % WIDTH != 0);
      p_tasks[p*8 +: 8] = p < complete ? WIDTH : base % WIDTH;
    end
    for (l = 0; l < LANES; l++) p_lanes[l*TASK +: TASK] = lane[l];
    unwritten = waiting > WRITES ? waiting - WRITES : 0;
  end

  always_ff @(posedge clk) begin
    for (j = 0; j < WIDTH; j++) begin
      open[j] <= 0;
      for (p = 0; p <= COMPLETE; p++) if (p == complete) open[j] <= lane[p*WIDTH+j];
    end
    tasks <= rst || flush ? 0 : base % WIDTH;
    waiting <= rst ? 0 : unwritten + complete + (flush && base % WIDTH != 0 ? 1 : 0);
  end
endmodule
