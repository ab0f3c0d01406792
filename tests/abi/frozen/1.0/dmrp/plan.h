/* SPDX-License-Identifier: MIT */
// plan.h: the plan of all robots, as metrics see it.
#ifndef DMRP_PLAN_H
#define DMRP_PLAN_H

#include "path.h"

#ifdef __cplusplus
extern "C" {
#endif

// A named number that a planner reported. Array element.
typedef struct dmrp_statistic {
  const char* name;
  double value;
} dmrp_statistic;

// A plan and the circumstances of its planning.
typedef struct dmrp_plan {
  uint32_t struct_size;
  uint32_t path_count;  // one path per robot; 0 if there is no plan
  const dmrp_path* paths;
  uint32_t path_stride;
  uint32_t statistic_count;
  const dmrp_statistic* statistics;
  uint32_t statistic_stride;
  int32_t status;     // what plan() returned
  uint64_t revision;  // 1 for the first plan
  int64_t from_ns;    // when it took effect
  int64_t step_duration_ns;
  int64_t planning_ns;   // wall time that plan() took
  int64_t processor_ns;  // processor time of all threads of its process in plan(); -1: not known
} dmrp_plan;

DMRP_ASSERT_SIZE(dmrp_statistic, 16);
DMRP_ASSERT_SIZE(dmrp_plan, 80);

#ifdef __cplusplus
}
#endif

#endif
