// SPDX-License-Identifier: Apache-2.0
// What an Issue Bank knows of its N domains beside their segments (docs/issue-bank.md): the date from
// which a domain may be touched, as a distance that falls to zero, and its ended pixels. ISSUE picks
// set dates and MESSAGES from the array end pixels in a cycle.
module domain_state #(
  parameter N = 16, parameter ISSUE = 2, parameter MESSAGES = ISSUE, parameter SEG = 16, parameter DATE = 6,
  parameter NB = $clog2(N)
) (
  input logic clk,
  input logic begins_in, input logic [SEG-1:0] outside_in, // a tile begins; pixels outside of the image
  input logic [DATE-1:0] date_in,                           // of the next task
  input logic [ISSUE-1:0] i_valid_in, input logic [ISSUE*NB-1:0] i_domain_in, input logic [ISSUE*DATE-1:0] i_date_in,
  input logic [MESSAGES-1:0] m_valid_in, input logic [MESSAGES*NB-1:0] m_domain_in,
  input logic [MESSAGES*SEG-1:0] m_mask_in,
  output logic [N-1:0] ready, output logic [N-1:0] dead, output logic [ISSUE*SEG-1:0] i_gone
);
  logic begins;
  logic [SEG-1:0] outside;
  logic [DATE-1:0] date;
  logic [ISSUE-1:0] i_valid;
  logic [ISSUE*NB-1:0] i_domain;
  logic [ISSUE*DATE-1:0] i_date;
  logic [MESSAGES-1:0] m_valid;
  logic [MESSAGES*NB-1:0] m_domain;
  logic [MESSAGES*SEG-1:0] m_mask;
  logic [N*DATE-1:0] cool, cool_now;
  logic [N*SEG-1:0] gone, gone_now;
  logic [N-1:0] ready_now, dead_now;
  logic [ISSUE*SEG-1:0] i_gone_now;
  logic [DATE-1:0] until_then;
  logic [SEG-1:0] ended;
  integer i, k, m;

  always_comb begin
    for (i = 0; i < N; i = i + 1) begin
      until_then = cool[i*DATE +: DATE];
      for (k = 0; k < ISSUE; k = k + 1)
        if (i_valid[k] && i_domain[k*NB +: NB] == i) until_then = i_date[k*DATE +: DATE];
      ready_now[i] = until_then <= date;
      cool_now[i*DATE +: DATE] = begins || until_then == 0 ? {DATE{1'b0}} : until_then - 1'b1;
      ended = gone[i*SEG +: SEG];
      for (m = 0; m < MESSAGES; m = m + 1)
        if (m_valid[m] && m_domain[m*NB +: NB] == i) ended = ended | m_mask[m*SEG +: SEG];
      gone_now[i*SEG +: SEG] = begins ? outside : ended;
      dead_now[i] = &ended;
    end
    for (k = 0; k < ISSUE; k = k + 1) i_gone_now[k*SEG +: SEG] = gone[i_domain[k*NB +: NB]*SEG +: SEG];
  end

  always_ff @(posedge clk) begin
    begins <= begins_in; outside <= outside_in; date <= date_in;
    i_valid <= i_valid_in; i_domain <= i_domain_in; i_date <= i_date_in;
    m_valid <= m_valid_in; m_domain <= m_domain_in; m_mask <= m_mask_in;
    cool <= cool_now; gone <= gone_now; ready <= ready_now; dead <= dead_now; i_gone <= i_gone_now;
  end
endmodule
