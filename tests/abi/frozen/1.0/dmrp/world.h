/* SPDX-License-Identifier: MIT */
// world.h: the static world of a trial, passed to start().
#ifndef DMRP_WORLD_H
#define DMRP_WORLD_H

#include "grid.h"
#include "robot.h"

#ifdef __cplusplus
extern "C" {
#endif

// Kinds of shape. Open list: a shape of a kind that a reader does not know has the vertices of a polygon that contains it.
#define DMRP_SHAPE_CIRCLE 1u
#define DMRP_SHAPE_POLYGON 2u

// A static body: a wall, a shelf, a planter. Array element.
typedef struct dmrp_shape {
  const char* name;
  uint32_t kind;              // DMRP_SHAPE_*
  uint32_t vertex_count;      // polygon
  dmrp_vec2 center;           // circle
  double radius_m;            // circle
  const dmrp_vec2* vertices;  // polygon: convex, counter-clockwise; NULL for a circle
  double height_m;
} dmrp_shape;

// Valid, with all it points to, from start() until the next start() or destroy() begins. All instances of a trial may
// get the same object. Robots are as at the start; static geometry changes within a trial only where an extension that
// the plugin asked for says so.
typedef struct dmrp_world {
  uint32_t struct_size;
  uint32_t person_count;      // the most people present at any time
  double person_radius_m;     // the largest radius of a person; 0 if it is not known
  dmrp_vec2 lower;            // lower left corner of the world, a rectangle
  dmrp_vec2 upper;            // upper right corner; the border is a wall
  int64_t step_ns;            // one physics step
  int64_t control_period_ns;  // between two calls of a controller's step()
  int64_t time_limit_ns;      // of the trial, simulated
  int64_t call_budget_ns;     // wall time for one call other than plan(); should_stop() returns 1 after it
  const dmrp_robot* robots;
  uint32_t robot_count;
  uint32_t robot_stride;
  const dmrp_shape* shapes;
  uint32_t shape_count;
  uint32_t shape_stride;
  const dmrp_segment* segments;  // outlines of all shapes and of the border, as walls for people; circles as polygons
  uint32_t segment_count;
  uint32_t reserved;
  const dmrp_grid* planning_grid;  // cells for global planners; `free` holds for every robot of the trial
} dmrp_world;

DMRP_ASSERT_SIZE(dmrp_shape, 56);
DMRP_ASSERT_SIZE(dmrp_world, 136);

#ifdef __cplusplus
}
#endif

#endif
