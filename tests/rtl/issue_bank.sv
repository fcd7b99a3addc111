// SPDX-License-Identifier: Apache-2.0
// An Issue Bank of the Packing Scheduler in registers: what docs/issue-bank.md says a bank does in
// a cycle, in the order of that page. Dates are distances: `rel` is the execution date of the next
// task, and `cool` the date from which a domain may be touched, both from now + packing latency on.
// The Feature Buffer is outside: a span is offered once its splat has an entry.
module issue_bank #(
  parameter STREAMS = 1,   // tile streams
  parameter SLOTS = 2,     // tiles of a stream in flight
  parameter CONTEXTS = 2,  // of the Pixel Buffer, of a stream
  parameter DOMAINS = 8,   // conflict domains of a tile in this bank
  parameter PER_ROW = 2,   // of them in a row
  parameter SEG = 16,      // px, segment length
  parameter DEPTH = 32,    // segments that wait
  parameter CUT = 2,       // segments cut per cycle
  parameter SPANS = 2,     // spans taken per cycle
  parameter ISSUE = 2,     // segments issued per cycle
  parameter WIDTH = 8,     // tasks per packet
  parameter PACKETS = 5,   // packets that wait for the array
  parameter WRITES = 1,    // packets written per cycle
  parameter REUSE = 4,     // cycles between two updates of a domain
  parameter SELECT = 0,    // cycles from the choice of segments to their packing; 0: one after the other in one cycle
  parameter PIXELS = 0,    // 1: tasks of ended pixels are not issued (termination: pixel)
  parameter OLDEST = 0,    // 1: the oldest head goes first (scan: oldest); 0: domains in turn
  parameter ITEMS = 6,     // spans and ends of tiles of a stream that are offered in a cycle
  parameter MESSAGES = 4,  // messages about ended pixels in a cycle
  // widths
  parameter N = STREAMS * SLOTS * DOMAINS, parameter NB = $clog2(N + 1),
  parameter EB = $clog2(DEPTH + 1), parameter XB = 8, parameter TB = 8, parameter DB = 8
) (
  input logic clk, input logic rst,
  input logic [MESSAGES-1:0] t_valid, input logic [MESSAGES*TB-1:0] t_tile,
  input logic [MESSAGES*DB-1:0] t_domain, input logic [MESSAGES*SEG-1:0] t_mask,
  input logic [STREAMS*2-1:0] context_free,
  // what each stream offers, the oldest first; a row is its number in this bank
  input logic [STREAMS*ITEMS-1:0] s_valid, input logic [STREAMS*ITEMS-1:0] s_end,
  input logic [STREAMS*ITEMS*XB-1:0] s_row, input logic [STREAMS*ITEMS*XB-1:0] s_x0,
  input logic [STREAMS*ITEMS*XB-1:0] s_length, input logic [STREAMS*ITEMS*TB-1:0] s_tile,
  input logic [STREAMS*ITEMS*XB-1:0] s_width, // px of the tile inside the image
  output logic [STREAMS*4-1:0] s_taken,
  // segments cut: their place, and the item that they belong to (all ones: that of the cycle before)
  output logic [CUT-1:0] c_valid, output logic [CUT*EB-1:0] c_entry,
  output logic [CUT*8-1:0] c_item, output logic [CUT*NB-1:0] c_domain,
  output logic [7:0] c_open, // the item that is cut at the end of the cycle
  // segments issued
  output logic [ISSUE-1:0] i_valid, output logic [ISSUE*EB-1:0] i_entry,
  output logic [ISSUE*SEG-1:0] i_mask, output logic [ISSUE*NB-1:0] i_domain,
  output logic [4:0] i_rel, // of the first task of the cycle
  output logic [STREAMS*2-1:0] ended, // tiles
  output logic flush // the open packet goes although it is not full
);
  // State. A tile has a slot, its stream's number times SLOTS plus its turn modulo SLOTS.
  logic [SEG-1:0] gone [0:N-1];          // ended pixels
  logic [5:0] cool [0:N-1];
  logic [EB-1:0] head [0:N-1], tail [0:N-1];
  logic waits [0:N-1];                   // the domain has segments
  logic used [0:DEPTH-1];
  logic [NB-1:0] at [0:DEPTH-1];         // domain of a waiting segment
  logic [SEG-1:0] mask [0:DEPTH-1];
  logic [EB-1:0] next [0:DEPTH-1];
  logic [15:0] born [0:DEPTH-1];         // order of arrival
  logic [15:0] order;
  logic live [0:STREAMS*SLOTS-1];        // a tile that the bank works on
  logic [TB-1:0] tile [0:STREAMS*SLOTS-1];
  logic [DB-1:0] cursor [0:STREAMS*SLOTS-1];
  logic [2:0] oldest [0:STREAMS-1];      // turn modulo SLOTS
  logic [2:0] closed [0:STREAMS-1];      // tiles that are taken in and not over
  logic [3:0] startable [0:STREAMS-1];   // tiles from the oldest one on that have a context
  logic entered [0:STREAMS-1];           // something of the next tile has been taken
  logic [7:0] turn, last;                // stream whose span is taken next; that issued last
  logic [7:0] left, skip;                // columns from the segment's first on; those not covered
  logic [NB-1:0] cut;                    // domain of the next segment
  logic [7:0] item;
  logic [5:0] rel;
  logic [7:0] tasks, unwritten;          // of the open packet; complete packets
  logic carries;                         // the open packet has the end of a tile
  // Groups of domains that were chosen and are not packed yet, the oldest group first.
  localparam GROUPS = SELECT == 0 ? 1 : SELECT;
  logic [ISSUE-1:0] chosen [0:GROUPS-1];
  logic [ISSUE*NB-1:0] picks [0:GROUPS-1];

  logic [SEG-1:0] gone_n [0:N-1];
  logic [5:0] cool_n [0:N-1];
  logic [EB-1:0] head_n [0:N-1], tail_n [0:N-1];
  logic waits_n [0:N-1];
  logic used_n [0:DEPTH-1];
  logic [NB-1:0] at_n [0:DEPTH-1];
  logic [SEG-1:0] mask_n [0:DEPTH-1];
  logic [EB-1:0] next_n [0:DEPTH-1];
  logic [15:0] born_n [0:DEPTH-1];
  logic [15:0] order_n;
  logic live_n [0:STREAMS*SLOTS-1];
  logic [TB-1:0] tile_n [0:STREAMS*SLOTS-1];
  logic [DB-1:0] cursor_n [0:STREAMS*SLOTS-1];
  logic [2:0] oldest_n [0:STREAMS-1], closed_n [0:STREAMS-1];
  logic [3:0] startable_n [0:STREAMS-1];
  logic entered_n [0:STREAMS-1];
  logic [7:0] turn_n, last_n, left_n, skip_n, item_n, tasks_n, unwritten_n;
  logic [NB-1:0] cut_n;
  logic [5:0] rel_n;
  logic carries_n;
  logic [ISSUE-1:0] chosen_n [0:GROUPS-1];
  logic [ISSUE*NB-1:0] picks_n [0:GROUPS-1];

  logic [3:0] taken [0:STREAMS-1];
  logic stop, found, full, go, ready, older;
  logic [3:0] spans;
  logic [7:0] slot, place, s_now, from;
  logic [EB-1:0] entry, following;
  logic [SEG-1:0] want;
  logic [7:0] total, complete;
  logic [NB-1:0] pick;
  logic [15:0] best;
  logic picked [0:N-1];                  // the domain is in a group
  integer c, d, e, g, i, j, k, s, t, x;

  // The next domain to pick, if one is found: of the oldest tile of a stream that has a ready one.
  task choose;
    found = 0; pick = 0; best = 0; s_now = last_n;
    for (t = 0; t < STREAMS; t++) begin
      s_now = s_now + 1 == STREAMS ? 0 : s_now + 1;
      for (s = 0; s < STREAMS; s++) if (s_now == s && (OLDEST || !found)) begin
        older = 0; // a tile of the stream that is older has a ready domain
        for (x = 0; x < SLOTS; x++) begin
          slot = oldest_n[s] + x;
          slot = s * SLOTS + (slot >= SLOTS ? slot - SLOTS : slot);
          ready = 0;
          for (d = 0; d < DOMAINS; d++) begin
            from = OLDEST ? d : (cursor_n[slot] + d >= DOMAINS ? cursor_n[slot] + d - DOMAINS : cursor_n[slot] + d);
            i = slot * DOMAINS + from;
            if (!older && x < startable_n[s] && x < closed_n[s] + entered_n[s] && waits_n[i] && cool_n[i] <= rel_n &&
                (SELECT == 0 || !picked[i])) begin
              if (!found || (OLDEST && $signed(born_n[head_n[i]] - best) < 0)) begin
                pick = i; best = born_n[head_n[i]];
                found = 1;
              end
              ready = 1;
            end
          end
          older = older | ready;
        end
      end
    end
  endtask

  // The turn goes on behind the pick.
  task move_on;
    slot = pick / DOMAINS;
    cursor_n[slot] = pick % DOMAINS + 1 == DOMAINS ? 0 : pick % DOMAINS + 1;
    last_n = slot / SLOTS;
  endtask

  always_comb begin
    for (i = 0; i < N; i++) begin
      gone_n[i] = gone[i]; cool_n[i] = cool[i]; head_n[i] = head[i]; tail_n[i] = tail[i]; waits_n[i] = waits[i];
    end
    for (e = 0; e < DEPTH; e++) begin
      used_n[e] = used[e]; at_n[e] = at[e]; mask_n[e] = mask[e]; next_n[e] = next[e]; born_n[e] = born[e];
    end
    for (i = 0; i < STREAMS*SLOTS; i++) begin
      live_n[i] = live[i]; tile_n[i] = tile[i]; cursor_n[i] = cursor[i];
    end
    for (s = 0; s < STREAMS; s++) begin
      oldest_n[s] = oldest[s]; closed_n[s] = closed[s]; entered_n[s] = entered[s];
      startable_n[s] = startable[s];
      taken[s] = 0;
    end
    order_n = order; turn_n = turn; last_n = last; left_n = left; skip_n = skip; item_n = 8'hff; cut_n = cut;
    rel_n = rel; tasks_n = tasks; carries_n = carries;
    unwritten_n = unwritten > WRITES ? unwritten - WRITES : 0;
    c_valid = 0; c_entry = 0; c_item = 0; c_domain = 0; i_valid = 0; i_entry = 0; i_mask = 0; i_domain = 0; i_rel = rel[4:0];
    ended = 0; flush = 0; stop = 0; found = 0; full = 0; go = 0; ready = 0; older = 0; slot = 0; place = 0; s_now = 0;
    from = 0; entry = 0; following = 0; want = 0; total = 0; complete = 0; pick = 0; best = 0; spans = SPANS;

    // A pipelined bank chooses from registers, a group for one date, unless the oldest group waits for room. Chosen in
    // the cycle in which it is packed (SELECT = 1) or before.
    for (g = 0; g < GROUPS; g++) begin
      chosen_n[g] = chosen[g]; picks_n[g] = picks[g];
    end
    for (i = 0; i < N; i++) picked[i] = 0;
    if (SELECT != 0 && chosen[0] == 0) begin
      for (g = 0; g < GROUPS - 1; g++) begin
        chosen_n[g] = chosen[g+1]; picks_n[g] = picks[g+1];
        for (k = 0; k < ISSUE; k++) if (chosen_n[g][k]) picked[picks_n[g][k*NB +: NB]] = 1;
      end
      chosen_n[GROUPS-1] = 0;
      for (k = 0; k < ISSUE; k++) begin
        choose;
        if (found) begin
          chosen_n[GROUPS-1][k] = 1; picks_n[GROUPS-1][k*NB +: NB] = pick; picked[pick] = 1;
          move_on;
        end
      end
    end
    for (s = 0; s < STREAMS; s++) startable_n[s] = startable[s] + {2'b0, context_free[s*2 +: 2]};

    // Ended pixels. A domain without live pixels loses its segments, and its place in a group.
    for (t = 0; t < MESSAGES; t++)
      for (i = 0; i < N; i++)
        if (t_valid[t] && live[i / DOMAINS] && tile[i / DOMAINS] == t_tile[t*TB +: TB] &&
            t_domain[t*DB +: DB] == i % DOMAINS) begin
          gone_n[i] = gone_n[i] | t_mask[t*SEG +: SEG];
          if (&gone_n[i]) begin
            waits_n[i] = 0;
            for (e = 0; e < DEPTH; e++) if (at_n[e] == i) used_n[e] = 0;
            for (g = 0; g < GROUPS; g++)
              for (k = 0; k < ISSUE; k++) if (picks_n[g][k*NB +: NB] == i) chosen_n[g][k] = 0;
          end
        end

    // Spans are taken in and cut.
    for (c = 0; c < CUT; c++) begin
      if (left_n == 0 && !stop) begin
        found = 0;
        if (spans != 0)
          for (t = 0; t < STREAMS; t++) begin
            s_now = turn_n;
            if (!found) turn_n = turn_n + 1 == STREAMS ? 0 : turn_n + 1;
            for (s = 0; s < STREAMS; s++) if (!found && s_now == s)
              for (x = 0; x <= SLOTS; x++) begin // ends of tiles, and the span behind them
                place = s * ITEMS + taken[s];
                go = s_valid[place] && (STREAMS == 1 ? closed_n[s] < SLOTS : closed_n[s] < startable_n[s]);
                if (!found && go) begin
                  slot = oldest_n[s] + closed_n[s];
                  slot = s * SLOTS + (slot >= SLOTS ? slot - SLOTS : slot);
                  if (!entered_n[s]) begin
                    entered_n[s] = 1; live_n[slot] = 1; tile_n[slot] = s_tile[place*TB +: TB]; cursor_n[slot] = 0;
                    for (i = 0; i < N; i++) if (i / DOMAINS == slot) begin
                      cool_n[i] = 0;
                      for (j = 0; j < SEG; j++) gone_n[i][j] = (i % PER_ROW) * SEG + j >= s_width[place*XB +: XB];
                    end
                  end
                  taken[s] = taken[s] + 1;
                  if (s_end[place]) begin
                    closed_n[s] = closed_n[s] + 1; entered_n[s] = 0;
                  end else begin
                    found = 1; item_n = place;
                    skip_n = s_x0[place*XB +: XB] % SEG;
                    left_n = s_length[place*XB +: XB] + skip_n;
                    cut_n = slot * DOMAINS + s_row[place*XB +: XB] * PER_ROW + s_x0[place*XB +: XB] / SEG;
                  end
                end
              end
          end
        if (found) spans = spans - 1; else stop = 1;
      end
      if (!stop) begin
        for (j = 0; j < SEG; j++) want[j] = j >= skip_n && j < left_n;
        full = 1; entry = 0;
        for (e = DEPTH - 1; e >= 0; e--) if (!used_n[e]) begin full = 0; entry = e; end
        go = PIXELS ? (want & ~gone_n[cut_n]) != 0 : !(&gone_n[cut_n]); // else it is dropped
        if (go && full) stop = 1;
        else begin
          if (go) begin
            c_valid[c] = 1; c_entry[c*EB +: EB] = entry; c_item[c*8 +: 8] = item_n; c_domain[c*NB +: NB] = cut_n;
            used_n[entry] = 1; at_n[entry] = cut_n; mask_n[entry] = want; born_n[entry] = order_n;
            if (waits_n[cut_n]) next_n[tail_n[cut_n]] = entry; else head_n[cut_n] = entry;
            tail_n[cut_n] = entry; waits_n[cut_n] = 1;
            order_n = order_n + 1;
          end
          skip_n = 0; cut_n = cut_n + 1; left_n = left_n > SEG ? left_n - SEG : 0;
        end
      end
    end

    // Issue: one pick after the other, each for the date at which its first task will execute, or the oldest group.
    stop = 0;
    for (k = 0; k < ISSUE; k++) begin
      if (SELECT == 0) choose;
      else begin
        found = chosen_n[0][k]; pick = picks_n[0][k*NB +: NB];
      end
      entry = head_n[pick];
      want = PIXELS ? mask_n[entry] & ~gone_n[pick] : mask_n[entry];
      total = tasks_n;
      for (j = 0; j < SEG; j++) total = total + want[j];
      complete = total / WIDTH;
      // Room in the Packing Buffer, and for writing what becomes complete.
      go = want == 0 || (rel_n + (total + WIDTH - 1) / WIDTH <= PACKETS &&
                         (unwritten_n == 0 || unwritten_n + complete <= WRITES));
      if (SELECT == 0 ? !found || !go : found && !go) stop = 1;
      if (found && !stop) begin
        chosen_n[0][k] = 0;
        i_valid[k] = 1; i_entry[k*EB +: EB] = entry; i_mask[k*SEG +: SEG] = want; i_domain[k*NB +: NB] = pick;
        if (want != 0) begin
          cool_n[pick] = rel_n + (total - 1) / WIDTH + REUSE;
          rel_n = rel_n + complete;
          if (complete != 0) carries_n = 0;
          unwritten_n = unwritten_n + complete;
          tasks_n = total % WIDTH;
        end
        following = next_n[entry];
        used_n[entry] = 0;
        if (tail_n[pick] == entry) waits_n[pick] = 0; else head_n[pick] = following;
        if (SELECT == 0) move_on;
      end
    end

    // Tiles end. An end travels with the open packet, one with each.
    for (s = 0; s < STREAMS; s++) begin
      stop = 0;
      for (x = 0; x < SLOTS; x++) begin
        slot = s * SLOTS + oldest_n[s];
        go = closed_n[s] != 0 && startable_n[s] != 0;
        for (i = 0; i < N; i++) if (i / DOMAINS == slot && waits_n[i]) go = 0;
        if (!go) stop = 1;
        if (!stop) begin
          ended[s*2 +: 2] = ended[s*2 +: 2] + 1;
          if (tasks_n != 0 && carries_n) begin
            flush = 1; tasks_n = 0; rel_n = rel_n + 1; unwritten_n = unwritten_n + 1;
          end
          carries_n = tasks_n != 0;
          live_n[slot] = 0;
          oldest_n[s] = oldest_n[s] + 1 == SLOTS ? 0 : oldest_n[s] + 1;
          closed_n[s] = closed_n[s] - 1; startable_n[s] = startable_n[s] - 1;
        end
      end
    end

    // A packet that is not full goes at the last date at which it still comes in time.
    if (tasks_n != 0 && rel_n == 0) begin
      flush = 1; tasks_n = 0; carries_n = 0; unwritten_n = unwritten_n + 1;
    end else if (rel_n != 0) rel_n = rel_n - 1;
    for (i = 0; i < N; i++) if (cool_n[i] != 0) cool_n[i] = cool_n[i] - 1;
    for (s = 0; s < STREAMS; s++) s_taken[s*4 +: 4] = taken[s];
    c_open = item_n;
  end

  always_ff @(posedge clk) begin
    for (i = 0; i < N; i++) begin
      gone[i] <= gone_n[i]; cool[i] <= rst ? 0 : cool_n[i]; head[i] <= head_n[i]; tail[i] <= tail_n[i];
      waits[i] <= rst ? 0 : waits_n[i];
    end
    for (e = 0; e < DEPTH; e++) begin
      used[e] <= rst ? 0 : used_n[e]; at[e] <= at_n[e]; mask[e] <= mask_n[e]; next[e] <= next_n[e]; born[e] <= born_n[e];
    end
    for (i = 0; i < STREAMS*SLOTS; i++) begin
      live[i] <= rst ? 0 : live_n[i]; tile[i] <= tile_n[i]; cursor[i] <= rst ? 0 : cursor_n[i];
    end
    for (s = 0; s < STREAMS; s++) begin
      oldest[s] <= rst ? 0 : oldest_n[s]; closed[s] <= rst ? 0 : closed_n[s];
      startable[s] <= rst ? CONTEXTS : startable_n[s]; entered[s] <= rst ? 0 : entered_n[s];
    end
    for (g = 0; g < GROUPS; g++) begin
      chosen[g] <= rst ? 0 : chosen_n[g]; picks[g] <= picks_n[g];
    end
    order <= rst ? 0 : order_n; turn <= rst ? 0 : turn_n; last <= rst ? 0 : last_n; left <= rst ? 0 : left_n;
    skip <= skip_n; cut <= cut_n; item <= item_n; rel <= rst ? 0 : rel_n; tasks <= rst ? 0 : tasks_n;
    unwritten <= rst ? 0 : unwritten_n; carries <= rst ? 0 : carries_n;
  end
endmodule
