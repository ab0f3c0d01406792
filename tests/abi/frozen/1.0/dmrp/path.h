/* SPDX-License-Identifier: MIT */
// path.h: timed paths.
#ifndef DMRP_PATH_H
#define DMRP_PATH_H

#include "values.h"

#ifdef __cplusplus
extern "C" {
#endif

// Array element. A later minor version may append a velocity for kinodynamic paths: DMRP_STRIDE_HAS tells.
typedef struct dmrp_waypoint {
  double x;             // m
  double y;             // m
  double theta;         // heading on arrival; NaN: any
  int64_t t_ns;         // planned time of arrival since the start of the trial; for cost see global_planner.h
  uint32_t goal_index;  // the goal that this waypoint leads to (increases along a tour); ignored for inactive robots
  uint32_t reserved;
} dmrp_waypoint;

// Bits of a path's flags. Open list.
#define DMRP_PATH_PARTIAL 1u  // it ends before the goal that it leads to: more follows

// Bits that say how a path that a controller is handed differs from the one before. Open list.
#define DMRP_PATH_CONTINUES 1u  // it begins as that one and ends elsewhere: what was computed for that one still holds

// One robot's path. Repeated positions are waits. The robot rests at the last waypoint, which is a goal only if the path
// is not partial: of a planner the robot's last goal, of what a controller is handed its current one.
// Growable; an array of paths has a stride like every array.
typedef struct dmrp_path {
  uint32_t struct_size;
  uint32_t count;
  uint32_t stride;  // of waypoints: sizeof(dmrp_waypoint) as the path's maker was compiled
  uint32_t flags;   // DMRP_PATH_PARTIAL
  const dmrp_waypoint* waypoints;
} dmrp_path;

DMRP_ASSERT_SIZE(dmrp_waypoint, 40);
DMRP_ASSERT_SIZE(dmrp_path, 24);

#ifdef __cplusplus
}
#endif

#endif
