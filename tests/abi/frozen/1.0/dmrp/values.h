/* SPDX-License-Identifier: MIT */
// values.h: the frozen value types. SI units; radians, counter-clockwise from +x; the world frame is right-handed.
// The contract is planar: a third dimension is left to v2.
#ifndef DMRP_VALUES_H
#define DMRP_VALUES_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// A point or a vector in the world frame, metres (or m/s where a header says velocity).
typedef struct dmrp_vec2 {
  double x;
  double y;
} dmrp_vec2;

// A position in metres and a heading in (-pi, pi]. NaN means any heading, where a header allows it.
typedef struct dmrp_pose {
  double x;
  double y;
  double theta;
} dmrp_pose;

// A velocity in a robot's own frame.
typedef struct dmrp_twist {
  double v_x;    // m/s, forward
  double v_y;    // m/s, left; zero for differential drive
  double omega;  // rad/s
} dmrp_twist;

// A straight piece of wall in the world frame, metres.
typedef struct dmrp_segment {
  dmrp_vec2 from;
  dmrp_vec2 to;
} dmrp_segment;

DMRP_ASSERT_SIZE(dmrp_vec2, 16);
DMRP_ASSERT_SIZE(dmrp_pose, 24);
DMRP_ASSERT_SIZE(dmrp_twist, 24);
DMRP_ASSERT_SIZE(dmrp_segment, 32);

#ifdef __cplusplus
}
#endif

#endif
