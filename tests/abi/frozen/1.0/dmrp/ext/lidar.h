/* SPDX-License-Identifier: MIT */
// ext/lidar.h: the robot's planar laser scan, with the noise that the experiment sets. An extension of the host for
// local controllers.
#ifndef DMRP_EXT_LIDAR_H
#define DMRP_EXT_LIDAR_H

#include "../values.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_EXT_LIDAR "dmrp.lidar/1"

// Beam i points at angle_min + i * angle_increment in the robot's frame. The sensor sits at the robot's origin.
typedef struct dmrp_scan {
  uint32_t struct_size;
  uint32_t count;
  int64_t t_ns;            // when it was taken
  double angle_min;        // rad
  double angle_increment;  // rad
  double range_min;        // m
  double range_max;        // m
  const float* ranges;     // m; INFINITY where nothing was hit within range_max, or the beam dropped out
} dmrp_scan;

typedef struct dmrp_lidar dmrp_lidar;
struct dmrp_lidar {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // The latest scan of a robot. Valid until the current call of step() or
  // step_all() returns. NULL for a robot that the instance does not drive.
  // [step]
  const dmrp_scan* (*scan)(const dmrp_lidar* lidar, uint32_t robot);
};

DMRP_ASSERT_SIZE(dmrp_scan, 56);
DMRP_ASSERT_SIZE(dmrp_lidar, 24);

#ifdef __cplusplus
}
#endif

#endif
