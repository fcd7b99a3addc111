// SPDX-License-Identifier: Apache-2.0
// The stages of a pipelined Issue Bank (docs/issue-bank.md, `select_cycles`), for the domains of one
// tile and `scan: round_robin`. All picks of a cycle have one date, so that the domains that may go
// are known first, and the picks are the first K of them behind the cursor: their places come from a
// tree of sums that stop at K. Picks are vectors with a one at the domain, as the next stage reads
// what it needs through an and-or of them.
module first_of_ready #(parameter N = 16, parameter K = 2) (
  input logic [N-1:0] ready, input logic [N-1:0] from, // ones at the cursor and behind it
  output logic [K*N-1:0] pick, output logic [N-1:0] picked, output logic [N-1:0] from_next
);
  localparam M = 2 * N; // the domains behind the cursor, then those before it
  logic [M-1:0] line;
  logic [M*K-1:0] count, sum; // ones up to a place: its bit j says that there are more than j
  logic [N-1:0] after_first, after_last; // no ready domain from here on, behind the cursor and before it
  logic carry;
  integer i, j, k, step;
  always_comb begin
    line = {ready & ~from, ready & from};
    count = 0;
    for (i = 0; i < M; i = i + 1) count[i*K] = line[i];
    for (step = 1; step < M; step = step * 2) begin
      sum = count;
      for (i = 0; i < M; i = i + 1)
        if ((i / step) % 2 == 1) // the upper half begins at i / step * step
          for (j = 0; j < K; j = j + 1) begin
            carry = count[i*K+j] | count[(i/step*step-1)*K+j];
            for (k = 0; k < j; k = k + 1) carry = carry | (count[i*K+k] & count[(i/step*step-1)*K+j-1-k]);
            sum[i*K+j] = carry;
          end
      count = sum;
    end
    pick = 0;
    for (k = 0; k < K; k = k + 1) pick[k*N] = line[0] & (k == 0); // number of the pick: ones below it
    for (i = 1; i < M; i = i + 1)
      for (k = 0; k < K; k = k + 1)
        pick[k*N + i % N] = pick[k*N + i % N] | (line[i] & ~count[(i-1)*K+k] & (k == 0 | count[(i-1)*K+(k+K-1)%K]));
    picked = 0;
    for (k = 0; k < K; k = k + 1) picked = picked | pick[k*N +: N];
    // The cursor goes behind the last pick.
    after_first = line[N-1:0]; after_last = line[M-1:N];
    for (step = 1; step < N; step = step * 2) begin
      after_first = after_first | (after_first >> step);
      after_last = after_last | (after_last >> step);
    end
    for (i = 0; i < N; i = i + 1) begin
      if (count[N*K-1]) from_next[i] = i == 0 ? 1'b0 : count[(i+N-1)%N*K+K-1];
      else if (count[M*K-1]) from_next[i] = i == 0 ? 1'b0 : count[(N+i-1)*K+K-1];
      else if (after_last[0]) from_next[i] = ~after_last[i];
      else if (after_first[0]) from_next[i] = ~after_first[i];
      else from_next[i] = from[i];
    end
  end
endmodule

// The domains that may go at the date of the next task: they have a segment, are not chosen yet, and
// are at rest by then.
module ready_vector #(parameter N = 16, parameter DATE = 6) (
  input logic clk,
  input logic [N-1:0] waits_in, input logic [N-1:0] chosen_in, input logic [N*DATE-1:0] cool_in,
  input logic [DATE-1:0] date_in, output logic [N-1:0] ready
);
  logic [N-1:0] waits, chosen, now;
  logic [N*DATE-1:0] cool;
  logic [DATE-1:0] date;
  integer i;
  always_comb for (i = 0; i < N; i = i + 1) now[i] = waits[i] & ~chosen[i] & (cool[i*DATE +: DATE] <= date);
  always_ff @(posedge clk) begin
    waits <= waits_in; chosen <= chosen_in; cool <= cool_in; date <= date_in; ready <= now;
  end
endmodule

