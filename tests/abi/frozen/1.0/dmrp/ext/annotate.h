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

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_ANNOTATE "dmrp.annotate/1"

// Roles of a trajectory. Open list: a host drops one that it does not know.
#define DMRP_ANNOTATE_PREDICTED 1u  // the trajectory that the plugin chose
#define DMRP_ANNOTATE_CANDIDATE 2u  // a trajectory that it considered

// A trajectory in the world frame.
typedef struct dmrp_trajectory {
  uint32_t struct_size;
  uint32_t role;           // DMRP_ANNOTATE_*
  uint32_t robot;          // index of the robot that it is about; 0 where the plugin is not a controller
  uint32_t count;          // of poses
  const dmrp_pose* poses;  // step_ns apart, the first at the current time
  int64_t step_ns;
} dmrp_trajectory;

// A line of text, shown at the current time.
typedef struct dmrp_note {
  uint32_t struct_size;
  uint32_t robot;  // as in dmrp_trajectory
  const char* text;
} dmrp_note;

typedef struct dmrp_annotate dmrp_annotate;
struct dmrp_annotate {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // 1 if the trace records annotations now, else 0. Ask before computing any.
  // [step]
  int32_t (*wanted)(const dmrp_annotate* annotate);

  // Both are copied, and dropped for a robot that the instance does not drive.
  // [step]
  void (*trajectory)(const dmrp_annotate* annotate, const dmrp_trajectory* trajectory);
  void (*note)(const dmrp_annotate* annotate, const dmrp_note* note);
};

DMRP_ASSERT_SIZE(dmrp_trajectory, 32);
DMRP_ASSERT_SIZE(dmrp_note, 16);
DMRP_ASSERT_SIZE(dmrp_annotate, 40);

#ifdef __cplusplus
}
#endif

#endif
