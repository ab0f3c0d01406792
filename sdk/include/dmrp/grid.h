/* SPDX-License-Identifier: MIT */
// grid.h: the free space as square cells.
#ifndef DMRP_GRID_H
#define DMRP_GRID_H

#include "values.h"

#ifdef __cplusplus
extern "C" {
#endif

// Bits of an edge mask: the eight moves out of a cell, counter-clockwise from +x. Edges are mutual: if a move is open,
// so is the move back.
#define DMRP_EDGE_E 0x01u
#define DMRP_EDGE_NE 0x02u
#define DMRP_EDGE_N 0x04u
#define DMRP_EDGE_NW 0x08u
#define DMRP_EDGE_W 0x10u
#define DMRP_EDGE_SW 0x20u
#define DMRP_EDGE_S 0x40u
#define DMRP_EDGE_SE 0x80u

// Cells are row-major from the lower left: index = row * width + column; +column is +x, +row is +y.
// The centre of a cell is origin + ((column + 0.5), (row + 0.5)) * resolution_m.
// Arrays have width * height elements, are not NULL, and are valid as long as the struct.
typedef struct dmrp_grid {
  uint32_t struct_size;
  uint32_t width;   // columns
  uint32_t height;  // rows
  uint32_t reserved;
  double resolution_m;
  dmrp_vec2 origin;        // lower left corner of the lower left cell
  const uint8_t* free;     // 1: a robot's centre may stand on this cell's centre
  const uint8_t* edges;    // bit DMRP_EDGE_*: the footprint swept along the move stays free, and both cells are free;
                           // for a diagonal move the two cells beside it are free too
  const float* clearance;  // m from the cell's centre to the nearest static shape or border; 0 inside a shape
} dmrp_grid;

DMRP_ASSERT_SIZE(dmrp_grid, 64);

#ifdef __cplusplus
}
#endif

#endif
