// SPDX-License-Identifier: Apache-2.0
// The segment queue of an Issue Bank (docs/issue-bank.md): DEPTH segments in one list per domain. CUT
// segments enter and ISSUE leave in a cycle, and a domain without live pixels loses all of its
// segments. Segments leave that were in the queue before the cycle. The domains that are issued from
// differ, as the reuse distance demands.
module segment_queue #(
  parameter DEPTH = 32, parameter N = 16, parameter CUT = 2, parameter ISSUE = 2, parameter SEG = 16,
  parameter EB = $clog2(DEPTH), parameter NB = $clog2(N)
) (
  input logic clk,
  input logic [CUT-1:0] c_valid_in, input logic [CUT*NB-1:0] c_domain_in, input logic [CUT*SEG-1:0] c_mask_in,
  input logic [ISSUE-1:0] i_valid_in, input logic [ISSUE*NB-1:0] i_domain_in,
  input logic kills_in, input logic [NB-1:0] killed_in, // a domain that has ended
  output logic full, output logic [N-1:0] waits,
  output logic [ISSUE*SEG-1:0] i_mask
);
  logic [CUT-1:0] c_valid;
  logic [CUT*NB-1:0] c_domain;
  logic [CUT*SEG-1:0] c_mask;
  logic [ISSUE-1:0] i_valid;
  logic [ISSUE*NB-1:0] i_domain;
  logic kills;
  logic [NB-1:0] killed;
  // The state: of a segment, and of a domain.
  logic [DEPTH-1:0] used;
  logic [DEPTH*SEG-1:0] mask;
  logic [DEPTH*EB-1:0] next;
  logic [DEPTH*NB-1:0] at;
  logic [N*EB-1:0] head, tail;

  logic [DEPTH-1:0] free, reached, one, used_now;
  logic [DEPTH*SEG-1:0] mask_now;
  logic [DEPTH*EB-1:0] next_now;
  logic [DEPTH*NB-1:0] at_now;
  logic [N*EB-1:0] head_now, tail_now;
  logic [N-1:0] waits_now;
  logic full_now, linked;
  logic [EB-1:0] entry, last;
  logic [NB-1:0] domain;
  logic [ISSUE*SEG-1:0] i_mask_now;
  logic [EB:0] count;
  integer c, e, k, step;

  always_comb begin
    used_now = used; mask_now = mask; next_now = next; at_now = at;
    head_now = head; tail_now = tail; waits_now = waits;
    i_mask_now = 0;
    // Segments leave.
    for (k = 0; k < ISSUE; k = k + 1) begin
      domain = i_domain[k*NB +: NB];
      entry = head[domain*EB +: EB];
      i_mask_now[k*SEG +: SEG] = mask[entry*SEG +: SEG];
      if (i_valid[k]) begin
        used_now[entry] = 0;
        head_now[domain*EB +: EB] = next[entry*EB +: EB];
        if (tail[domain*EB +: EB] == entry) waits_now[domain] = 0;
      end
    end
    // Segments enter, behind the last of their domain, which may have come in the same cycle.
    free = ~used;
    for (c = 0; c < CUT; c = c + 1) begin
      reached = free; // ones from the lowest free entry on, in a tree of log2 DEPTH steps
      for (step = 1; step < DEPTH; step = step * 2) reached = reached | (reached << step);
      one = free & ~(reached << 1);
      free = free & ~one;
      entry = 0;
      for (e = 0; e < DEPTH; e = e + 1) entry = entry | (one[e] ? e[EB-1:0] : {EB{1'b0}});
      domain = c_domain[c*NB +: NB];
      last = tail_now[domain*EB +: EB];
      linked = waits_now[domain];
      if (c_valid[c]) begin
        for (e = 0; e < DEPTH; e = e + 1) begin
          if (one[e]) begin
            used_now[e] = 1;
            mask_now[e*SEG +: SEG] = c_mask[c*SEG +: SEG];
            at_now[e*NB +: NB] = domain;
          end
          if (linked && last == e) next_now[e*EB +: EB] = entry;
        end
        if (!linked) head_now[domain*EB +: EB] = entry;
        tail_now[domain*EB +: EB] = entry;
        waits_now[domain] = 1;
      end
    end
    // The queue is full if those that may be on their way could find no room.
    count = 0;
    for (e = 0; e < DEPTH; e = e + 1) count = count + used[e];
    full_now = count + 2 * CUT > DEPTH;
    // A domain ends.
    if (kills) waits_now[killed] = 0;
    for (e = 0; e < DEPTH; e = e + 1) if (kills && at_now[e*NB +: NB] == killed) used_now[e] = 0;
  end

  always_ff @(posedge clk) begin
    c_valid <= c_valid_in; c_domain <= c_domain_in; c_mask <= c_mask_in;
    i_valid <= i_valid_in; i_domain <= i_domain_in; kills <= kills_in; killed <= killed_in;
    used <= used_now; mask <= mask_now; next <= next_now; at <= at_now;
    head <= head_now; tail <= tail_now; waits <= waits_now; full <= full_now; i_mask <= i_mask_now;
  end
endmodule
