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
#define DMRP_KIND_GLOBAL_PLANNER 1u    // dmrp_global_planner
#define DMRP_KIND_LOCAL_CONTROLLER 2u  // dmrp_local_controller
#define DMRP_KIND_PEDESTRIAN_MODEL 3u  // dmrp_pedestrian_model
#define DMRP_KIND_METRIC 4u            // dmrp_metric

// The moves that a global planner's paths use; the host checks plans accordingly. Open list.
#define DMRP_CONNECTIVITY_NONE 0u   // not a planner
#define DMRP_CONNECTIVITY_4 4u      // waits and orthogonal moves between cell centres, one per step
#define DMRP_CONNECTIVITY_8 8u      // diagonal moves too
#define DMRP_CONNECTIVITY_ANY 255u  // straight motions at any angle and speed; checked as moving discs

// Bits of a descriptor's flags. Open list: a host ignores bits that it does not know, but for DMRP_FLAGS_NEEDED.
#define DMRP_FLAG_UNCOORDINATED 1u     // planner: its paths ignore each other: conflicts are recorded, not a fault
#define DMRP_FLAG_CENTRAL 2u           // controller: one instance drives the robots of its fleet, by step_all()
#define DMRP_FLAG_BACKWARDS 4u         // controller: may command v_x < 0 to robots whose limits allow it
#define DMRP_FLAG_PROCESSES 8u         // starts processes of its own, which end before destroy() returns
#define DMRP_FLAG_RESIDENT_MEMORY 16u  // maps more memory than it touches: the limit counts resident pages
#define DMRP_FLAG_WINDOWED 32u         // planner: can plan the next problem.window_steps alone

// These bits are for plugins that a host must understand: one that does not know such a bit skips the plugin.
#define DMRP_FLAGS_NEEDED 0xffff0000u

// Which values are better; used to mark the best value of a column. Open list: unknown is NONE.
#define DMRP_DIRECTION_NONE 0u
#define DMRP_DIRECTION_LOWER 1u
#define DMRP_DIRECTION_HIGHER 2u

// The subject of a metric value or event. Open list: a reader skips what is about a subject that it does not know.
#define DMRP_SUBJECT_SYSTEM 0u
#define DMRP_SUBJECT_ROBOT 1u
#define DMRP_SUBJECT_PEDESTRIAN 2u

// What a metric needs of the trace besides robots, plan, contacts: bits of the channels of its traits. Of what it does not
// declare it gets none: a count of 0. Open list.
#define DMRP_CHANNEL_PEOPLE 1u  // positions and velocities of people
#define DMRP_CHANNEL_CALLS 2u   // durations of plugin calls
// Recoveries, and what a monitor or a route did: events. An experiment that names no metrics measures such a metric only where robots have recoveries.
#define DMRP_CHANNEL_RECOVERIES 8u
#define DMRP_CHANNEL_ROUTES 16u  // what controllers were handed to follow

// One value that a metric computes. Array element.
typedef struct dmrp_metric_value_spec {
  const char* name;         // unique among all metrics of an experiment, as in results.sqlite: "pfd_initial"
  const char* unit;         // "m", "s", "1"
  const char* description;  // one line
  uint32_t direction;       // DMRP_DIRECTION_*
  uint32_t subjects;        // one bit (1u << DMRP_SUBJECT_*) for each kind of subject that has this value
  uint32_t wall_clock;      // 1 if it depends on measured run times, and so is not repeatable to the bit
  uint32_t curve;           // 1 if it has several points, each with a coordinate
  // What it can be, both ends included; INFINITY where there is no end. A host refuses what lies beyond, and draws no
  // interval beyond. Both 0: not said.
  double minimum;
  double maximum;
} dmrp_metric_value_spec;

// What a planner says about itself.
typedef struct dmrp_planner_traits {
  uint32_t struct_size;
  uint32_t connectivity;  // DMRP_CONNECTIVITY_*
} dmrp_planner_traits;

// What a controller says about itself.
typedef struct dmrp_controller_traits {
  uint32_t struct_size;
  uint32_t kinematics;  // the drives it can drive, bits 1u << DMRP_KINEMATICS_*; 0: differential alone
} dmrp_controller_traits;

// What a metric says about itself.
typedef struct dmrp_metric_traits {
  uint32_t struct_size;
  uint32_t channels;  // DMRP_CHANNEL_* bits
  const dmrp_metric_value_spec* values;
  uint32_t value_count;
  uint32_t value_stride;
} dmrp_metric_traits;

typedef struct dmrp_descriptor {
  uint32_t struct_size;
  uint32_t kind;     // DMRP_KIND_*
  const char* id;    // reverse DNS in letters, digits, '.', '_' and '-': "org.example.dwa"; "dmrp." is for the built-in
  const char* name;  // for display: "DWA"
  const char* version;     // of the plugin, semantic: "1.4.2"
  const char* vendor;      // "Example Robotics Lab"
  const char* license;     // SPDX expression: "MIT"
  const char* url;         // its home: "https://example.org/dwa"; NULL or "" where there is none, as the next
  const char* manual_url;  // "https://example.org/dwa/manual"
  const char* summary;     // one line: "drives by sampling velocities, Fox et al. 1997"
  const char* source;      // paper, section, equation: "Fox, Burgard, Thrun 1997, eq. 13"; "" where there is none
  // Words to search for, with a NULL after the last: {"sampling", "anytime", NULL}. NULL: none.
  const char* const* features;
  const char* const* needed;  // needed_count extensions without which it cannot run
  const char* const* uses;    // uses_count extensions that it uses when available; the host gives no others
  uint32_t needed_count;
  uint32_t uses_count;
  const dmrp_param_spec* params;  // may be NULL when param_count is 0
  uint32_t param_count;
  uint32_t param_stride;
  uint32_t flags;  // DMRP_FLAG_* bits
  uint32_t reserved;
  // dmrp_planner_traits, dmrp_controller_traits or dmrp_metric_traits, by `kind`; static as the descriptor. NULL for
  // another kind, and for a controller of differential drives alone.
  const void* traits;
} dmrp_descriptor;

DMRP_ASSERT_SIZE(dmrp_metric_value_spec, 56);
DMRP_ASSERT_SIZE(dmrp_planner_traits, 8);
DMRP_ASSERT_SIZE(dmrp_controller_traits, 8);
DMRP_ASSERT_SIZE(dmrp_metric_traits, 24);
DMRP_ASSERT_SIZE(dmrp_descriptor, 144);

#ifdef __cplusplus
}
#endif

#endif
