/* SPDX-License-Identifier: MIT */
// plugin.h: an instance of a plugin and its life cycle.
//
//   create -> start -> calls -> trial_end -> start -> calls ... -> destroy
//
// start() begins a trial, and makes an instance usable again after DMRP_ERROR. An earlier trial must not influence a
// later one: the host reuses instances for several trials, and a trial must give the same results whatever ran before.
#ifndef DMRP_PLUGIN_H
#define DMRP_PLUGIN_H

#include "descriptor.h"
#include "host.h"
#include "status.h"
#include "trial_end.h"
#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

// The plugin's own type; the host only passes the pointer back.
typedef struct dmrp_instance dmrp_instance;

#define DMRP_NO_ROBOT (-1)  // dmrp_start.robot of an instance that does not drive one robot

// What a trial begins with; made by the host for one call.
typedef struct dmrp_start {
  uint32_t struct_size;
  int32_t robot;            // index of the robot that this local controller drives; otherwise DMRP_NO_ROBOT
  uint64_t seed;            // for this instance alone; the same seed gives the same results
  const dmrp_world* world;  // valid until the next start() or destroy() begins
} dmrp_start;

// Filled in by create(); allocated, zeroed and sized by the host.
typedef struct dmrp_plugin {
  uint32_t struct_size;
  uint32_t reserved;
  dmrp_instance* self;

  // The functions of the descriptor's kind: dmrp_global_planner, dmrp_local_controller, dmrp_pedestrian_model or
  // dmrp_metric. Owned by the plugin, valid as long as the instance; the host copies it.
  const void* table;

  // Begins a trial, or says by DMRP_UNSUPPORTED that this one is not for the plugin.
  // [step]
  int32_t (*start)(dmrp_instance* self, const dmrp_start* start);

  // An extension of the plugin by its id, or NULL. The function pointer may be NULL. Valid until destroy().
  // [any]
  const void* (*get_extension)(dmrp_instance* self, const char* id);

  // Frees the instance. Allowed after any status but DMRP_FATAL.
  // [main]
  void (*destroy)(dmrp_instance* self);

  // A trial has ended: the place to free what belongs to it. Called once after the last call of the trial, unless the
  // trial ended with a fault; never for metrics, whose finish() is their end. The function pointer may be NULL.
  // Results must not depend on what it keeps.
  // [step]
  int32_t (*trial_end)(dmrp_instance* self, const dmrp_trial_end* end);
} dmrp_plugin;

DMRP_ASSERT_SIZE(dmrp_start, 24);
DMRP_ASSERT_SIZE(dmrp_plugin, 56);

#ifdef __cplusplus
}
#endif

#endif
