/* SPDX-License-Identifier: MIT */
// ext/timing.h: lets a plugin say that its results depend on timing, as on a thread that it does not wait for: the
// trial is then not repeatable. An extension of the host for all kinds of plugin, always optional.
#ifndef DMRP_EXT_TIMING_H
#define DMRP_EXT_TIMING_H

#include "../abi.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_TIMING "dmrp.timing/1"

typedef struct dmrp_timing dmrp_timing;
struct dmrp_timing {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The results of this instance in this trial depend on timing. The trial counts as not repeatable, and `reason`, one
  // line, stands beside it in the results. Copied as by log(); the first one of a plugin in a trial counts. Ignored
  // outside a call of this instance.
  // [step]
  void (*not_repeatable)(const dmrp_timing* timing, const char* reason);
};

DMRP_ASSERT_SIZE(dmrp_timing, 24);

#ifdef __cplusplus
}
#endif

#endif
