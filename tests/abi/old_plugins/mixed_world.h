/* SPDX-License-Identifier: MIT */
// mixed_world.h: mixes all that a plugin is shown of the static world.
#ifndef MIXED_WORLD_H
#define MIXED_WORLD_H

#include <dmrp/world.h>

#include "tests/abi/old_plugins/mixed.h"

static inline void mix_limits(mixed* all, const dmrp_limits* limits) {
  mix(all, limits->v_min), mix(all, limits->v_max), mix(all, limits->v_y_max), mix(all, limits->omega_max);
  mix(all, limits->a_max), mix(all, limits->alpha_max), mix(all, limits->wheelbase_m);
  mix(all, limits->steering_max), mix(all, limits->steering_rate_max);
}
static inline void mix_footprint(mixed* all, const dmrp_footprint* footprint) {
  mix(all, footprint->part_count), mix(all, footprint->radius_m), mix(all, footprint->inscribed_radius_m);
}
static inline void mix_goal(mixed* all, const dmrp_goal* goal) {
  mix_pose(all, goal->pose), mix(all, goal->tolerance_m), mix(all, goal->tolerance_rad);
  mix(all, goal->tolerance_speed), mix_time(all, goal->settle_ns);
}
static inline void mix_grid(mixed* all, const dmrp_grid* grid) {
  mix(all, grid->width), mix(all, grid->height), mix(all, grid->resolution_m), mix_vec2(all, grid->origin);
  for (uint32_t i = 0; i < grid->width * grid->height; ++i)
    mix(all, grid->free[i]), mix(all, grid->edges[i]), mix(all, (double)grid->clearance[i]);
}
static inline void mix_robot(mixed* all, const dmrp_robot* robot) {
  mix_text(all, robot->name), mix_text(all, robot->type), mix(all, robot->kinematics);
  for (uint32_t i = 0; i < robot->goal_count; ++i)
    mix_goal(all, DMRP_AT(dmrp_goal, robot->goals, robot->goal_stride, i));
  mix_limits(all, robot->limits), mix_footprint(all, robot->footprint), mix_pose(all, robot->start);
}
static inline void mix_world(mixed* all, const dmrp_world* world) {
  mix(all, world->person_count), mix(all, world->person_radius_m), mix_vec2(all, world->lower);
  mix_vec2(all, world->upper), mix_time(all, world->step_ns), mix_time(all, world->control_period_ns);
  mix_time(all, world->time_limit_ns);
  for (uint32_t i = 0; i < world->robot_count; ++i)
    mix_robot(all, DMRP_AT(dmrp_robot, world->robots, world->robot_stride, i));
  for (uint32_t i = 0; i < world->shape_count; ++i) {
    const dmrp_shape* shape = DMRP_AT(dmrp_shape, world->shapes, world->shape_stride, i);
    mix_text(all, shape->name), mix(all, shape->kind), mix_vec2(all, shape->center), mix(all, shape->radius_m);
    for (uint32_t k = 0; k < shape->vertex_count; ++k) mix_vec2(all, shape->vertices[k]);
    mix(all, shape->height_m);
  }
  for (uint32_t i = 0; i < world->segment_count; ++i)
    mix_vec2(all, world->segments[i].from), mix_vec2(all, world->segments[i].to);
  if (world->planning_grid) mix_grid(all, world->planning_grid);
}

#endif
