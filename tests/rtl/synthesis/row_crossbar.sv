// SPDX-License-Identifier: Apache-2.0
// A crossbar: each of OUT receivers takes in a cycle the word of one of IN senders, with registers on
// both sides. It is what a pool of Span Units needs before it, from the lanes of the Span Buffer to
// the units, and behind it, from the units to the Issue Banks (docs/span-unit.md, `span.rows: pool`).
module row_crossbar #(
  parameter IN = 12, parameter OUT = 4,
  parameter TAG = 64, // bits of a word
  parameter IB = $clog2(IN)
) (
  input logic clk,
  input logic [IN*TAG-1:0] word_in,
  input logic [OUT*IB-1:0] from_in,  // the sender that a receiver takes from
  output logic [OUT*TAG-1:0] word_out
);
  logic [IN*TAG-1:0] word;
  logic [OUT*IB-1:0] from;
  logic [OUT*TAG-1:0] word_now;
  integer i, o;

  always_comb begin
    word_now = 0;
    for (o = 0; o < OUT; o = o + 1)
      for (i = 0; i < IN; i = i + 1)
        word_now[o*TAG +: TAG] = word_now[o*TAG +: TAG] | (from[o*IB +: IB] == i ? word[i*TAG +: TAG] : {TAG{1'b0}});
  end

  always_ff @(posedge clk) begin
    word <= word_in; from <= from_in; word_out <= word_now;
  end
endmodule
