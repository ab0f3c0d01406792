/* SPDX-License-Identifier: MIT */
// global_planner.h: plans paths for all robots at once; one instance a trial, called again on every replan.
#ifndef DMRP_GLOBAL_PLANNER_H
#define DMRP_GLOBAL_PLANNER_H

#include "path.h"
#include "plugin.h"
#include "world.h"

// A robot as the planner sees it. Array element.
typedef struct dmrp_planning_robot {
  uint32_t state;          // DMRP_ROBOT_*; a robot that is not active rests at `start`: its path is that one waypoint
  uint32_t goal_count;     // goals that remain, >= 1 when active
  const dmrp_goal* goals;  // moved to the centres of their cells: paths visit and end there
  uint32_t goal_stride;
  uint32_t first_goal_index;  // index of goals[0] among all of the robot's goals
  const dmrp_robot* robot;    // kinematics, footprint, limits
  dmrp_pose pose;             // where it is
  dmrp_twist velocity;        // how it moves
  dmrp_vec2 start;            // `pose` snapped to the centre of a free cell that no other robot has: paths begin here
} dmrp_planning_robot;

typedef struct dmrp_planning_problem {
  uint32_t struct_size;
  uint32_t robot_count;
  const dmrp_planning_robot* robots;
  uint32_t robot_stride;
  uint32_t in_force_count;    // robot_count, or 0 when this is the first plan
  uint64_t revision;          // of the plan to be made: 1 for the first
  int64_t now_ns;             // simulated time
  int64_t effective_from_ns;  // when the plan takes effect: t of every first waypoint
  int64_t step_duration_ns;   // the time that one step of a step-wise planner takes
  int64_t time_budget_ns;     // wall time; should_stop() says 1 after it. Plugins read no clock
  const dmrp_grid* grid;      // world.planning_grid
  const dmrp_path* in_force;  // the plan in force, a path a robot
  uint32_t in_force_stride;
  uint32_t reserved;
} dmrp_planning_problem;

// Where a planner puts its answer. Collected while plan() runs, committed only if it returns OK or WARNING, or
// TIMEOUT with a path for every robot. All arguments are copied.
typedef struct dmrp_plan_sink dmrp_plan_sink;
struct dmrp_plan_sink {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The path of one robot, once a robot. `stride` is sizeof(dmrp_waypoint) as the plugin was compiled.
  // The first waypoint is the robot's `start` at effective_from_ns; times grow strictly; planners on the grid give
  // one waypoint a step (waits too) until the robot stays at its last goal for good.
  // Returns DMRP_OK, or DMRP_ERROR for a robot that does not exist or came before.
  // [step]
  int32_t (*path)(dmrp_plan_sink* sink, uint32_t robot, const dmrp_waypoint* waypoints, uint32_t count,
                  uint32_t stride);

  // A named number about this call. Known to the host: "cost", "lower_bound", "high_level_expanded",
  // "high_level_generated", "low_level_expanded"; others are recorded as they are. Kept also where there is no plan.
  // [step]
  void (*statistic)(dmrp_plan_sink* sink, const char* name, double value);
};

typedef struct dmrp_global_planner {
  uint32_t struct_size;
  uint32_t reserved;

  // Plans for all robots. Returns
  //   DMRP_OK           paths for all robots are in the sink
  //   DMRP_NO_SOLUTION  a start or goal is cut off, or it is proved that there is no plan
  //   DMRP_TIMEOUT      should_stop() or a cap of the planner's own ended the search
  //   DMRP_ERROR        the instance is unusable until the next start()
  // Every plan is checked by the host, by the descriptor's connectivity; an invalid one is a fault (bad_output).
  // Conflicts between robots are counted and recorded but forgiven where the descriptor is flagged
  // DMRP_PLANNER_UNCOORDINATED.
  //
  // Rationale: cost is counted in steps (or metres), time in step_duration_ns. A diagonal step takes as long as a
  // straight one, so cost and time are different things; show neither under the other's name.
  // [step]
  int32_t (*plan)(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink);
} dmrp_global_planner;

DMRP_ASSERT_SIZE(dmrp_planning_robot, 96);
DMRP_ASSERT_SIZE(dmrp_planning_problem, 88);
DMRP_ASSERT_SIZE(dmrp_plan_sink, 32);
DMRP_ASSERT_SIZE(dmrp_global_planner, 16);

#endif
