/* SPDX-License-Identifier: MIT */
// descriptor.h: the description of a plugin. Static data, readable before init().
//
// A host skips a plugin whose kind, connectivity or parameter types it does not know, says so, and loads the others of
// the library.
#ifndef DMRP_DESCRIPTOR_H
#define DMRP_DESCRIPTOR_H

#include "parameter.h"
#include "robot.h"

#ifdef __cplusplus
extern "C" {
#endif

// Kinds of plugin; the comment names the interface of each. Open list.
#define DMRP_KIND_GLOBAL_PLANNER 1    // dmrp_global_planner
#define DMRP_KIND_LOCAL_CONTROLLER 2  // dmrp_local_controller
#define DMRP_KIND_PEDESTRIAN_MODEL 3  // dmrp_pedestrian_model
#define DMRP_KIND_METRIC 4            // dmrp_metric

// The moves that a global planner's paths use; the host checks plans accordingly. Open list.
#define DMRP_CONNECTIVITY_NONE 0   // not a planner
#define DMRP_CONNECTIVITY_4 4      // waits and orthogonal moves between cell centres, one per step
#define DMRP_CONNECTIVITY_8 8      // diagonal moves too
#define DMRP_CONNECTIVITY_ANY 255  // straight motions at any angle and speed; checked as moving discs

// Bits of descriptor.flags. Open list: a host ignores bits that it does not know.
#define DMRP_FLAG_UNCOORDINATED 1u     // planner: its paths ignore each other: conflicts are recorded, not a fault
#define DMRP_FLAG_CENTRAL 2u           // controller: one instance drives all robots, through step_all()
#define DMRP_FLAG_BACKWARDS 4u         // controller: may command v_x < 0 to robots whose limits allow it
#define DMRP_FLAG_PROCESSES 8u         // starts processes of its own, which end before destroy() returns
#define DMRP_FLAG_RESIDENT_MEMORY 16u  // maps more memory than it touches: the limit counts resident pages

// Which values are better; used to mark the best value of a column. Open list: unknown is NONE.
#define DMRP_DIRECTION_NONE 0
#define DMRP_DIRECTION_LOWER 1
#define DMRP_DIRECTION_HIGHER 2

// The subject of a metric value or event. Open list.
#define DMRP_SUBJECT_SYSTEM 0
#define DMRP_SUBJECT_ROBOT 1
#define DMRP_SUBJECT_PEDESTRIAN 2

// What a metric needs of the trace besides robots, plan, contacts: descriptor.channels. Open list (see recovery.h).
#define DMRP_CHANNEL_PEOPLE 1u  // positions and velocities of people
#define DMRP_CHANNEL_CALLS 2u   // durations of plugin calls
#define DMRP_CHANNEL_SCANS 4u   // lidar scans; reserved: samples of v1.0 contain none

// One value that a metric computes. Array element.
typedef struct dmrp_metric_value_spec {
  const char* name;         // unique among all metrics of an experiment, as in results.sqlite: "pfd_initial"
  const char* unit;         // "m", "s", "1"
  const char* description;  // one line
  uint32_t direction;       // DMRP_DIRECTION_*
  uint32_t subjects;        // one bit (1u << DMRP_SUBJECT_*) for each kind of subject that has this value
  uint32_t wall_clock;      // 1 if it depends on measured run times, and so is not repeatable to the bit
  uint32_t curve;           // 1 if it has several points, each with a coordinate
} dmrp_metric_value_spec;

typedef struct dmrp_descriptor {
  uint32_t struct_size;
  uint32_t kind;        // DMRP_KIND_*
  const char* id;       // reverse DNS in letters, digits, '.', '_' and '-'; "dmrp." is for the built-in plugins
  const char* name;     // for display
  const char* version;  // of the plugin, semantic
  const char* vendor;
  const char* license;           // SPDX expression
  const char* summary;           // one line
  const char* source;            // paper, section, equation; "" where there is none
  const char* const* requires_;  // requires_count extensions without which it cannot run
  const char* const* uses;       // uses_count extensions that it uses when available; the host gives no others
  uint32_t requires_count;
  uint32_t uses_count;
  const dmrp_param_spec* params;  // may be NULL when param_count is 0
  uint32_t param_count;
  uint32_t param_stride;
  const dmrp_metric_value_spec* values;  // metrics only
  uint32_t value_count;
  uint32_t value_stride;
  uint32_t connectivity;  // planners only: DMRP_CONNECTIVITY_*
  uint32_t channels;      // metrics only: DMRP_CHANNEL_* bits
  uint32_t flags;         // DMRP_FLAG_* bits
  uint32_t kinematics;    // controllers: the drives it can drive, bits 1u << DMRP_KINEMATICS_*; 0: differential alone
} dmrp_descriptor;

DMRP_ASSERT_SIZE(dmrp_metric_value_spec, 40);
DMRP_ASSERT_SIZE(dmrp_descriptor, 136);

#ifdef __cplusplus
}
#endif

#endif
