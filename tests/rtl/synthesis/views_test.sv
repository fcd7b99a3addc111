// SPDX-License-Identifier: Apache-2.0
// Compares the views that are synthesised with plain models of them, under random inputs: the two
// selections, and the segment queue with a queue for each domain.
module views_test;
  localparam N = 16, K = 2, DEPTH = 32, CUT = 2, CYCLES = 20000;
  logic clk = 0;
  integer errors = 0, picked = 0, chosen = 0, left_queue = 0, c, d, e, i, j, k, cycle;

  // In turn, one date and serial dates.
  logic [N-1:0] waits = 0, waits_1 = 0;
  logic [N*6-1:0] cool = 0, cool_1 = 0;
  logic [N*5-1:0] count = 0, count_1 = 0;
  logic [5:0] date = 0, date_1 = 0;
  logic [2:0] tasks = 0, tasks_1 = 0;
  wire [K-1:0] v [0:2]; // 2: serial dates that are foreseen
  wire [K*4-1:0] p [0:2];
  select_in_turn #(.N(N), .K(K), .SERIAL(0)) turn_0 (clk, waits, cool, count, date, tasks, v[0], p[0]);
  select_in_turn #(.N(N), .K(K), .SERIAL(1)) turn_1 (clk, waits, cool, count, date, tasks, v[1], p[1]);
  select_foreseen #(.N(N), .K(K)) foreseen (clk, waits, cool, count, date, tasks, v[2], p[2]);
  integer cursor [0:1], at, total, now, most, s;
  logic found;
  logic [N-1:0] gone;
  logic [K-1:0] right_v [0:1];
  logic [K*4-1:0] right_p [0:1];

  // The oldest.
  logic [N-1:0] asks = 0, asks_1 = 0, enters = 0, enters_1 = 0;
  wire [K-1:0] ov;
  wire [K*4-1:0] op;
  logic [K-1:0] right_ov;
  logic [K*4-1:0] right_op;
  integer age [0:N-1];
  select_oldest #(.N(N), .K(K)) oldest (clk, asks, enters, ov, op);

  // The queue. Its outputs of a cycle are known one edge after its registered inputs.
  logic [CUT-1:0] cv = 0, cv_1 = 0;
  logic [CUT*4-1:0] cd = 0, cd_1 = 0;
  logic [CUT*16-1:0] cm = 0, cm_1 = 0;
  logic [K-1:0] iv = 0, iv_1 = 0;
  logic [K*4-1:0] id = 0, id_1 = 0;
  logic kills = 0, kills_1 = 0;
  logic [3:0] killed = 0, killed_1 = 0;
  wire full;
  wire [N-1:0] queued;
  wire [K*16-1:0] im;
  logic [K*16-1:0] right_im;
  logic [15:0] list [0:N-1][$];
  integer size;
  segment_queue #(.DEPTH(DEPTH), .N(N), .CUT(CUT), .ISSUE(K)) queue
    (clk, cv, cd, cm, iv, id, kills, killed, full, queued, im);

  task check(input logic good, input string what);
    if (!good) begin
      errors = errors + 1;
      if (errors < 10) $display("cycle %0d: %s", cycle, what);
    end
  endtask

  task model_turn;
    for (s = 0; s < 2; s = s + 1) begin
      now = date_1; most = tasks_1; gone = 0; right_v[s] = 0; right_p[s] = 0;
      for (k = 0; k < K; k = k + 1) begin
        found = 0;
        for (i = 0; i < N; i = i + 1) begin
          at = (cursor[s] + i) % N;
          if (!found && waits_1[at] && !gone[at] && cool_1[at*6 +: 6] <= now) begin
            found = 1; gone[at] = 1; right_v[s][k] = 1; right_p[s][k*4 +: 4] = at[3:0];
            total = most + count_1[at*5 +: 5];
            if (s == 1) begin now = now + total / 8; most = total % 8; end
          end
        end
        if (found) cursor[s] = (right_p[s][k*4 +: 4] + 1) % N;
      end
    end
  endtask

  task model_oldest;
    gone = 0; right_ov = 0; right_op = 0;
    for (k = 0; k < K; k = k + 1) begin
      at = -1;
      for (i = 0; i < N; i = i + 1)
        if (asks_1[i] && !gone[i] && (at < 0 || age[i] < age[at])) at = i;
      if (at >= 0) begin right_ov[k] = 1; right_op[k*4 +: 4] = at[3:0]; gone[at] = 1; end
    end
    for (i = 0; i < N; i = i + 1) if (enters_1[i]) age[i] = cycle;
  endtask

  task model_queue;
    right_im = 0;
    for (k = 0; k < K; k = k + 1)
      if (iv_1[k]) right_im[k*16 +: 16] = list[id_1[k*4 +: 4]].pop_front();
    for (c = 0; c < CUT; c = c + 1) if (cv_1[c]) list[cd_1[c*4 +: 4]].push_back(cm_1[c*16 +: 16]);
    if (kills_1) list[killed_1].delete();
  endtask

  initial begin
    for (i = 0; i < N; i = i + 1) age[i] = i - N;
    cursor[0] = 0; cursor[1] = 0;
    turn_0.from = 0; turn_1.from = 0; foreseen.from = 0; oldest.older = 0; queue.used = 0; queue.waits = 0;
    for (i = 0; i < N; i = i + 1) for (j = i + 1; j < N; j = j + 1) oldest.older[i*N+j] = 1;
    for (cycle = 0; cycle < CYCLES; cycle = cycle + 1) begin
      waits = $urandom & $urandom; date = $urandom_range(20); tasks = $urandom;
      for (i = 0; i < N; i = i + 1) begin
        cool[i*6 +: 6] = $urandom_range(24); count[i*5 +: 5] = $urandom_range(16);
      end
      asks = $urandom; enters = $urandom_range(1) ? 1 << $urandom_range(N - 1) : 0;
      // Segments leave from domains that are sure to have one, two different ones.
      size = 0;
      for (i = 0; i < N; i = i + 1) size = size + list[i].size();
      iv = 0; id = 0;
      d = $urandom_range(N - 1);
      for (i = 0; i < N; i = i + 1) begin
        at = (d + i) % N;
        found = 0;
        for (k = 0; k < K; k = k + 1)
          if (!found && !iv[k] && $urandom_range(2) != 0 && list[at].size() > 0 && !(kills_1 && killed_1 == at)) begin
            e = 0; // one may be on its way out already
            for (j = 0; j < K; j = j + 1) if (iv_1[j] && id_1[j*4 +: 4] == at) e = 1;
            if (list[at].size() > e) begin iv[k] = 1; id[k*4 +: 4] = at[3:0]; found = 1; end
          end
      end
      for (c = 0; c < CUT; c = c + 1) begin
        cv[c] = size + 2 * CUT <= DEPTH && $urandom_range(3) != 0;
        cd[c*4 +: 4] = $urandom; cm[c*16 +: 16] = $urandom;
      end
      kills = $urandom_range(30) == 0; killed = $urandom;
      #1 clk = 1; #1;
      check(v[0] === right_v[0] || cycle < 2, "in turn, one date: valid");
      check(v[1] === right_v[1] || cycle < 2, "in turn, serial dates: valid");
      check(v[2] === right_v[1] || cycle < 2, "in turn, dates foreseen: valid");
      for (k = 0; k < K; k = k + 1) if (cycle > 1 && right_v[1][k]) begin
        check(p[2][k*4 +: 4] === right_p[1][k*4 +: 4], "in turn, dates foreseen: pick");
        picked = picked + 1;
      end
      for (k = 0; k < K; k = k + 1) for (s = 0; s < 2; s = s + 1)
        if (cycle > 1 && right_v[s][k]) begin
          check(p[s][k*4 +: 4] === right_p[s][k*4 +: 4], "in turn: pick");
          picked = picked + 1;
        end
      check(ov === right_ov || cycle < 2, "oldest: valid");
      for (k = 0; k < K; k = k + 1) if (cycle > 1 && right_ov[k]) begin
        check(op[k*4 +: 4] === right_op[k*4 +: 4], "oldest: pick");
        chosen = chosen + 1;
      end
      for (k = 0; k < K; k = k + 1) if (cycle > 1 && last_iv[k]) begin
        check(im[k*16 +: 16] === right_im[k*16 +: 16], "queue: mask");
        left_queue = left_queue + 1;
      end
      for (i = 0; i < N; i = i + 1) check(cycle < 2 || queued[i] === (list[i].size() != 0), "queue: waits");
      {waits_1, cool_1, count_1, date_1, tasks_1} = {waits, cool, count, date, tasks};
      asks_1 = asks; enters_1 = enters;
      {cv_1, cd_1, cm_1, iv_1, id_1, kills_1, killed_1} = {cv, cd, cm, iv, id, kills, killed};
      model_turn; model_oldest; model_queue;
      last_iv = iv_1;
      #1 clk = 0; #1;
    end
    $display("%0d picks in turn, %0d of the oldest, %0d segments: %0d differences", picked, chosen, left_queue, errors);
    if (errors != 0) $fatal(1);
    $finish;
  end
  logic [K-1:0] last_iv = 0;
endmodule
