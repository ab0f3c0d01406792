/* SPDX-License-Identifier: MIT */
// draft/tasks.h: tasks that arrive during a trial, commitment to a plan, and costs of edges, as a later minor version may
// have them. No promise covers this folder (VERSIONING.md), and no host or plugin of 1.0 uses it: it takes part in the
// contract when a host fills it, a plugin reads it and a case of `dmrp-host check` drives it.
#ifndef DMRP_DRAFT_TASKS_H
#define DMRP_DRAFT_TASKS_H

#include "../global_planner.h"
#include "../sample.h"

#ifdef __cplusplus
extern "C" {
#endif

// A robot that stands where it is until it is repaired. A state and no flag: a reader of 1.0 takes a state that it does
// not know for a failed robot, which is right, and would have ignored a flag.
#define DMRP_ROBOT_BROKEN 3u

// Bits of a descriptor's flags.
#define DMRP_FLAG_ASSIGNS 64u    // planner: gives tasks to robots, through assign()
#define DMRP_FLAG_COMMITS 128u   // planner: its paths begin with the committed steps; for others the host prepends them
#define DMRP_FLAG_PARALLEL 256u  // instances of this library may be called at the same time
// Controller, with CENTRAL: central in form only. The command of a robot depends on what that robot alone was given.
#define DMRP_FLAG_BATCHED 512u

#define DMRP_CHANNEL_TASKS 32u  // of a metric: tasks, released and done
#define DMRP_CHANNEL_SCANS 64u  // lidar scans
#define DMRP_CALL_ASSIGN 4u     // a kind of call

// Places that one robot has to visit in order. Array element.
typedef struct dmrp_task {
  uint64_t id;          // stable, from 1 in the order of release
  int64_t released_ns;  // simulated time from which on it may be given to a robot
  uint32_t robot;       // its holder; DMRP_NOBODY while it is open
  uint32_t errand_count;
  uint32_t errand_stride;
  uint32_t reserved;
  const dmrp_goal* errands;  // those that are still to be visited
} dmrp_task;

// Kinds of task event. Open list: a reader skips an event of a kind that it does not know.
#define DMRP_TASK_RELEASED 1u
#define DMRP_TASK_ASSIGNED 2u
#define DMRP_TASK_UNASSIGNED 3u
#define DMRP_TASK_VISITED 4u  // an errand of it
#define DMRP_TASK_DONE 5u     // the last one

// Something that happened to a task since the last sample. Array element.
typedef struct dmrp_task_event {
  int64_t t_ns;  // simulated time
  uint64_t task;
  uint32_t kind;        // DMRP_TASK_*
  uint32_t robot;       // DMRP_NOBODY when it is released
  uint32_t goal_index;  // of ASSIGNED and VISITED: the robot's goal that the first errand is or becomes
  uint32_t errand_count;
  uint32_t errand_stride;
  uint32_t reserved;
  const dmrp_goal* errands;  // of RELEASED and ASSIGNED those to be visited, of VISITED the one that was
} dmrp_task_event;

// What is appended to dmrp_sample.
typedef struct dmrp_sample_tasks {
  const dmrp_task_event* task_events;  // in order of time
  uint32_t task_event_count;
  uint32_t task_event_stride;
} dmrp_sample_tasks;

// What is appended to dmrp_planning_robot.
typedef struct dmrp_planning_commitment {
  uint32_t
      committed_steps;  // of a planner with DMRP_FLAG_COMMITS: its path begins with as many steps of the plan in force
  uint32_t may_move;    // 1: it has no task: its goal is a proposal, and its path may end anywhere
  int64_t until_ns;     // of a broken robot: it stands until then; 0 otherwise
} dmrp_planning_commitment;

// What is appended to dmrp_grid. Costs of edges are constant as long as the id is.
typedef struct dmrp_grid_costs {
  uint64_t id;  // grids with equal ids have equal arrays: a key for tables; 0: none
  // What a move costs beyond its length, in hundredths of a step: 8 for each cell, in the order of the edge bits. A
  // planner's cost and lower bound include it. NULL: nothing.
  const uint16_t* edge_cost;
} dmrp_grid_costs;

// Robots that may get a task, and tasks; made by the host for one call of assign().
typedef struct dmrp_assignment {
  uint32_t struct_size;
  uint32_t robot_count;
  const dmrp_planning_robot* robots;  // all, as for plan()
  uint32_t robot_stride;
  uint32_t task_stride;
  const dmrp_task* tasks;  // not done, in order of release
  uint32_t task_count;
  uint32_t reserved;
  int64_t now_ns;         // simulated time
  const dmrp_grid* grid;  // world.planning_grid
} dmrp_assignment;

// Receives the result of assign(). The host commits only if it returns DMRP_OK or DMRP_WARNING.
typedef struct dmrp_assignment_sink dmrp_assignment_sink;
struct dmrp_assignment_sink {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The robot does this task next. A task that was given to another robot, which has not visited its first errand, goes
  // over to this one. Returns DMRP_OK; DMRP_OUT_OF_MEMORY; or DMRP_ERROR for a robot or a task that is not in the
  // problem, or one of them given twice.
  // [step]
  int32_t (*give)(dmrp_assignment_sink* sink, uint32_t robot, uint64_t task);
};

// What is appended to dmrp_global_planner.
typedef struct dmrp_task_assigner {
  // With DMRP_FLAG_ASSIGNS: gives open tasks to robots, whenever a task or a robot has become free. NULL without the
  // flag. A host without tasks does not call it.
  // [step]
  int32_t (*assign)(dmrp_instance* self, const dmrp_assignment* problem, dmrp_assignment_sink* sink);
} dmrp_task_assigner;

DMRP_ASSERT_SIZE(dmrp_task, 40);
DMRP_ASSERT_SIZE(dmrp_task_event, 48);
DMRP_ASSERT_SIZE(dmrp_sample_tasks, 16);
DMRP_ASSERT_SIZE(dmrp_planning_commitment, 16);
DMRP_ASSERT_SIZE(dmrp_grid_costs, 16);
DMRP_ASSERT_SIZE(dmrp_assignment, 56);
DMRP_ASSERT_SIZE(dmrp_assignment_sink, 24);
DMRP_ASSERT_SIZE(dmrp_task_assigner, 8);

#ifdef __cplusplus
}
#endif

#endif
