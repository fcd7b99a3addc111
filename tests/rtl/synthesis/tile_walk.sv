// SPDX-License-Identifier: Apache-2.0
// The Tile Binner's walk over the tiles of a splat's bounding box (docs/tile-lists.md): PAIRS tiles
// per cycle, row by row, each as a number and an address in its list. The ends of the lists are a
// memory outside, which gives PAIRS of them and takes them back.
module tile_walk #(
  parameter PAIRS = 8,
  parameter XB = 9,    // bits of a column or row of tiles
  parameter TB = 16,   // bits of the number of a tile
  parameter AB = 32    // bits of an address
) (
  input logic clk,
  input logic start_in,
  input logic [XB-1:0] x0_in, input logic [XB-1:0] x1_in, input logic [XB-1:0] y0_in, input logic [XB-1:0] y1_in,
  input logic [TB-1:0] row_tiles_in,      // tiles in a row of the image
  input logic [PAIRS*AB-1:0] list_end_in, // of the tiles named in the last cycle
  output logic [PAIRS-1:0] valid, output logic [PAIRS*TB-1:0] tile,
  output logic [PAIRS*AB-1:0] address, output logic [PAIRS*AB-1:0] list_end
);
  logic busy, busy_now;
  logic [XB-1:0] x, y, x0, x1, y1, x_now, y_now;
  logic [TB-1:0] row, row_now, row_tiles; // number of the first tile of the row
  logic [PAIRS-1:0] valid_now;
  logic [PAIRS*TB-1:0] tile_now;
  logic [PAIRS*AB-1:0] grown;
  integer p;

  always_comb begin
    busy_now = busy; x_now = x; y_now = y; row_now = row;
    valid_now = 0; tile_now = 0; grown = 0;
    for (p = 0; p < PAIRS; p = p + 1) begin
      valid_now[p] = busy_now;
      tile_now[p*TB +: TB] = row_now + x_now;
      if (x_now != x1) x_now = x_now + 1;
      else begin
        if (y_now == y1) busy_now = 0;
        x_now = x0; y_now = y_now + 1; row_now = row_now + row_tiles;
      end
      grown[p*AB +: AB] = list_end_in[p*AB +: AB] + 8;
    end
  end

  always_ff @(posedge clk) begin
    if (start_in) begin
      busy <= 1; x <= x0_in; y <= y0_in; x0 <= x0_in; x1 <= x1_in; y1 <= y1_in;
      row_tiles <= row_tiles_in; row <= y0_in * row_tiles_in;
    end else begin
      busy <= busy_now; x <= x_now; y <= y_now; row <= row_now;
    end
    valid <= valid_now; tile <= tile_now; address <= list_end_in; list_end <= grown;
  end
endmodule
