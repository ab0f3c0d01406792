/* SPDX-License-Identifier: MIT */
// host.h: what the host offers to a plugin.
//
// The library gets a host at init(), each instance one of its own at create(): log lines, errors and extensions are
// attributed to the instance whose host they went through.
#ifndef DMRP_HOST_H
#define DMRP_HOST_H

#include "abi.h"

#define DMRP_LOG_DEBUG 0
#define DMRP_LOG_INFO 1
#define DMRP_LOG_WARNING 2
#define DMRP_LOG_ERROR 3

typedef struct dmrp_host dmrp_host;
struct dmrp_host {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;        // the host's own
  const char* name;     // "dmrp-host"
  const char* version;  // of the host, semantic

  // A line for the log. `text` is copied.
  // [any]
  void (*log)(const dmrp_host* host, int32_t level, const char* text);

  // Why the call that is under way is about to return a status other than OK. `text` is copied; the last one counts.
  // [any]
  void (*set_error)(const dmrp_host* host, const char* text);

  // Whether the call under way should return soon: 1 once its time budget is used up.
  // Costs a few nanoseconds; ask at least every millisecond. A trial in which this has said 1 is not repeatable.
  // [any]
  int32_t (*should_stop)(const dmrp_host* host);

  // An extension of the host (ext/*.h) by its id, or NULL. Ask in start(): extensions belong to the trial, and some
  // (the costmap) are only computed for those who asked then. Valid until the next start() or destroy().
  // [step]
  const void* (*get_extension)(const dmrp_host* host, const char* id);
};

DMRP_ASSERT_SIZE(dmrp_host, 64);

#endif
