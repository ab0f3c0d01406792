/* SPDX-License-Identifier: MIT */
// robot.h: what a robot is: kinematics, footprint, limits, start and goals.
#ifndef DMRP_ROBOT_H
#define DMRP_ROBOT_H

#include "values.h"

#define DMRP_KINEMATICS_DIFFERENTIAL 1  // (v_x, omega)
#define DMRP_KINEMATICS_HOLONOMIC 2     // (v_x, v_y, omega); reserved, not simulated by v1.0 hosts

#define DMRP_ROBOT_ACTIVE 0    // still has a goal
#define DMRP_ROBOT_FINISHED 1  // arrived at its last goal; parked there until the end of the trial
#define DMRP_ROBOT_FAILED 2    // declared failed by the host; stands where it is

// The limits that the host enforces on every command. Equal for all plugins: no controller has limits of its own.
typedef struct dmrp_limits {
  uint32_t struct_size;
  uint32_t reserved;
  double v_min;      // m/s, <= 0; 0 forbids driving backwards
  double v_max;      // m/s
  double v_y_max;    // m/s; 0 for differential drive
  double omega_max;  // rad/s
  double a_max;      // m/s^2, speeding up and braking
  double alpha_max;  // rad/s^2
} dmrp_limits;

// The outline of a robot in its own frame: a disc around the origin, or a convex polygon.
typedef struct dmrp_footprint {
  uint32_t struct_size;
  uint32_t vertex_count;      // 0: a disc
  double radius_m;            // of the disc, or of the circle around the origin that contains the polygon
  double inscribed_radius_m;  // of the largest disc around the origin inside it
  const dmrp_vec2* vertices;  // counter-clockwise; NULL for a disc
} dmrp_footprint;

// A goal pose. Array element.
typedef struct dmrp_goal {
  dmrp_pose pose;          // theta NaN: any heading
  double tolerance_m;      // the robot has arrived when its distance is below this (m),
  double tolerance_rad;    // its heading error is below this (rad), if theta is given,
  double tolerance_speed;  // and its speed is below this (m/s),
  int64_t settle_ns;       // for this long
} dmrp_goal;

// A robot at the start of the trial. Array element.
typedef struct dmrp_robot {
  const char* name;
  uint32_t kinematics;  // DMRP_KINEMATICS_*
  uint32_t goal_count;
  const dmrp_goal* goals;  // in order; a tour where there are several
  uint32_t goal_stride;
  uint32_t reserved;
  const dmrp_limits* limits;
  const dmrp_footprint* footprint;
  dmrp_pose start;
} dmrp_robot;

DMRP_ASSERT_SIZE(dmrp_limits, 56);
DMRP_ASSERT_SIZE(dmrp_footprint, 32);
DMRP_ASSERT_SIZE(dmrp_goal, 56);
DMRP_ASSERT_SIZE(dmrp_robot, 72);

#endif
