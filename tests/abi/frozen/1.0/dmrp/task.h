/* SPDX-License-Identifier: MIT */
// task.h: tasks that arrive during a trial, as planners and metrics see them.
#ifndef DMRP_TASK_H
#define DMRP_TASK_H

#include "robot.h"

#ifdef __cplusplus
extern "C" {
#endif

// Places that one robot has to visit in order. Array element.
typedef struct dmrp_task {
  uint64_t id;          // stable, from 1 in the order of release
  int64_t released_ns;  // simulated time from which on it may be given to a robot
  uint32_t errand_count;
  uint32_t errand_stride;
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

DMRP_ASSERT_SIZE(dmrp_task, 32);
DMRP_ASSERT_SIZE(dmrp_task_event, 48);

#ifdef __cplusplus
}
#endif

#endif
