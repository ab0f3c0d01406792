/* SPDX-License-Identifier: MIT */
// A planner in C99 whose waypoints have velocities: each robot drives straight from goal to goal, speeding up and braking
// within its limits, and passes a waypoint every quarter of a second.
#include <dmrp/c_plugin.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/contract_wishes/plugins/waypoint_with_velocity.h"

#define WAYPOINT_NS 250000000

struct dmrp_instance {
  const dmrp_host* host;
};

// Straight from rest to rest, at most as fast as the limits allow.
typedef struct leg {
  dmrp_vec2 from;
  dmrp_vec2 direction;
  double length_m;
  double a;       // m/s2
  double v_peak;  // m/s
  double t_ramp;  // s, to speed up, and to brake
  double t_end;   // s
} leg;

static leg plan_leg(dmrp_vec2 from, dmrp_vec2 to, const dmrp_limits* limits) {
  leg l;
  l.from = from;
  l.length_m = hypot(to.x - from.x, to.y - from.y);
  l.direction.x = l.length_m > 0.0 ? (to.x - from.x) / l.length_m : 1.0;
  l.direction.y = l.length_m > 0.0 ? (to.y - from.y) / l.length_m : 0.0;
  l.a = 0.5 * limits->a_max;
  l.v_peak = fmin(0.8 * limits->v_max, sqrt(l.a * l.length_m));
  l.t_ramp = l.v_peak / l.a;
  l.t_end = l.length_m > 0.0 ? l.length_m / l.v_peak + l.t_ramp : 0.0;
  return l;
}

static double speed_at(const leg* l, double t) {
  return fmax(0.0, fmin(l->v_peak, l->a * fmin(t, l->t_end - t)));
}

static double arc_at(const leg* l, double t) {
  if (t <= l->t_ramp) return 0.5 * l->a * t * t;
  if (t >= l->t_end - l->t_ramp) return l->length_m - 0.5 * l->a * (l->t_end - t) * (l->t_end - t);
  return l->v_peak * (t - 0.5 * l->t_ramp);
}

// Appends the waypoints of a leg after the one where it begins; returns how many there are now.
static uint32_t append(const leg* l, int64_t from_ns, uint32_t goal_index, waypoint_with_velocity* to, uint32_t count) {
  const int64_t steps = (int64_t)ceil(l->t_end * 1e9 / WAYPOINT_NS);
  for (int64_t i = 1; i <= steps; ++i) {
    const double t = fmin(l->t_end, (double)(i * WAYPOINT_NS) * 1e-9);
    const double arc_m = arc_at(l, t);
    waypoint_with_velocity* at = &to[count++];
    memset(at, 0, sizeof *at);
    at->known.x = l->from.x + arc_m * l->direction.x;
    at->known.y = l->from.y + arc_m * l->direction.y;
    at->known.theta = NAN;
    at->known.t_ns = from_ns + i * WAYPOINT_NS;
    at->known.goal_index = goal_index;
    at->v = speed_at(l, t);
  }
  return count;
}

static int32_t plan_robot(const dmrp_planning_robot* robot, uint32_t index, int64_t from_ns, dmrp_plan_sink* sink) {
  const uint32_t goals = robot->state == DMRP_ROBOT_ACTIVE ? robot->goal_count : 0;
  const dmrp_limits* limits = robot->robot->limits;
  size_t room = 1;
  dmrp_vec2 at = robot->start;
  for (uint32_t i = 0; i < goals; ++i) {
    const dmrp_pose pose = DMRP_AT(dmrp_goal, robot->goals, robot->goal_stride, i)->pose;
    const dmrp_vec2 goal = {pose.x, pose.y};
    room += (size_t)ceil(plan_leg(at, goal, limits).t_end * 1e9 / WAYPOINT_NS) + 1;
    at = goal;
  }
  waypoint_with_velocity* waypoints = (waypoint_with_velocity*)calloc(room, sizeof *waypoints);
  if (!waypoints) return DMRP_OUT_OF_MEMORY;

  at = robot->start;
  uint32_t count = 1;
  waypoints[0].known.x = at.x;
  waypoints[0].known.y = at.y;
  waypoints[0].known.theta = NAN;
  waypoints[0].known.t_ns = from_ns;
  waypoints[0].known.goal_index = robot->first_goal_index;
  for (uint32_t i = 0; i < goals; ++i) {
    const dmrp_pose pose = DMRP_AT(dmrp_goal, robot->goals, robot->goal_stride, i)->pose;
    const dmrp_vec2 goal = {pose.x, pose.y};
    const leg l = plan_leg(at, goal, limits);
    count = append(&l, waypoints[count - 1].known.t_ns, robot->first_goal_index + i, waypoints, count);
    at = goal;
  }
  const dmrp_path path = {sizeof path, count, sizeof *waypoints, 0, &waypoints[0].known};
  const int32_t status = sink->path(sink, index, &path);
  free(waypoints);
  return status;
}

static int32_t plan(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink) {
  for (uint32_t i = 0; i < problem->robot_count; ++i) {
    const dmrp_planning_robot* robot = DMRP_AT(dmrp_planning_robot, problem->robots, problem->robot_stride, i);
    const int32_t status = plan_robot(robot, i, problem->effective_from_ns, sink);
    if (status != DMRP_OK) {
      self->host->set_error(self->host, "the host refused a path");
      return status;
    }
  }
  return DMRP_OK;
}

static const dmrp_global_planner planner = {.struct_size = sizeof(dmrp_global_planner), .plan = plan};

static const dmrp_planner_traits traits = {sizeof(dmrp_planner_traits), DMRP_CONNECTIVITY_ANY};

static const dmrp_descriptor kinodynamic = {.struct_size = sizeof(dmrp_descriptor),
                                            .kind = DMRP_KIND_GLOBAL_PLANNER,
                                            .id = "org.example.kinodynamic",
                                            .name = "Kinodynamic planner",
                                            .version = "0.1.0",
                                            .flags = DMRP_FLAG_UNCOORDINATED,
                                            .traits = &traits};

static int32_t start(dmrp_instance* self, const dmrp_start* start) {
  (void)self;
  (void)start;
  return DMRP_OK;
}
static void destroy(dmrp_instance* self) {
  free(self);
}

static int32_t make(const dmrp_host* host, const dmrp_descriptor* plugin, const dmrp_params* params, dmrp_plugin* out) {
  (void)plugin;
  (void)params;
  out->self = (dmrp_instance*)malloc(sizeof(dmrp_instance));
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->self->host = host;
  out->table = &planner;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_C_PLUGINS(make, &kinodynamic);
