/* SPDX-License-Identifier: MIT */
// trial_end.h: how a trial ended.
#ifndef DMRP_TRIAL_END_H
#define DMRP_TRIAL_END_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_NOBODY 0xFFFFFFFFu  // no robot

// Why a trial ended. Open list.
#define DMRP_ENDING_ARRIVED 1  // all robots arrived
#define DMRP_ENDING_TIME_LIMIT 2
#define DMRP_ENDING_DEADLOCK 3  // nothing can move any more: a fixed point, or all wait for a robot that failed
#define DMRP_ENDING_NO_PLAN 4   // the planner found no plan: nothing moved
#define DMRP_ENDING_DESERTED 5  // there are no robots, and all people have left for good
#define DMRP_ENDING_OVER 6      // no robot is active, and not all have arrived

// Why a robot failed. Open list.
#define DMRP_FAILURE_NONE 0
#define DMRP_FAILURE_TIMEOUT 1      // still made progress
#define DMRP_FAILURE_OSCILLATION 2  // arrived after it circled, where the experiment excludes that
#define DMRP_FAILURE_DEADLOCK 3     // no host of draft 2 gives it
#define DMRP_FAILURE_CONTROLLER 4   // no command for 5 s
#define DMRP_FAILURE_NO_PLAN 5
#define DMRP_FAILURE_HELD_BEHIND 6     // waited, as the plan's order says, behind `culprit`
#define DMRP_FAILURE_CIRCLING 7        // travelled or turned without progress
#define DMRP_FAILURE_BLOCKED_PERSON 8  // a person stood on the next metre of its path
#define DMRP_FAILURE_BLOCKED_ROBOT 9   // `culprit` stood there
#define DMRP_FAILURE_STUCK 10          // nobody held or blocked it

// The outcome of one robot. Array element.
typedef struct dmrp_robot_end {
  uint32_t state;      // DMRP_ROBOT_*
  uint32_t failure;    // DMRP_FAILURE_*
  int64_t arrival_ns;  // when it parked at its last goal; -1: never
  uint32_t visits;     // goals that it visited; more than its goals if it left its last one and came back
  uint32_t culprit;    // the robot that the failure names, through all that wait; DMRP_NOBODY otherwise
} dmrp_robot_end;

typedef struct dmrp_trial_end {
  uint32_t struct_size;
  uint32_t ending;  // DMRP_ENDING_*
  int64_t t_ns;     // mission time
  const dmrp_robot_end* robots;
  uint32_t robot_count;
  uint32_t robot_stride;
} dmrp_trial_end;

DMRP_ASSERT_SIZE(dmrp_robot_end, 24);
DMRP_ASSERT_SIZE(dmrp_trial_end, 32);

#ifdef __cplusplus
}
#endif

#endif
