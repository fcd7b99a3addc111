// SPDX-License-Identifier: Apache-2.0
// Compares packing_unit.sv with a plain model that counts one task after the other, under random
// masks; one of the shapes has no power of two.
module packing_check #(
  parameter ISSUE = 2, parameter WIDTH = 8, parameter WRITES = 1,
  parameter SEG = 16, parameter TAG = 8,
  parameter COMPLETE = (WIDTH - 1 + SEG) / WIDTH > WRITES ? (WIDTH - 1 + SEG) / WIDTH : WRITES,
  parameter LANES = (COMPLETE + 1) * WIDTH, parameter TASK = TAG + 5
) (input logic clk, output integer tasks_packed, output integer differences);
  logic rst = 1, flush = 0;
  logic [ISSUE-1:0] i_valid = 0;
  logic [ISSUE*SEG-1:0] i_mask = 0;
  logic [ISSUE*TAG-1:0] i_tag = 0;
  wire [COMPLETE:0] p_valid;
  wire [(COMPLETE+1)*8-1:0] p_tasks;
  wire [LANES*TASK-1:0] p_lanes;
  wire [7:0] unwritten;
  packing_unit #(.ISSUE(ISSUE), .WIDTH(WIDTH), .SEG(SEG), .TAG(TAG), .WRITES(WRITES)) unit (
    .clk(clk), .rst(rst), .i_valid(i_valid), .i_mask(i_mask), .i_tag(i_tag), .flush(flush),
    .p_valid(p_valid), .p_tasks(p_tasks), .p_lanes(p_lanes), .unwritten(unwritten));

  logic [TASK-1:0] lane [0:LANES-1];
  integer count, open = 0, waiting = 0, packets, left, j, k, l, p, cycle = 0;
  initial begin
    tasks_packed = 0; differences = 0;
  end

  task check(input logic good, input string what);
    if (!good) begin
      differences = differences + 1;
      if (differences < 10) $display("cycle %0d, ISSUE %0d, WIDTH %0d: %s", cycle, ISSUE, WIDTH, what);
    end
  endtask

  task pack; // one task after the other
    count = open;
    for (k = 0; k < ISSUE; k = k + 1)
      for (j = 0; j < SEG; j = j + 1)
        if (i_valid[k] && i_mask[k*SEG + j]) begin
          lane[count] = {i_tag[k*TAG +: TAG], j[4:0]};
          count = count + 1;
        end
    tasks_packed = tasks_packed + count - open;
    packets = count / WIDTH + (flush && count % WIDTH != 0 ? 1 : 0);
    left = waiting > WRITES ? waiting - WRITES : 0;
  endtask

  always @(negedge clk) begin
    rst = 0; flush = $urandom_range(7) == 0; left = LANES - 1 - open;
    for (k = 0; k < ISSUE; k = k + 1) begin
      i_tag[k*TAG +: TAG] = $urandom;
      i_mask[k*SEG +: SEG] = $urandom_range(3) == 0 ? 16'hffff : $urandom & $urandom;
      // The bank issues no more than becomes complete in a cycle, and what stays open.
      i_valid[k] = $urandom_range(3) != 0 && $countones(i_mask[k*SEG +: SEG]) <= left;
      if (i_valid[k]) left = left - $countones(i_mask[k*SEG +: SEG]);
    end
  end
  always @(posedge clk) begin // the outputs before the edge are those of the inputs before it
    if (!rst) begin
      pack;
      for (l = 0; l < LANES; l = l + 1) check(p_lanes[l*TASK +: TASK] == (l < count ? lane[l] : 0), "a lane");
      for (p = 0; p <= COMPLETE; p = p + 1) begin
        check(p_valid[p] == (p < packets), "a packet that is complete");
        if (p < packets) check(p_tasks[p*8 +: 8] == (p < count / WIDTH ? WIDTH : count % WIDTH), "tasks of a packet");
      end
      check(unwritten == left[7:0], "packets that wait");
      waiting = (left + packets) % 256;
      open = flush ? 0 : count % WIDTH;
      for (l = 0; l < open; l = l + 1) lane[l] = lane[count / WIDTH * WIDTH + l];
    end
    cycle = cycle + 1;
  end
endmodule

module packing_test;
  logic clk = 0;
  integer tasks [0:2], differences [0:2];
  packing_check #(.ISSUE(2), .WIDTH(8)) small_bank (clk, tasks[0], differences[0]);
  packing_check #(.ISSUE(3), .WIDTH(12), .WRITES(4)) odd_bank (clk, tasks[1], differences[1]);
  packing_check #(.ISSUE(1), .WIDTH(32)) wide_bank (clk, tasks[2], differences[2]);
  initial begin
    repeat (40000) #1 clk = ~clk;
    $display("Packing Unit: %0d tasks, %0d differences", tasks.sum(), differences.sum());
    if (differences.sum() != 0) $fatal(1);
    $finish;
  end
endmodule
