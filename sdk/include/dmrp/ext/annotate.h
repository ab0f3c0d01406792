/* SPDX-License-Identifier: MIT */
// ext/annotate.h: lets a plugin leave what it thought in the trace: predicted trajectories, candidates, notes.
// An extension of the host for controllers, planners and pedestrian models. Never changes a result. Always optional: a
// host that keeps no annotations may have NULL for it. dmrp-host always has it, and wants annotations where the
// experiment says `annotations = true` in [record].
//
// It takes everything without complaint and keeps what has a meaning: of a trajectory the poses before the first one
// that is not finite, 1,000 at most, of a note 1,000 bytes, and nothing more once the trace has 256 MB.
#ifndef DMRP_EXT_ANNOTATE_H
#define DMRP_EXT_ANNOTATE_H

#include "../values.h"

#define DMRP_EXT_ANNOTATE "dmrp.annotate/1"

#define DMRP_ANNOTATE_PREDICTED 1  // what the plugin intends
#define DMRP_ANNOTATE_CANDIDATE 2  // what it considered

typedef struct dmrp_annotate dmrp_annotate;
struct dmrp_annotate {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // 1 if the trace keeps annotations now, else 0. Ask before computing any.
  // [step]
  int32_t (*wanted)(const dmrp_annotate* annotate);

  // A trajectory in the world frame, poses step_ns apart, the first one now. `role`: DMRP_ANNOTATE_*. Copied.
  // [step]
  void (*trajectory)(const dmrp_annotate* annotate, uint32_t role, const dmrp_pose* poses, uint32_t count,
                     int64_t step_ns);

  // A line of text, shown at this time. Copied.
  // [step]
  void (*note)(const dmrp_annotate* annotate, const char* text);
};

DMRP_ASSERT_SIZE(dmrp_annotate, 40);

#endif
