/* SPDX-License-Identifier: MIT */
// ext/walking_grid.h: the free space as cells of any size for a disc of any radius, for people or for measuring ways.
// An extension of the host for pedestrian models and metrics, computed when it is asked for.
#ifndef DMRP_EXT_WALKING_GRID_H
#define DMRP_EXT_WALKING_GRID_H

#include "../grid.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_WALKING_GRID "dmrp.walking_grid/1"

typedef struct dmrp_walking_grid_request {
  uint32_t struct_size;
  uint32_t reserved;
  double resolution_m;  // > 0
  double radius_m;      // >= 0; world.person_radius_m is that of the scenario's people
} dmrp_walking_grid_request;

typedef struct dmrp_walking_grid dmrp_walking_grid;
struct dmrp_walking_grid {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The grid of the world, whose `free` and `edges` hold for a disc of this radius. Where a gap is wide enough for it,
  // but no cell's centre lies in its middle, cells that the disc can pass beside their centre are free, too. Equal requests get the same grid at
  // no cost. NULL for a resolution or radius out of range, for one that gives more than 100 million cells, and for a
  // request with a reserved field that is not 0. Valid until the next start() or destroy() begins.
  // [step]
  const dmrp_grid* (*grid)(const dmrp_walking_grid* extension, const dmrp_walking_grid_request* request);
};

DMRP_ASSERT_SIZE(dmrp_walking_grid_request, 24);
DMRP_ASSERT_SIZE(dmrp_walking_grid, 24);

#ifdef __cplusplus
}
#endif

#endif
