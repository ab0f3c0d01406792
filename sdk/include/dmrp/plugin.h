/* SPDX-License-Identifier: MIT */
// plugin.h: an instance of a plugin and its life.
//
//   create -> start -> calls -> start -> calls ... -> destroy
//
// start() begins a trial; after DMRP_ERROR it is also the way back. Nothing of an earlier trial may show in a later
// one: the host keeps instances over trials, and the same trial must come out the same whatever ran before it.
#ifndef DMRP_PLUGIN_H
#define DMRP_PLUGIN_H

#include "descriptor.h"
#include "host.h"
#include "status.h"
#include "world.h"

// The plugin's own; the host only hands it back.
typedef struct dmrp_instance dmrp_instance;

// Filled in by create(); allocated, zeroed and sized by the host.
typedef struct dmrp_plugin {
  uint32_t struct_size;
  uint32_t reserved;
  dmrp_instance* self;

  // The interface of the descriptor's kind: dmrp_global_planner, dmrp_local_controller, dmrp_pedestrian_model or
  // dmrp_metric. Made by the plugin, lives as long as the instance; the host copies it.
  const void* interface_;

  // Begins a trial. `seed` is the instance's own stream; the same seed gives the same results.
  // `world` lives until the next start() or destroy(). Returns DMRP_OK, DMRP_WARNING, DMRP_ERROR, DMRP_OUT_OF_MEMORY.
  // [step]
  int32_t (*start)(dmrp_instance* self, const dmrp_world* world, uint64_t seed);

  // An extension of the plugin by its id, or NULL. May be NULL itself. Valid until destroy().
  // [any]
  const void* (*get_extension)(dmrp_instance* self, const char* id);

  // Frees the instance. Allowed after any status but DMRP_FATAL.
  // [main]
  void (*destroy)(dmrp_instance* self);
} dmrp_plugin;

DMRP_ASSERT_SIZE(dmrp_plugin, 48);

#endif
