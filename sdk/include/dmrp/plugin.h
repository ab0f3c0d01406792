/* SPDX-License-Identifier: MIT */
// plugin.h: an instance of a plugin and its life cycle.
//
//   create -> start -> calls -> start -> calls ... -> destroy
//
// start() begins a trial, and makes an instance usable again after DMRP_ERROR. An earlier trial must not influence a
// later one: the host reuses instances for several trials, and a trial must give the same results whatever ran before.
#ifndef DMRP_PLUGIN_H
#define DMRP_PLUGIN_H

#include "descriptor.h"
#include "host.h"
#include "status.h"
#include "world.h"

// The plugin's own type; the host only passes the pointer back.
typedef struct dmrp_instance dmrp_instance;

// Filled in by create(); allocated, zeroed and sized by the host.
typedef struct dmrp_plugin {
  uint32_t struct_size;
  uint32_t reserved;
  dmrp_instance* self;

  // The interface of the descriptor's kind: dmrp_global_planner, dmrp_local_controller, dmrp_pedestrian_model or
  // dmrp_metric. Owned by the plugin, valid as long as the instance; the host copies it.
  const void* interface_;

  // Begins a trial. `seed` is for this instance alone; the same seed gives the same results. `world` is valid until the
  // next start() or destroy() begins. Returns DMRP_OK, DMRP_WARNING, DMRP_ERROR or DMRP_OUT_OF_MEMORY.
  // [step]
  int32_t (*start)(dmrp_instance* self, const dmrp_world* world, uint64_t seed);

  // An extension of the plugin by its id, or NULL. The function pointer may be NULL. Valid until destroy().
  // [any]
  const void* (*get_extension)(dmrp_instance* self, const char* id);

  // Frees the instance. Allowed after any status but DMRP_FATAL.
  // [main]
  void (*destroy)(dmrp_instance* self);
} dmrp_plugin;

DMRP_ASSERT_SIZE(dmrp_plugin, 48);

#endif
