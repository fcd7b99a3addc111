// SPDX-License-Identifier: Apache-2.0
// The selection of the K oldest among N segments of the queue (docs/issue-bank.md, `scan: oldest`) by
// an age matrix: a bit for each pair says which one is older. A segment that enters is the youngest,
// so its row is cleared and its column is set. Segments ask if they are the first of their domain and
// the date of the domain is reached, which is decided one cycle earlier.
module select_oldest #(parameter N = 32, parameter K = 2, parameter IB = $clog2(N)) (
  input logic clk,
  input logic [N-1:0] asks_in,
  input logic [N-1:0] enters_in, // one that enters in this cycle
  output logic [K-1:0] valid, output logic [K*IB-1:0] pick
);
  logic [N-1:0] asks, enters;
  logic [N*N-1:0] older; // bit i * N + j with i < j: segment i is older than j; the others are unused
  logic [N-1:0] left, one;
  logic earlier;
  logic [K-1:0] valid_now;
  logic [K*IB-1:0] pick_now;
  logic [IB-1:0] index;
  integer i, j, k;

  always_comb begin
    left = asks; valid_now = 0; pick_now = 0;
    for (k = 0; k < K; k = k + 1) begin
      index = 0;
      for (i = 0; i < N; i = i + 1) begin
        earlier = 0;
        for (j = 0; j < N; j = j + 1)
          if (j < i) earlier = earlier | (left[j] & older[j*N+i]);
          else if (j > i) earlier = earlier | (left[j] & ~older[i*N+j]);
        one[i] = left[i] & ~earlier;
        index = index | (one[i] ? i[IB-1:0] : {IB{1'b0}});
      end
      valid_now[k] = left != 0;
      pick_now[k*IB +: IB] = index;
      left = left & ~one;
    end
  end

  always_ff @(posedge clk) begin
    asks <= asks_in; enters <= enters_in; valid <= valid_now; pick <= pick_now;
    for (i = 0; i < N; i = i + 1)
      for (j = i + 1; j < N; j = j + 1)
        older[i*N+j] <= (older[i*N+j] | enters[j]) & ~enters[i];
  end
endmodule
