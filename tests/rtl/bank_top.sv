// SPDX-License-Identifier: Apache-2.0
// An Issue Bank with the memory of its waiting segments and its Packing Unit, as bank_test.cpp
// drives it.
module bank_top #(
  parameter STREAMS = 1, parameter SLOTS = 2, parameter CONTEXTS = 2, parameter DOMAINS = 8,
  parameter PER_ROW = 2, parameter SEG = 16, parameter DEPTH = 32, parameter CUT = 2,
  parameter SPANS = 2, parameter ISSUE = 2, parameter WIDTH = 8, parameter PACKETS = 5,
  parameter WRITES = 1, parameter REUSE = 4, parameter SELECT = 0, parameter PIXELS = 0, parameter OLDEST = 0,
  parameter ITEMS = 6, parameter MESSAGES = 4, parameter TAG = 32,
  parameter N = STREAMS * SLOTS * DOMAINS, parameter NB = $clog2(N + 1),
  parameter EB = $clog2(DEPTH + 1), parameter XB = 8, parameter TB = 8, parameter DB = 8,
  parameter COMPLETE = (WIDTH - 1 + SEG) / WIDTH > WRITES ? (WIDTH - 1 + SEG) / WIDTH : WRITES,
  parameter TASK = TAG + 5
) (
  input logic clk, input logic rst,
  input logic [MESSAGES-1:0] t_valid, input logic [MESSAGES*TB-1:0] t_tile,
  input logic [MESSAGES*DB-1:0] t_domain, input logic [MESSAGES*SEG-1:0] t_mask,
  input logic [STREAMS*2-1:0] context_free,
  input logic [STREAMS*ITEMS-1:0] s_valid, input logic [STREAMS*ITEMS-1:0] s_end,
  input logic [STREAMS*ITEMS*XB-1:0] s_row, input logic [STREAMS*ITEMS*XB-1:0] s_x0,
  input logic [STREAMS*ITEMS*XB-1:0] s_length, input logic [STREAMS*ITEMS*TB-1:0] s_tile,
  input logic [STREAMS*ITEMS*XB-1:0] s_width, input logic [STREAMS*ITEMS*TAG-1:0] s_tag,
  output logic [STREAMS*4-1:0] s_taken,
  output logic [ISSUE-1:0] i_valid, output logic [ISSUE*SEG-1:0] i_mask,
  output logic [ISSUE*NB-1:0] i_domain, output logic [4:0] i_rel,
  output logic [STREAMS*2-1:0] ended,
  output logic [COMPLETE:0] p_valid, output logic [(COMPLETE+1)*8-1:0] p_tasks,
  output logic [(COMPLETE+1)*WIDTH*TASK-1:0] p_lanes, output logic [7:0] unwritten
);
  logic [CUT-1:0] c_valid;
  logic [CUT*EB-1:0] c_entry;
  logic [CUT*8-1:0] c_item;
  logic [CUT*NB-1:0] c_domain;
  logic [7:0] c_open;
  logic [ISSUE*EB-1:0] i_entry;
  logic flush;
  issue_bank #(.STREAMS(STREAMS), .SLOTS(SLOTS), .CONTEXTS(CONTEXTS), .DOMAINS(DOMAINS), .PER_ROW(PER_ROW), .SEG(SEG),
    .DEPTH(DEPTH), .CUT(CUT), .SPANS(SPANS), .ISSUE(ISSUE), .WIDTH(WIDTH), .PACKETS(PACKETS), .WRITES(WRITES),
    .REUSE(REUSE), .SELECT(SELECT), .PIXELS(PIXELS), .OLDEST(OLDEST), .ITEMS(ITEMS), .MESSAGES(MESSAGES), .XB(XB), .TB(TB), .DB(DB))
  bank (.*);

  // What a task needs beside its pixel lies in a memory, by the place of its segment.
  logic [TAG-1:0] memory [0:DEPTH-1];
  logic [TAG-1:0] current, current_n; // of the span that is cut
  logic [CUT*TAG-1:0] cut_tag;
  logic [ISSUE*TAG-1:0] i_tag;
  integer c, e, k;
  always_comb begin
    current_n = current;
    for (c = 0; c < CUT; c++) begin
      if (c_valid[c] && c_item[c*8 +: 8] != 8'hff) current_n = s_tag[c_item[c*8 +: 8]*TAG +: TAG];
      // the lowest bits say which segment of the row it is
      cut_tag[c*TAG +: TAG] = {current_n[TAG-1:3], 3'(c_domain[c*NB +: NB] % PER_ROW)};
    end
    if (c_open != 8'hff) current_n = s_tag[c_open*TAG +: TAG];
    for (k = 0; k < ISSUE; k++) begin
      i_tag[k*TAG +: TAG] = memory[i_entry[k*EB +: EB]];
      for (c = 0; c < CUT; c++) // issued in the cycle in which it was cut
        if (c_valid[c] && c_entry[c*EB +: EB] == i_entry[k*EB +: EB]) i_tag[k*TAG +: TAG] = cut_tag[c*TAG +: TAG];
    end
  end
  always_ff @(posedge clk) begin
    current <= current_n;
    for (c = 0; c < CUT; c++) if (c_valid[c]) memory[c_entry[c*EB +: EB]] <= cut_tag[c*TAG +: TAG];
  end

  packing_unit #(.ISSUE(ISSUE), .WIDTH(WIDTH), .SEG(SEG), .TAG(TAG), .WRITES(WRITES)) packing (.*);
endmodule
