/* SPDX-License-Identifier: MIT */
// descriptor.h: what a plugin says about itself. Static data, readable before init().
#ifndef DMRP_DESCRIPTOR_H
#define DMRP_DESCRIPTOR_H

#include "parameter.h"

// Kinds of plugin; each has an interface of its own, named in brackets.
#define DMRP_KIND_GLOBAL_PLANNER 1    // dmrp_global_planner
#define DMRP_KIND_LOCAL_CONTROLLER 2  // dmrp_local_controller
#define DMRP_KIND_PEDESTRIAN_MODEL 3  // dmrp_pedestrian_model
#define DMRP_KIND_METRIC 4            // dmrp_metric

// Which moves a global planner's paths use; the host checks plans accordingly.
#define DMRP_CONNECTIVITY_NONE 0   // not a planner
#define DMRP_CONNECTIVITY_4 4      // waits and orthogonal moves between cell centres, one a step
#define DMRP_CONNECTIVITY_8 8      // diagonal moves too
#define DMRP_CONNECTIVITY_ANY 255  // straight motions at any angle and speed; checked as moving discs

// Flags of a global planner.
#define DMRP_PLANNER_UNCOORDINATED 1u  // its paths ignore each other: conflicts are recorded, not a fault

// Which way is better, for marking the best value of a column.
#define DMRP_DIRECTION_NONE 0
#define DMRP_DIRECTION_LOWER 1
#define DMRP_DIRECTION_HIGHER 2

// Whom a value of a metric speaks of.
#define DMRP_SUBJECT_SYSTEM 0
#define DMRP_SUBJECT_ROBOT 1
#define DMRP_SUBJECT_PEDESTRIAN 2

// Parts of the trace that a metric needs beside robots, plan and contacts: descriptor.channels.
#define DMRP_CHANNEL_PEOPLE 1u  // positions and velocities of people
#define DMRP_CHANNEL_CALLS 2u   // durations of plugin calls
#define DMRP_CHANNEL_SCANS 4u   // lidar scans; reserved: samples of v1.0 have none

// One value that a metric gives. Array element.
typedef struct dmrp_metric_value_spec {
  const char* name;         // unique among all metrics of an experiment, as in results.sqlite: "pfd_initial"
  const char* unit;         // "m", "s", "1"
  const char* description;  // one line
  uint32_t direction;       // DMRP_DIRECTION_*
  uint32_t subjects;        // bit (1u << DMRP_SUBJECT_*) for each kind of subject it is given for
  uint32_t wall_clock;      // 1 if it depends on measured run times, and so is not repeatable to the bit
  uint32_t curve;           // 1 if it is given for several coordinates
} dmrp_metric_value_spec;

typedef struct dmrp_descriptor {
  uint32_t struct_size;
  uint32_t kind;        // DMRP_KIND_*
  const char* id;       // reverse DNS; "dmrp." is ours
  const char* name;     // for people
  const char* version;  // of the plugin, semantic
  const char* vendor;
  const char* license;           // SPDX expression
  const char* summary;           // one line
  const char* source;            // paper, section, equation; "" where there is none
  const char* const* requires_;  // extensions without which it cannot run; requires_count
  const char* const* uses;       // extensions that it uses when there; uses_count
  uint32_t requires_count;
  uint32_t uses_count;
  const dmrp_param_spec* params;  // may be NULL when param_count is 0
  uint32_t param_count;
  uint32_t param_stride;
  const dmrp_metric_value_spec* values;  // metrics only
  uint32_t value_count;
  uint32_t value_stride;
  uint32_t connectivity;   // planners only: DMRP_CONNECTIVITY_*
  uint32_t channels;       // metrics only: DMRP_CHANNEL_* bits
  uint32_t planner_flags;  // planners only: DMRP_PLANNER_* bits
  uint32_t reserved;
} dmrp_descriptor;

DMRP_ASSERT_SIZE(dmrp_metric_value_spec, 40);
DMRP_ASSERT_SIZE(dmrp_descriptor, 136);

#endif
