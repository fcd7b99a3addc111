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
  localparam PIXELS = ISSUE * SEG, COUNT = $clog2(PIXELS + WIDTH), HALF = 1 << ($clog2(PIXELS) - 1);
  logic [TASK-1:0] open [0:WIDTH-1];
  logic [7:0] tasks, waiting;
  logic [TASK-1:0] lane [0:LANES-1];
  logic [PIXELS-1:0] task_of;
  logic [COUNT-1:0] near [0:PIXELS-1], far [0:PIXELS-1];
  logic [7:0] base, complete;
  logic [4:0] pixel;
  logic [SEG-1:0] hits;
  integer d, i, j, k, l, p;

  // a + b == sum, without a chain of carries: if the sum is right, a bit carries where a and b have
  // it, or one of them has it and the sum has not.
  function automatic logic adds_up(input logic [COUNT-1:0] a, input logic [COUNT-1:0] b, input logic [COUNT-1:0] sum);
    adds_up = (a ^ b ^ sum) == (((a & b) | ((a | b) & ~sum)) << 1);
  endfunction

  // A task's place is the number of tasks before it, those of the open packet first: a prefix sum in
  // a tree, whose levels join neighbours to groups of 2, 4, 8 and so on. `near` is the sum within
  // the pixel's half, `far` that of the half before it: their sum is the place.
  always_comb begin
    for (i = 0; i < PIXELS; i++) task_of[i] = i_valid[i/SEG] & i_mask[i];
    near[0] = tasks[COUNT-1:0];
    for (i = 1; i < PIXELS; i++) near[i] = {{COUNT-1{1'b0}}, task_of[i-1]};
    for (d = 1; d < HALF; d = 2 * d)
      for (i = 0; i < PIXELS; i++)
        if (i / d % 2 == 1) near[i] = near[i] + near[i/d*d - 1];
    for (i = 0; i < PIXELS; i++) far[i] = i < HALF ? 0 : near[HALF-1];
    base = near[PIXELS-1] + far[PIXELS-1] + task_of[PIXELS-1];
  end

  always_comb
    for (l = 0; l < LANES; l++) begin
      lane[l] = 0;
      if (l < WIDTH && l < tasks) lane[l] = open[l % WIDTH];
      for (k = 0; k < ISSUE; k++) begin
        for (j = 0; j < SEG; j++) // the tasks before it bring a pixel no further
          hits[j] = l < WIDTH + k*SEG+j && task_of[k*SEG+j] && adds_up(near[k*SEG+j], far[k*SEG+j], l[COUNT-1:0]);
        pixel = 0;
        for (j = 0; j < SEG; j++) pixel = pixel | (j[4:0] & {5{hits[j]}});
        lane[l] = lane[l] | {i_tag[k*TAG +: TAG] & {TAG{|hits}}, pixel};
      end
    end

  always_comb begin
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
