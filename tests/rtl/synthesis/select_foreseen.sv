// SPDX-License-Identifier: Apache-2.0
// What select_in_turn does with serial dates, in a shorter path and on more area: a pick is made for
// every date to which the picks before it may move, while their tasks are counted, and the count
// decides between these.
module select_foreseen #(
  parameter N = 16, parameter K = 2,
  parameter WIDTH = 8,    // tasks per packet
  parameter LENGTH = 16,  // most tasks of a segment
  parameter DATE = 6, parameter COUNT = 5, parameter IB = $clog2(N), parameter WB = $clog2(WIDTH)
) (
  input logic clk,
  input logic [N-1:0] waits_in, input logic [N*DATE-1:0] cool_in, input logic [N*COUNT-1:0] count_in,
  input logic [DATE-1:0] date_in, input logic [WB-1:0] tasks_in,
  output logic [K-1:0] valid, output logic [K*IB-1:0] pick
);
  logic [N-1:0] waits;
  logic [N*DATE-1:0] cool;
  logic [N*COUNT-1:0] count;
  logic [DATE-1:0] date;
  logic [WB-1:0] tasks;
  logic [N-1:0] from; // ones at the cursor and behind it

  logic [N-1:0] left, ready, behind, candidates, reached, one, from_now, reached_then;
  logic [DATE-1:0] moved, then;
  logic [WB-1:0] tasks_now;
  logic [COUNT-1:0] more;
  logic [COUNT+WB:0] total;
  logic [K-1:0] valid_now;
  logic [K*IB-1:0] pick_now;
  logic [IB-1:0] index;
  logic found;
  integer i, k, packets, step;

  always_comb begin
    left = waits; from_now = from; moved = 0; tasks_now = tasks;
    valid_now = 0; pick_now = 0;
    for (k = 0; k < K; k = k + 1) begin
      reached = 0; one = 0; found = 0;
      for (packets = 0; packets <= (WIDTH - 1 + k * LENGTH) / WIDTH; packets = packets + 1) begin
        then = date + packets[DATE-1:0];
        for (i = 0; i < N; i = i + 1) ready[i] = left[i] & (cool[i*DATE +: DATE] <= then);
        behind = ready & from_now;
        candidates = behind != 0 ? behind : ready;
        reached_then = candidates;
        for (step = 1; step < N; step = step * 2) reached_then = reached_then | (reached_then << step);
        if (moved == packets) begin
          reached = reached_then; one = candidates & ~(reached_then << 1); found = ready != 0;
        end
      end
      index = 0; more = 0;
      for (i = 0; i < N; i = i + 1) begin
        index = index | (one[i] ? i[IB-1:0] : {IB{1'b0}});
        more = more | (one[i] ? count[i*COUNT +: COUNT] : {COUNT{1'b0}});
      end
      valid_now[k] = found;
      pick_now[k*IB +: IB] = index;
      left = left & ~one;
      if (found) from_now = reached << 1;
      total = more + tasks_now;
      moved = moved + (total >> WB);
      tasks_now = total[WB-1:0];
    end
  end

  always_ff @(posedge clk) begin
    waits <= waits_in; cool <= cool_in; count <= count_in; date <= date_in; tasks <= tasks_in;
    from <= from_now; valid <= valid_now; pick <= pick_now;
  end
endmodule
