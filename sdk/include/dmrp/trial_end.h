/* SPDX-License-Identifier: MIT */
// trial_end.h: how a trial ended.
#ifndef DMRP_TRIAL_END_H
#define DMRP_TRIAL_END_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Why a trial ended. Open list.
#define DMRP_ENDING_ARRIVED 1  // all robots arrived
#define DMRP_ENDING_TIME_LIMIT 2
#define DMRP_ENDING_DEADLOCK 3  // no unfinished robot gained 0.2 m along its path for 20 s
#define DMRP_ENDING_NO_PLAN 4   // the planner found no plan: nothing moved
#define DMRP_ENDING_DESERTED 5  // there are no robots, and all people have left for good

// Why a robot failed. Open list.
#define DMRP_FAILURE_NONE 0
#define DMRP_FAILURE_TIMEOUT 1
#define DMRP_FAILURE_OSCILLATION 2  // 20 s with over 1 m of travel or 4 pi of turning but under 0.2 m of progress
#define DMRP_FAILURE_DEADLOCK 3
#define DMRP_FAILURE_CONTROLLER 4  // no command for 5 s
#define DMRP_FAILURE_NO_PLAN 5

// The outcome of one robot. Array element.
typedef struct dmrp_robot_end {
  uint32_t state;      // DMRP_ROBOT_*
  uint32_t failure;    // DMRP_FAILURE_*
  int64_t arrival_ns;  // final arrival; -1 if it did not arrive
} dmrp_robot_end;

typedef struct dmrp_trial_end {
  uint32_t struct_size;
  uint32_t ending;  // DMRP_ENDING_*
  int64_t t_ns;     // mission time
  const dmrp_robot_end* robots;
  uint32_t robot_count;
  uint32_t robot_stride;
} dmrp_trial_end;

DMRP_ASSERT_SIZE(dmrp_robot_end, 16);
DMRP_ASSERT_SIZE(dmrp_trial_end, 32);

#ifdef __cplusplus
}
#endif

#endif
