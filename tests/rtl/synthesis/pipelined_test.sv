// SPDX-License-Identifier: Apache-2.0
// Compares the views of pipelined_select.sv with plain models of them, under random inputs.
module pipelined_check #(parameter N = 16, parameter K = 2, parameter WIDTH = 8) (
  input logic clk, output integer picks, output integer differences
);
  logic [N-1:0] ready = 0, ready_1 = 0, waits = 0, waits_1 = 0, chosen = 0, chosen_1 = 0, right_ready;
  logic [N*6-1:0] cool = 0, cool_1 = 0;
  logic [5:0] date = 0, date_1 = 0;
  logic [N*5-1:0] count = 0, count_1 = 0;
  logic [K*N-1:0] group = 0, group_1 = 0, right [0:1];
  logic [N-1:0] taken [0:1], now;
  wire [K*N-1:0] pick [0:1];
  wire [N-1:0] vector;
  wire [5:0] next_date;
  wire [$clog2(WIDTH)-1:0] tasks;
  wire [K*6-1:0] again;
  integer cursor [0:1], at, start, i, k, place, s, sum, cycle = 0;
  integer right_again [0:K-1];
  logic found;
  ready_vector #(.N(N)) ready_view (clk, waits, chosen, cool, date, vector);
  choose_in_turn #(.N(N), .K(K)) turn_view (clk, ready, pick[0]);
  choose_by_dates #(.N(N), .K(K)) dates_view (clk, waits, chosen, cool, date, pick[1]);
  group_dates #(.N(N), .K(K), .WIDTH(WIDTH)) group_view (clk, group, count, next_date, tasks, again);

  initial begin
    picks = 0; differences = 0;
    cursor[0] = 0; cursor[1] = 0; taken[0] = 0; taken[1] = 0;
    turn_view.from = {N{1'b1}}; turn_view.picked = 0; dates_view.from = {N{1'b1}}; dates_view.picked = 0;
    group_view.date = 0; group_view.tasks = 0;
  end

  task check(input logic good, input string what);
    if (!good) begin
      differences = differences + 1;
      if (differences < 10) $display("cycle %0d, N %0d: %s", cycle, N, what);
    end
  endtask

  task choose; // one after the other, from the cursor on
    for (s = 0; s < 2; s = s + 1) begin
      for (i = 0; i < N; i = i + 1) right_ready[i] = waits_1[i] && !chosen_1[i] && cool_1[i*6 +: 6] <= date_1;
      now = (s == 0 ? ready_1 : right_ready) & ~taken[s];
      right[s] = 0; taken[s] = 0;
      for (k = 0; k < K; k = k + 1) begin
        found = 0; start = cursor[s];
        for (i = 0; i < N; i = i + 1) begin
          at = (start + i) % N;
          if (!found && now[at]) begin
            found = 1; now[at] = 0; right[s][k*N + at] = 1; taken[s][at] = 1; cursor[s] = at + 1;
          end
        end
      end
    end
  endtask

  task count_group;
    sum = group_view.tasks;
    for (k = 0; k < K; k = k + 1) begin
      for (i = 0; i < N; i = i + 1) if (group_1[k*N + i]) sum = sum + count_1[i*5 +: 5];
      right_again[k] = group_view.date + (sum == 0 ? -1 : (sum - 1) / WIDTH) + 4;
    end
    at = group_view.date + sum / WIDTH;
  endtask

  always @(negedge clk) begin // the registered inputs of the next edge
    ready = {$urandom, $urandom} & {$urandom, $urandom}; waits = {$urandom, $urandom};
    if (cycle % 3 == 0) ready = ready & {$urandom, $urandom} & {$urandom, $urandom};
    chosen = {$urandom, $urandom} & {$urandom, $urandom}; date = $urandom_range(20); group = 0;
    for (i = 0; i < N; i = i + 1) begin
      cool[i*6 +: 6] = $urandom_range(24); count[i*5 +: 5] = 1 + $urandom_range(15);
    end
    for (k = 0; k < K; k = k + 1) begin
      place = $urandom_range(N - 1);
      group[k*N + place] = $urandom_range(3) != 0;
    end
  end
  always @(posedge clk) begin // before the edge the registers have the inputs of the edge before
    if (cycle > 0) begin
      choose; count_group;
    end
    #1;
    if (cycle > 0) begin
      for (s = 0; s < 2; s = s + 1) begin
        check(pick[s] === right[s], s == 0 ? "choice from the register" : "choice by dates");
        picks = picks + $countones(right[s]);
      end
      check(vector === right_ready, "ready domains");
      for (k = 0; k < K; k = k + 1)
        if (group_1[k*N +: N] != 0) check(again[k*6 +: 6] === right_again[k][5:0], "date of a pick");
      check(tasks === sum % WIDTH, "open packet");
      check(next_date === ((at % 64) == 0 ? 0 : at % 64 - 1), "date of the next task");
    end
    {ready_1, waits_1, chosen_1, cool_1, date_1, group_1, count_1} = {ready, waits, chosen, cool, date, group, count};
    cycle = cycle + 1;
  end
endmodule

module pipelined_test;
  logic clk = 0;
  integer picks [0:1], differences [0:1], cycle;
  pipelined_check #(.N(16), .K(2), .WIDTH(8)) small_bank (clk, picks[0], differences[0]);
  pipelined_check #(.N(48), .K(4), .WIDTH(16)) large_bank (clk, picks[1], differences[1]);
  initial begin
    for (cycle = 0; cycle < 20000; cycle = cycle + 1) begin
      #5 clk = 1; #5 clk = 0;
    end
    $display("%0d picks of a pipelined bank: %0d differences", picks[0] + picks[1], differences[0] + differences[1]);
    if (differences[0] + differences[1] != 0) $fatal(1);
    $finish;
  end
endmodule
