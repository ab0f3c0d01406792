/* SPDX-License-Identifier: MIT */
// metric.h: measures a trial from its trace, after the trial: begin(), observe() for every sample, finish().
//
// The same code runs on live trials and on stored traces, so a metric must take all its input from these arguments and
// from extensions. start() precedes begin() as for every plugin; the world is the one stored in the trace.
#ifndef DMRP_METRIC_H
#define DMRP_METRIC_H

#include "descriptor.h"
#include "plugin.h"
#include "sample.h"
#include "trial_end.h"

#ifdef __cplusplus
extern "C" {
#endif

// The data available before the first sample. The plans and all they point to are valid until finish() returns.
typedef struct dmrp_metric_trial {
  uint32_t struct_size;
  uint32_t reserved;
  const dmrp_plan* plan;  // the first plan; NULL if planning failed or there are no robots
} dmrp_metric_trial;

// A value under one of the descriptor's names.
typedef struct dmrp_metric_result {
  uint32_t struct_size;
  uint32_t subject_kind;  // DMRP_SUBJECT_*
  const char* name;
  uint64_t subject;   // the robot's index or the person's id; ignored for the system
  double coordinate;  // NaN unless the value is a curve
  double value;       // NaN if it is undefined
} dmrp_metric_result;

// Robot or person of an event. Array element.
typedef struct dmrp_subject {
  uint32_t kind;  // DMRP_SUBJECT_*
  uint32_t reserved;
  uint64_t id;  // the robot's index or the person's id; ignored for the system
} dmrp_subject;

// How much an event matters. Open list: a host treats an unknown severity as DMRP_SEVERITY_INFO.
#define DMRP_SEVERITY_INFO 0u
#define DMRP_SEVERITY_WARNING 1u
#define DMRP_SEVERITY_SERIOUS 2u

// An event for the time line.
typedef struct dmrp_event {
  uint32_t struct_size;
  uint32_t severity;             // DMRP_SEVERITY_*
  const char* name;              // the name of a declared value, or one that the metric chooses
  int64_t from_ns;               // simulated time
  int64_t to_ns;                 // >= from_ns
  const dmrp_subject* subjects;  // may be NULL when subject_count is 0
  uint32_t subject_count;
  uint32_t subject_stride;
  dmrp_vec2 place;   // where it happened; NaN if it has no place
  const char* text;  // one line for display
} dmrp_event;

// Receives the results of a metric. All arguments are copied.
typedef struct dmrp_metric_sink dmrp_metric_sink;
struct dmrp_metric_sink {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // Returns DMRP_OK; DMRP_OUT_OF_MEMORY; or DMRP_ERROR for an undeclared name or subject, a robot that does not exist,
  // a coordinate of no curve, an infinite number, one beyond its declared range, or a value given twice.
  // [step]
  int32_t (*value)(dmrp_metric_sink* sink, const dmrp_metric_result* result);

  // Returns DMRP_OK; DMRP_OUT_OF_MEMORY; or DMRP_ERROR if there is no name, `to_ns` is before `from_ns` or a robot does
  // not exist.
  // [step]
  int32_t (*event)(dmrp_metric_sink* sink, const dmrp_event* event);
};

typedef struct dmrp_metric {
  uint32_t struct_size;
  uint32_t reserved;

  // After DMRP_ERROR from any of the three the metric has no values for this trial; the trial itself stays valid.
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

DMRP_ASSERT_SIZE(dmrp_metric_trial, 16);
DMRP_ASSERT_SIZE(dmrp_metric_result, 40);
DMRP_ASSERT_SIZE(dmrp_subject, 16);
DMRP_ASSERT_SIZE(dmrp_event, 72);
DMRP_ASSERT_SIZE(dmrp_metric_sink, 32);
DMRP_ASSERT_SIZE(dmrp_metric, 32);

#ifdef __cplusplus
}
#endif

#endif
