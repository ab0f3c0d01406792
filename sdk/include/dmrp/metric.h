/* SPDX-License-Identifier: MIT */
// metric.h: measures a trial from its trace, after the trial: begin(), observe() for every sample, finish().
//
// The same code runs on live trials and on stored traces, so a metric must take all its input from these arguments.
// start(world, seed) precedes begin() as for every plugin; the world is the one stored in the trace.
#ifndef DMRP_METRIC_H
#define DMRP_METRIC_H

#include "path.h"
#include "person.h"
#include "plugin.h"

// A named number that a planner reported. Array element.
typedef struct dmrp_statistic {
  const char* name;
  double value;
} dmrp_statistic;

// A plan and the circumstances of its planning. Array element.
typedef struct dmrp_plan {
  uint32_t struct_size;
  uint32_t path_count;  // one path per robot
  const dmrp_path* paths;
  uint32_t path_stride;
  uint32_t statistic_count;
  const dmrp_statistic* statistics;
  uint32_t statistic_stride;
  int32_t status;     // what plan() returned
  uint64_t revision;  // 1 for the first plan
  int64_t from_ns;    // when it took effect
  int64_t step_duration_ns;
  int64_t planning_ns;  // wall time that plan() took
} dmrp_plan;

// The data available before the first sample. The plans and all they point to are valid until finish() returns.
typedef struct dmrp_metric_trial {
  uint32_t struct_size;
  uint32_t reserved;
  const dmrp_plan* plan;  // the first plan; NULL if planning failed or there are no robots
} dmrp_metric_trial;

// A robot at one sample. Array element.
typedef struct dmrp_robot_sample {
  dmrp_pose pose;
  dmrp_twist velocity;  // actual
  dmrp_twist command;   // in force, clipped to the velocity limits; `velocity` follows it within a_max, alpha_max
  uint32_t state;       // DMRP_ROBOT_*
  uint32_t goal_index;  // the current goal
  double progress_m;    // along its path in force
} dmrp_robot_sample;

#define DMRP_CONTACT_STATIC 1  // `a` a robot, `b` an index into world.shapes, or shape_count for the border
#define DMRP_CONTACT_ROBOT 2   // `a`, `b` robots, a < b
#define DMRP_CONTACT_PERSON 3  // `a` a robot, `b` an index into sample.people

#define DMRP_CONTACT_BEGINS 1u       // first sample of an event: this pair was not in contact for the last 0.5 s
#define DMRP_CONTACT_FAULT_A 2u      // robot `a` is at fault
#define DMRP_CONTACT_FAULT_B 4u      // robot `b`, or the person, is at fault
#define DMRP_CONTACT_UNAVOIDABLE 8u  // the person was not on a collision course one braking time before

// Two bodies that overlap by more than 1 mm at this sample. Array element.
typedef struct dmrp_contact {
  uint32_t kind;   // DMRP_CONTACT_*
  uint32_t flags;  // DMRP_CONTACT_BEGINS, ...; every sample of an event carries the fault
  uint32_t a;
  uint32_t b;
  double depth_m;
  dmrp_vec2 point;
} dmrp_contact;

#define DMRP_CALL_PLAN 1
#define DMRP_CALL_CONTROL 2
#define DMRP_CALL_PEOPLE 3

// A plugin call since the last sample. Array element.
typedef struct dmrp_call {
  uint32_t kind;   // DMRP_CALL_*
  uint32_t robot;  // of DMRP_CALL_CONTROL; 0 otherwise
  int32_t status;  // the returned status
  uint32_t reserved;
  int64_t duration_ns;  // wall time
} dmrp_call;

