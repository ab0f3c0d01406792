/* SPDX-License-Identifier: MIT */
// trial_end.h: how a trial ended.
#ifndef DMRP_TRIAL_END_H
#define DMRP_TRIAL_END_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Why a trial ended. Open list: a reader takes an ending that it does not know for TIME_LIMIT.
#define DMRP_ENDING_ARRIVED 1u  // all robots arrived
#define DMRP_ENDING_TIME_LIMIT 2u
#define DMRP_ENDING_DEADLOCK 3u  // nothing can move any more: a fixed point, or all wait for a robot that failed
#define DMRP_ENDING_NO_PLAN 4u   // the planner found no plan: nothing moved
#define DMRP_ENDING_DESERTED 5u  // there are no robots, and all people have left for good
#define DMRP_ENDING_OVER 6u      // no robot is active, and not all have arrived

// Why a robot failed, as the referee counts it (docs/endings.md). Open list: a reader takes a failure that it does not know for TIMEOUT.
#define DMRP_FAILURE_NONE 0u
#define DMRP_FAILURE_TIMEOUT 1u      // still made progress
#define DMRP_FAILURE_OSCILLATION 2u  // arrived after it circled, where the experiment excludes that
#define DMRP_FAILURE_CONTROLLER 4u   // no command for too long
#define DMRP_FAILURE_NO_PLAN 5u
#define DMRP_FAILURE_HELD_BEHIND 6u     // waited, as the plan's order says, behind `culprit`
#define DMRP_FAILURE_CIRCLING 7u        // travelled or turned without progress
#define DMRP_FAILURE_BLOCKED_PERSON 8u  // a person stood on the next metre of its path
#define DMRP_FAILURE_BLOCKED_ROBOT 9u   // `culprit` stood there
#define DMRP_FAILURE_STUCK 10u          // nobody held or blocked it

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
