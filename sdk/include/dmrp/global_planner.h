/* SPDX-License-Identifier: MIT */
// global_planner.h: plans paths for all robots at once. One instance per trial, called again for every replan: an
// anytime planner keeps its search between the calls and improves the plan in force.
#ifndef DMRP_GLOBAL_PLANNER_H
#define DMRP_GLOBAL_PLANNER_H

#include "path.h"
#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

// A robot as the planner sees it. Array element.
typedef struct dmrp_planning_robot {
  uint32_t state;          // DMRP_ROBOT_*; an inactive robot rests at `start`: its path is that one waypoint
  uint32_t goal_count;     // remaining goals known so far, >= 1 when active
  const dmrp_goal* goals;  // moved to the centres of their cells: paths visit these and end at the last
  uint32_t goal_stride;
  uint32_t first_goal_index;  // index of goals[0] among all of the robot's goals
  const dmrp_robot* robot;    // element i of world.robots, of stride world.robot_stride: kinematics, footprint, limits
  const dmrp_grid* grid;      // the cells of problem.grid, with `free` and `edges` for this robot's footprint
  dmrp_pose pose;             // its present pose
  dmrp_twist velocity;        // its present velocity
  dmrp_vec2 start;            // `pose` snapped to the centre of a free cell of its own: its path begins here
  int64_t waiting_ns;         // simulated time since it last made progress: a priority that needs no memory
} dmrp_planning_robot;

typedef struct dmrp_planning_problem {
  uint32_t struct_size;
  uint32_t robot_count;
  const dmrp_planning_robot* robots;
  uint32_t robot_stride;
  uint32_t in_force_count;    // robot_count, or 0 when this is the first plan
  uint64_t revision;          // of the plan to be made: 1 for the first
  int64_t now_ns;             // simulated time
  int64_t effective_from_ns;  // when the plan takes effect: t_ns of every first waypoint
  int64_t step_duration_ns;   // duration of one step of a step-wise planner
  int64_t time_budget_ns;     // wall time; should_stop() returns 1 after it. Plugins read no clock
  const dmrp_grid* grid;      // world.planning_grid: `free` and `edges` hold for every robot
  const dmrp_path* in_force;  // the plan in force, one path per robot
  uint32_t in_force_stride;
  // Asked of a planner with DMRP_FLAG_WINDOWED: paths are free of conflicts until the window's end, effective_from_ns +
  // window_steps * step_duration_ns, and partial where they end before the last goal. Their last places differ. A longer
  // path is cut at its last waypoint not after that end. 0: the whole way.
  uint32_t window_steps;
} dmrp_planning_problem;

// Receives the result of plan(). The host collects while plan() runs and commits only if it returns DMRP_OK or
// DMRP_WARNING, or DMRP_TIMEOUT with a path for every robot. All arguments are copied.
typedef struct dmrp_plan_sink dmrp_plan_sink;
struct dmrp_plan_sink {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The path of one robot; call it once per robot.
  // The first waypoint is the robot's `start` at effective_from_ns; times increase strictly; planners on the grid give
  // one waypoint per step (waits too) until the robot stays at its last goal for good, or the window ends.
  // Returns DMRP_OK; DMRP_OUT_OF_MEMORY; or DMRP_ERROR for a robot that does not exist or already has a path, or a path
  // that is not readable.
  // [step]
  int32_t (*path)(dmrp_plan_sink* sink, uint32_t robot, const dmrp_path* path);

  // A named number about this call. The host knows "cost", "lower_bound", "high_level_expanded",
  // "high_level_generated" and "low_level_expanded" and records any other name as given. Kept even if there is no plan.
  // Returns DMRP_OK; DMRP_OUT_OF_MEMORY; or DMRP_ERROR without a name.
  // [step]
  int32_t (*statistic)(dmrp_plan_sink* sink, const char* name, double value);
};

typedef struct dmrp_global_planner {
  uint32_t struct_size;
  uint32_t reserved;

  // Plans for all robots. Returns
  //   DMRP_OK           paths for all robots are in the sink
  //   DMRP_NO_SOLUTION  a start or goal is unreachable, or the planner proved that no plan exists
  //   DMRP_UNSUPPORTED  the problem is not for this planner
  //   DMRP_TIMEOUT      should_stop() or one of the planner's own limits ended the search
  //   DMRP_ERROR        the instance is unusable until the next start()
  // The host checks every plan against the descriptor's connectivity; an invalid plan is a fault (bad_output).
  // If the descriptor has DMRP_FLAG_UNCOORDINATED, the host counts and records conflicts between robots and accepts
  // the plan.
  //
  // Rationale: cost is measured in steps (or metres), time in multiples of step_duration_ns. A diagonal step takes as
  // long as a straight one, so cost and time differ; never report one under the name of the other.
  // [step]
  int32_t (*plan)(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink);
} dmrp_global_planner;

DMRP_ASSERT_SIZE(dmrp_planning_robot, 112);
DMRP_ASSERT_SIZE(dmrp_planning_problem, 88);
DMRP_ASSERT_SIZE(dmrp_plan_sink, 32);
DMRP_ASSERT_SIZE(dmrp_global_planner, 16);

#ifdef __cplusplus
}
#endif

#endif