// The state after a physics step; the first sample is the state at t = 0. Valid until observe() returns.
typedef struct dmrp_sample {
  uint32_t struct_size;
  uint32_t control_tick;  // 1: t_ns is a control tick: controllers act on this state, unless the trial ends here
  int64_t t_ns;
  int64_t dt_ns;          // since the last sample; 0 for the first
  const dmrp_plan* plan;  // in force; NULL if there is none. Valid until finish() returns
  const dmrp_robot_sample* robots;
  uint32_t robot_count;
  uint32_t robot_stride;
  const dmrp_person* people;  // all present people, as a pedestrian model sees them: people come and leave
  uint32_t person_count;
  uint32_t person_stride;
  const dmrp_contact* contacts;
  uint32_t contact_count;
  uint32_t contact_stride;
  const dmrp_call* calls;
  uint32_t call_count;
  uint32_t call_stride;
} dmrp_sample;

#define DMRP_ENDING_ARRIVED 1  // all robots arrived
#define DMRP_ENDING_TIME_LIMIT 2
#define DMRP_ENDING_DEADLOCK 3  // no unfinished robot gained 0.2 m along its path for 20 s
#define DMRP_ENDING_NO_PLAN 4   // the planner found no plan: nothing moved
#define DMRP_ENDING_DESERTED 5  // there are no robots, and all people have left for good

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

// Receives the results of a metric. Texts are copied.
typedef struct dmrp_metric_sink dmrp_metric_sink;
struct dmrp_metric_sink {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // A value under one of the descriptor's names. `subject` is the robot's index or the person's id, ignored for the
  // system; `coordinate` is NaN unless the value is a curve; `value` is NaN if it is undefined.
  // Returns DMRP_OK, or DMRP_ERROR for an undeclared name or subject, a robot that does not exist, a coordinate of a
  // value that is not a curve, an infinite number, or a value given twice.
  // [step]
  int32_t (*value)(dmrp_metric_sink* sink, const char* name, uint32_t subject_kind, uint64_t subject, double coordinate,
                   double value);

  // An event from `from_ns` to `to_ns` (simulated time), for the time line. `name` is the name of a declared value or
  // one that the metric chooses, `robots` are indices, `text` is for display.
  // Returns DMRP_OK, or DMRP_ERROR if `to_ns` is before `from_ns` or a robot does not exist.
  // [step]
  int32_t (*event)(dmrp_metric_sink* sink, const char* name, int64_t from_ns, int64_t to_ns, const uint32_t* robots,
                   uint32_t robot_count, const char* text);
};

typedef struct dmrp_metric {
  uint32_t struct_size;
  uint32_t reserved;

  // All three return DMRP_OK or DMRP_ERROR. After DMRP_ERROR the metric has no values for this trial; the trial itself
  // stays valid.
  // [step]
  int32_t (*begin)(dmrp_instance* self, const dmrp_metric_trial* trial);

  // Called in order of time. A trial without robots has samples of people alone. If planning failed, nothing moves:
  // only metrics with DMRP_CHANNEL_CALLS are called then, once, with the state at t = 0, no plan, and the failed call.
  // [step]
  int32_t (*observe)(dmrp_instance* self, const dmrp_sample* sample);

  // Every declared name gets a value for the system (NaN if undefined), whatever happened in the trial: a missing value
  // is a fault (bad_output).
  // [step]
  int32_t (*finish)(dmrp_instance* self, const dmrp_trial_end* end, dmrp_metric_sink* sink);
} dmrp_metric;

DMRP_ASSERT_SIZE(dmrp_statistic, 16);
DMRP_ASSERT_SIZE(dmrp_plan, 72);
DMRP_ASSERT_SIZE(dmrp_metric_trial, 16);
DMRP_ASSERT_SIZE(dmrp_robot_sample, 88);
DMRP_ASSERT_SIZE(dmrp_contact, 40);
DMRP_ASSERT_SIZE(dmrp_call, 24);
DMRP_ASSERT_SIZE(dmrp_sample, 96);
DMRP_ASSERT_SIZE(dmrp_robot_end, 16);
DMRP_ASSERT_SIZE(dmrp_trial_end, 32);
DMRP_ASSERT_SIZE(dmrp_metric_sink, 32);
DMRP_ASSERT_SIZE(dmrp_metric, 32);

#endif
