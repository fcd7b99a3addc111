// SPDX-License-Identifier: Apache-2.0
// The selection of K ready domains among N in one cycle, in turn from a cursor on (docs/issue-bank.md,
// `scan: round_robin`), for the domains of one tile. A domain is picked once per cycle: a domain that
// was picked is ready again REUSE execution dates later, which the picks of one cycle do not reach.
// SERIAL = 1 gives every pick the execution date that the picks before it have moved, 0 gives all
// picks the date at the beginning of the cycle.
module select_in_turn #(
  parameter N = 16, parameter K = 2, parameter SERIAL = 0,
  parameter WIDTH = 8,    // tasks per packet
  parameter DATE = 6,     // bits of a date, as a distance
  parameter COUNT = 5,    // bits of the number of tasks of a segment
  parameter IB = $clog2(N), parameter WB = $clog2(WIDTH)
) (
  input logic clk,
  input logic [N-1:0] waits_in,        // the domain has a segment
  input logic [N*DATE-1:0] cool_in,    // date from which the domain may be touched
  input logic [N*COUNT-1:0] count_in,  // tasks of the segment at the head
  input logic [DATE-1:0] date_in,      // of the next task
  input logic [WB-1:0] tasks_in,       // in the open packet
  output logic [K-1:0] valid, output logic [K*IB-1:0] pick
);
  logic [N-1:0] waits;
  logic [N*DATE-1:0] cool;
  logic [N*COUNT-1:0] count;
  logic [DATE-1:0] date;
  logic [WB-1:0] tasks;
  logic [N-1:0] from; // ones at the cursor and behind it

  logic [N-1:0] left, ready, behind, candidates, reached, one;
  logic [N-1:0] from_now;
  logic [DATE-1:0] date_now;
  logic [WB-1:0] tasks_now;
  logic [COUNT-1:0] more;
  logic [COUNT+WB:0] total;
  logic [K-1:0] valid_now;
  logic [K*IB-1:0] pick_now;
  logic [IB-1:0] index;
  integer i, k, step;

  always_comb begin
    left = waits; from_now = from; date_now = date; tasks_now = tasks;
    valid_now = 0; pick_now = 0;
    for (k = 0; k < K; k = k + 1) begin
      for (i = 0; i < N; i = i + 1)
        ready[i] = left[i] & (cool[i*DATE +: DATE] <= (SERIAL ? date_now : date));
      behind = ready & from_now;
      candidates = behind != 0 ? behind : ready;
      reached = candidates; // ones from the lowest candidate on, in a tree of log2 N steps
      for (step = 1; step < N; step = step * 2) reached = reached | (reached << step);
      one = candidates & ~(reached << 1);
      index = 0; more = 0;
      for (i = 0; i < N; i = i + 1) begin
        index = index | (one[i] ? i[IB-1:0] : {IB{1'b0}});
        if (SERIAL) more = more | (one[i] ? count[i*COUNT +: COUNT] : {COUNT{1'b0}});
      end
      valid_now[k] = ready != 0;
      pick_now[k*IB +: IB] = index;
      left = left & ~one;
      if (ready != 0) from_now = reached << 1;
      total = more + tasks_now;
      if (SERIAL) begin
        date_now = date_now + (total >> WB);
        tasks_now = total[WB-1:0];
      end
    end
  end

  always_ff @(posedge clk) begin
    waits <= waits_in; cool <= cool_in; count <= count_in; date <= date_in; tasks <= tasks_in;
    from <= from_now; valid <= valid_now; pick <= pick_now;
  end
endmodule