// The choice from the domains that a register has as ready, without those that were picked meanwhile.
module choose_in_turn #(parameter N = 16, parameter K = 2) (
  input logic clk, input logic [N-1:0] ready_in, output logic [K*N-1:0] pick
);
  logic [N-1:0] ready, from, from_next, picked, picked_now;
  logic [K*N-1:0] now;
  first_of_ready #(.N(N), .K(K)) first (ready & ~picked, from, now, picked_now, from_next);
  always_ff @(posedge clk) begin
    ready <= ready_in; from <= from_next; picked <= picked_now; pick <= now;
  end
endmodule

// Both in one cycle.
module choose_by_dates #(parameter N = 16, parameter K = 2, parameter DATE = 6) (
  input logic clk,
  input logic [N-1:0] waits_in, input logic [N-1:0] chosen_in, input logic [N*DATE-1:0] cool_in,
  input logic [DATE-1:0] date_in, output logic [K*N-1:0] pick
);
  logic [N-1:0] waits, chosen, ready, from, from_next, picked, picked_now;
  logic [N*DATE-1:0] cool;
  logic [DATE-1:0] date;
  logic [K*N-1:0] now;
  integer i;
  always_comb for (i = 0; i < N; i = i + 1)
    ready[i] = waits[i] & ~chosen[i] & ~picked[i] & (cool[i*DATE +: DATE] <= date);
  first_of_ready #(.N(N), .K(K)) first (ready, from, now, picked_now, from_next);
  always_ff @(posedge clk) begin
    waits <= waits_in; chosen <= chosen_in; cool <= cool_in; date <= date_in;
    from <= from_next; picked <= picked_now; pick <= now;
  end
endmodule

// The tasks of the segments of a group, read from the numbers of tasks of the domains' heads, and the
// dates that follow: of the next task, and those at which each pick's domain may be touched again.
module group_dates #(
  parameter N = 16, parameter K = 2, parameter WIDTH = 8, // tasks per packet, a power of two
  parameter REUSE = 4, parameter DATE = 6, parameter COUNT = 5, parameter WB = $clog2(WIDTH)
) (
  input logic clk, input logic [K*N-1:0] pick_in, input logic [N*COUNT-1:0] count_in,
  output logic [DATE-1:0] date, output logic [WB-1:0] tasks, output logic [K*DATE-1:0] again
);
  localparam SUM = COUNT + 3 > WB + 2 ? COUNT + 3 : WB + 2;
  logic [K*N-1:0] pick;
  logic [N*COUNT-1:0] count;
  logic [COUNT-1:0] more [0:K-1];
  logic [SUM-1:0] total [0:K-1]; // tasks up to a pick
  logic [K*DATE-1:0] again_now;
  logic [SUM-1:0] last;
  logic [DATE-1:0] date_now;
  integer i, k;
  always_comb begin
    for (k = 0; k < K; k = k + 1) begin
      more[k] = 0;
      for (i = 0; i < N; i = i + 1) more[k] = more[k] | (count[i*COUNT +: COUNT] & {COUNT{pick[k*N+i]}});
    end
    // Pairs first, so that no sum has more than three steps.
    total[0] = tasks + more[0];
    if (K > 1) total[1] = tasks + (more[0] + {{(SUM-COUNT){1'b0}}, more[1]});
    if (K > 2) total[2] = total[0] + (more[1] + {{(SUM-COUNT){1'b0}}, more[2]});
    if (K > 3) total[3] = total[1] + (more[2] + {{(SUM-COUNT){1'b0}}, more[3]});
    for (k = 0; k < K; k = k + 1) begin
      last = total[k] - 1'b1;
      again_now[k*DATE +: DATE] = date + (last >> WB) + REUSE;
    end
    date_now = date + (total[K-1] >> WB);
  end
  always_ff @(posedge clk) begin
    pick <= pick_in; count <= count_in; again <= again_now;
    tasks <= total[K-1][WB-1:0];
    date <= date_now == 0 ? {DATE{1'b0}} : date_now - 1'b1; // as a distance, from the next cycle on
  end
endmodule
