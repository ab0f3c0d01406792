/* SPDX-License-Identifier: MIT */
// ext/local_costmap.h: a rolling window of obstacles around the robot, built by marking and clearing on every scan.
// Costs as in ROS costmap_2d. An extension of the host for local controllers.
#ifndef DMRP_EXT_LOCAL_COSTMAP_H
#define DMRP_EXT_LOCAL_COSTMAP_H

#include "../values.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_LOCAL_COSTMAP "dmrp.local_costmap/1"

#define DMRP_COST_FREE 0
#define DMRP_COST_INSCRIBED 253  // a robot whose centre is in the cell certainly collides
#define DMRP_COST_LETHAL 254     // an obstacle is in the cell

// Cells as in dmrp_grid: row-major from the lower left, aligned with the world's axes.
typedef struct dmrp_costmap {
  uint32_t struct_size;
  uint32_t width;
  uint32_t height;
  uint32_t reserved;
  int64_t t_ns;  // of the scan of the last update
  double resolution_m;
  dmrp_vec2 origin;           // lower left corner of the lower left cell
  double inscribed_radius_m;  // cells nearer to an obstacle have DMRP_COST_INSCRIBED
  double inflation_radius_m;  // cells farther from every obstacle are free
  double cost_scaling;        // 1/m: cost = 252 exp(-cost_scaling (distance - inscribed_radius_m)) in between
  const uint8_t* costs;
} dmrp_costmap;

typedef struct dmrp_local_costmap dmrp_local_costmap;
struct dmrp_local_costmap {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The costmap of a robot. Valid until the current call of step() or
  // step_all() returns. NULL for a robot that the instance does not drive.
  // [step]
  const dmrp_costmap* (*costmap)(const dmrp_local_costmap* extension, uint32_t robot);
};

DMRP_ASSERT_SIZE(dmrp_costmap, 80);
DMRP_ASSERT_SIZE(dmrp_local_costmap, 24);

#ifdef __cplusplus
}
#endif

#endif
