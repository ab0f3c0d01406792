/* SPDX-License-Identifier: MIT */
// local_controller.h: drives one robot along its path with one command per control period. One instance per robot.
#ifndef DMRP_LOCAL_CONTROLLER_H
#define DMRP_LOCAL_CONTROLLER_H

#include "observation.h"
#include "path.h"
#include "plugin.h"

// The command for one control period, in the robot's frame.
// The host clips it to the robot's velocity limits. The clipped command appears as observation.applied in the next
// period and as dmrp_robot_sample.command in the trace; the robot follows it within its acceleration limits. A value
// that is not finite is a fault (bad_output).
typedef struct dmrp_command {
  uint32_t struct_size;
  uint32_t reserved;
  double v_x;    // m/s, forward
  double v_y;    // m/s, left; ignored for differential drive
  double omega;  // rad/s, counter-clockwise
} dmrp_command;

typedef struct dmrp_local_controller {
  uint32_t struct_size;
  uint32_t reserved;

  // A new path, or the continued path after a replan. `revision` is 1 for the first path after start() and increases
  // by one with each path; with full paths it equals the plan's revision.
  // The waypoints are valid until the call returns: copy what you keep.
  // The path leads to the exact goals, which may lie off the centres of their cells; observation.progress_* and
  // released_waypoint refer to it. After a replan it begins at the cell that the robot was driving to.
  // With dispatch = "waypoint" it is a single waypoint, to be approached like a final goal.
  // Returns DMRP_OK or DMRP_ERROR.
  // [step]
  int32_t (*set_path)(dmrp_instance* self, const dmrp_path* path, uint64_t revision);

  // Computes the next command. Returns
  //   DMRP_OK           command is valid
  //   DMRP_NO_SOLUTION  there is no admissible command; the host brakes within the limits. Not a fault; after 5 s
  //                     without a command the robot fails (DMRP_FAILURE_CONTROLLER)
  //   DMRP_ERROR        the instance is unusable until the next start(); the trial ends with a fault
  // Must not block, allocate without bound, or read a clock.
  //
  // Rationale: the host checks arrival, so that all controllers are judged alike; a controller that considers itself
  // arrived commands zero.
  // [step]
  int32_t (*step)(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command);
} dmrp_local_controller;

DMRP_ASSERT_SIZE(dmrp_command, 32);
DMRP_ASSERT_SIZE(dmrp_local_controller, 24);

#endif
