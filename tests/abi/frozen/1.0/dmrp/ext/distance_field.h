/* SPDX-License-Identifier: MIT */
// ext/distance_field.h: the Euclidean distance to the nearest obstacle of the local costmap, computed on demand, at
// most once per scan. An extension of the host for local controllers.
#ifndef DMRP_EXT_DISTANCE_FIELD_H
#define DMRP_EXT_DISTANCE_FIELD_H

#include "../values.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_DISTANCE_FIELD "dmrp.distance_field/1"

// Cells as in dmrp_costmap.
typedef struct dmrp_field {
  uint32_t struct_size;
  uint32_t width;
  uint32_t height;
  uint32_t reserved;
  int64_t t_ns;  // of the scan that it was computed from
  double resolution_m;
  dmrp_vec2 origin;
  double distance_max_m;     // distances are capped at this
  const float* distances_m;  // from the cell's centre to the nearest lethal cell's centre; 0 in a lethal cell
} dmrp_field;

typedef struct dmrp_distance_field dmrp_distance_field;
struct dmrp_distance_field {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The field of a robot. Valid until the current call of step() or
  // step_all() returns. NULL for a robot that the instance does not drive.
  // [step]
  const dmrp_field* (*field)(const dmrp_distance_field* extension, uint32_t robot);
};

DMRP_ASSERT_SIZE(dmrp_field, 64);
DMRP_ASSERT_SIZE(dmrp_distance_field, 24);

#ifdef __cplusplus
}
#endif

#endif
