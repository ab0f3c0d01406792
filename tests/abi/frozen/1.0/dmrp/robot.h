/* SPDX-License-Identifier: MIT */
// robot.h: what a robot is: kinematics, footprint, limits, start and goals.
#ifndef DMRP_ROBOT_H
#define DMRP_ROBOT_H

#include "values.h"

#ifdef __cplusplus
extern "C" {
#endif

// Drives. Open list; a host refuses robots that it cannot simulate.
#define DMRP_KINEMATICS_DIFFERENTIAL 1u  // commands (v_x, omega)
#define DMRP_KINEMATICS_HOLONOMIC 2u     // commands (v_x, v_y, omega)
#define DMRP_KINEMATICS_ACKERMANN 3u     // commands (v_x, omega); omega = v_x tan(steering angle) / wheelbase_m
// The wheels of an Ackermann drive point ahead at the start, and keep their angle where v_x = 0.

// What a robot does. A finished robot becomes active again if it is given another goal. Open list: a robot in a state that
// a reader does not know stands where it is, as a failed one.
#define DMRP_ROBOT_ACTIVE 0u    // still has a goal
#define DMRP_ROBOT_FINISHED 1u  // arrived at its last goal so far; parked there
#define DMRP_ROBOT_FAILED 2u    // declared failed by the host; stands where it is

// The limits that the host enforces on every command. Equal for all plugins: no controller has limits of its own.
typedef struct dmrp_limits {
  uint32_t struct_size;
  uint32_t reserved;
  double v_min;              // m/s, <= 0; 0 forbids driving backwards
  double v_max;              // m/s
  double v_y_max;            // m/s; 0 unless holonomic
  double omega_max;          // rad/s
  double a_max;              // m/s^2, speeding up and braking
  double alpha_max;          // rad/s^2
  double wheelbase_m;        // Ackermann only, as the next two; otherwise 0
  double steering_max;       // rad, largest steering angle to either side
  double steering_rate_max;  // rad/s
} dmrp_limits;

// A convex polygon. Array element.
typedef struct dmrp_polygon {
  const dmrp_vec2* vertices;  // counter-clockwise
  uint32_t vertex_count;      // >= 3
  uint32_t reserved;
} dmrp_polygon;

// The outline of a robot in its own frame: a disc around the origin, or the union of convex polygons.
typedef struct dmrp_footprint {
  uint32_t struct_size;
  uint32_t part_count;        // 0: a disc
  double radius_m;            // of the disc, or of the circle around the origin that contains the polygons
  double inscribed_radius_m;  // of the largest disc around the origin inside it
  const dmrp_polygon* parts;  // NULL for a disc
  uint32_t part_stride;
  uint32_t reserved;
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
  const char* type;     // name of its type; "" for the default type
  uint32_t kinematics;  // DMRP_KINEMATICS_*
  uint32_t goal_count;
  const dmrp_goal* goals;  // as known at the start, in order; a tour where there are several. More may follow
  uint32_t goal_stride;
  uint32_t reserved;
  const dmrp_limits* limits;
  const dmrp_footprint* footprint;
  dmrp_pose start;
} dmrp_robot;

DMRP_ASSERT_SIZE(dmrp_limits, 80);
DMRP_ASSERT_SIZE(dmrp_polygon, 16);
DMRP_ASSERT_SIZE(dmrp_footprint, 40);
DMRP_ASSERT_SIZE(dmrp_goal, 56);
DMRP_ASSERT_SIZE(dmrp_robot, 80);

#ifdef __cplusplus
}
#endif

#endif
