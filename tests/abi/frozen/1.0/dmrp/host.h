/* SPDX-License-Identifier: MIT */
// host.h: the functions that the host provides to a plugin.
//
// The library gets a host at init(), and each instance gets its own at create(): the host attributes log lines, errors
// and extensions to the instance whose dmrp_host was used.
#ifndef DMRP_HOST_H
#define DMRP_HOST_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Levels of a log line. Open list: a host treats an unknown level as DMRP_LOG_INFO.
#define DMRP_LOG_DEBUG 0
#define DMRP_LOG_INFO 1
#define DMRP_LOG_WARNING 2
#define DMRP_LOG_ERROR 3

typedef struct dmrp_host dmrp_host;
struct dmrp_host {
  uint32_t struct_size;
  uint32_t abi_minor;        // the minor version of the contract that the host was built with
  void* context;             // the host's own
  const char* name;          // "dmrp-host"
  const char* version;       // of the host, semantic
  const char* library_path;  // of this plugin's library, absolute, symbolic links resolved: weights lie beside it

  // Writes a line to the log. `text` is copied; the host escapes control characters and bytes that are not UTF-8.
  // [any]
  void (*log)(const dmrp_host* host, int32_t level, const char* text);

  // Explains the status other than DMRP_OK that the current call will return. `text` is copied as by log(); the last
  // one counts. Ignored outside a call of this instance.
  // [any]
  void (*set_error)(const dmrp_host* host, const char* text);

  // Returns 1 once the time budget of the current call is used up: the call should then return soon; 0 before. Every
  // function with a tag but [any] is a call, init() and create() too. Returns 1 outside a call of this instance, so that
  // a thread of the plugin that outlives its call ends.
  // Costs a few nanoseconds; ask at least every millisecond. A trial in which this returned 1 is not repeatable.
  // [any]
  int32_t (*should_stop)(const dmrp_host* host);

  // An extension of the host (ext/*.h) by its id. NULL if the host does not offer it to this kind of plugin, or the
  // descriptor does not declare it in `needed` or `uses`. Ask in start(): extensions belong to the trial, and the
  // host computes some (the costmap) only for instances that asked there. Valid until the next start() or destroy()
  // begins.
  // [step]
  const void* (*get_extension)(const dmrp_host* host, const char* id);

  // Wall time, in nanoseconds, that is left of the current call's budget; 0 when it is used up, and outside a call. For a
  // plugin that divides its time, as an anytime search. A trial in which it is asked is not repeatable.
  // [any]
  int64_t (*budget_left_ns)(const dmrp_host* host);
};

DMRP_ASSERT_SIZE(dmrp_host, 80);

#ifdef __cplusplus
}
#endif

#endif
