/* SPDX-License-Identifier: MIT */
// ext/annotate.h: lets a plugin record its reasoning in the trace: predicted trajectories, candidates, notes.
// An extension of the host for controllers, planners and pedestrian models. It never changes a result. Always optional:
// a host that records no annotations may return NULL. dmrp-host always offers it, and wants annotations if the
// experiment sets `annotations = true` in [record].
//
// The host accepts any input and stores only valid data: the poses of a trajectory before the first one that is not
// finite, at most 1,000 of them, at most 1,000 bytes of a note, and nothing once the trace has reached 256 MB.
#ifndef DMRP_EXT_ANNOTATE_H
#define DMRP_EXT_ANNOTATE_H

#include "../values.h"

#define DMRP_EXT_ANNOTATE "dmrp.annotate/1"

#define DMRP_ANNOTATE_PREDICTED 1  // the trajectory that the plugin chose
#define DMRP_ANNOTATE_CANDIDATE 2  // a trajectory that it considered

typedef struct dmrp_annotate dmrp_annotate;
struct dmrp_annotate {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // 1 if the trace records annotations now, else 0. Ask before computing any.
  // [step]
  int32_t (*wanted)(const dmrp_annotate* annotate);

  // A trajectory in the world frame: poses step_ns apart, the first at the current time. `role`: DMRP_ANNOTATE_*.
  // Copied.
  // [step]
  void (*trajectory)(const dmrp_annotate* annotate, uint32_t role, const dmrp_pose* poses, uint32_t count,
                     int64_t step_ns);

  // A line of text, shown at the current time. Copied.
  // [step]
  void (*note)(const dmrp_annotate* annotate, const char* text);
};

DMRP_ASSERT_SIZE(dmrp_annotate, 40);

#endif
