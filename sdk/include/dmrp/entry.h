/* SPDX-License-Identifier: MIT */
// entry.h: dmrp_entry_v1, the only symbol that a plugin library exports.
#ifndef DMRP_ENTRY_H
#define DMRP_ENTRY_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dmrp_entry dmrp_entry;
struct dmrp_entry {
  uint32_t struct_size;
  uint32_t abi_minor;       // DMRP_TARGET_MINOR: of the newest fields, constants and meanings that the library knows
  uint32_t min_host_minor;  // DMRP_TARGET_MINOR: an older host refuses the library and prints both versions
  uint32_t abi_draft;       // must equal the host's until v1 is frozen

  // Every function gets the entry that it was read from: a bridge that makes plugins from files, one entry a file, finds
  // its own data beside it.

  // Called once after loading, before create(): the place to load what all instances share. `host` is valid until
  // deinit() returns. After any status but DMRP_OK and DMRP_WARNING the library is not used, and not even deinit() is
  // called. A host may first call only init() and deinit() in a separate process, to report a failure before a run
  // begins.
  // [main]
  int32_t (*init)(const dmrp_entry* self, const dmrp_host* host);

  // Called once, when no instance is left.
  // [main]
  void (*deinit)(const dmrp_entry* self);

  // Number of plugins in this library, and the descriptor of each: static data, available before init(); NULL if it
  // cannot be made.
  // [any]
  uint32_t (*plugin_count)(const dmrp_entry* self);
  const dmrp_descriptor* (*descriptor)(const dmrp_entry* self, uint32_t index);

  // Creates an instance of the plugin `id`. `host` belongs to this instance and is valid until its destroy() returns;
  // `params` has every declared key and is valid until the call returns; the plugin fills in `out` before it returns
  // DMRP_OK. No destroy() follows another status, or an `out` that lacks a part, which is a fault.
  // [main]
  int32_t (*create)(const dmrp_entry* self, const dmrp_host* host, const char* id, const dmrp_params* params,
                    dmrp_plugin* out);
};

DMRP_ASSERT_SIZE(dmrp_entry, 56);

#define DMRP_ENTRY_SYMBOL "dmrp_entry_v1"

#ifdef __cplusplus
}
#endif

// Begins the definition of the exported object: `DMRP_ENTRY = { sizeof(dmrp_entry), ... };`
// (In C++ a const object has internal linkage unless it was declared extern before.)
#if defined(__cplusplus)
#define DMRP_ENTRY_DECLARATION extern "C" DMRP_EXPORT const dmrp_entry dmrp_entry_v1
#else
#define DMRP_ENTRY_DECLARATION extern DMRP_EXPORT const dmrp_entry dmrp_entry_v1
#endif
#define DMRP_ENTRY        \
  DMRP_ENTRY_DECLARATION; \
  const dmrp_entry dmrp_entry_v1

#endif
