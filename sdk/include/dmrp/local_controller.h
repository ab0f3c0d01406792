/* SPDX-License-Identifier: MIT */
// local_controller.h: drives one robot along its path, one command a control period. One instance a robot.
#ifndef DMRP_LOCAL_CONTROLLER_H
#define DMRP_LOCAL_CONTROLLER_H

#include "observation.h"
#include "path.h"
#include "plugin.h"

// What the controller asks of its robot for one control period, in the robot's frame.
// The host clips it to the robot's velocity limits, which shows only as observation.applied in the next period (and as
// dmrp_robot_sample.command in the trace); the robot then follows it within its accelerations. A value that is not
// finite is a fault (bad_output).
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

  // A new path, or the same one continued after a replan. `revision` is 1 for the first path that this controller is
  // handed after start() and grows by one with each: with full paths it is the plan's.
  // The waypoints live until the call returns: copy what you keep.
  // The path leads to the goals themselves, which may lie off the centres of their cells; observation.progress_* and
  // released_waypoint count along it. After a replan it begins at the cell that the robot was on the way to.
  // Under dispatch = "waypoint" it is a single waypoint, to go to as if it were the final goal.
  // Returns DMRP_OK or DMRP_ERROR.
  // [step]
  int32_t (*set_path)(dmrp_instance* self, const dmrp_path* path, uint64_t revision);

  // Computes the next command. Returns
  //   DMRP_OK           command is valid
  //   DMRP_NO_SOLUTION  nothing admissible was found; the host brakes within the limits. No fault; after 5 s without
  //                     a command the robot is given up (DMRP_FAILURE_CONTROLLER)
  //   DMRP_ERROR        the instance is unusable until the next start(); ends the trial as a fault
  // Must not block, allocate without bound, or read a clock.
  //
  // Rationale: goal checking is the host's, so that all controllers are judged alike; a controller that thinks it
  // has arrived just commands zero.
  // [step]
  int32_t (*step)(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command);
} dmrp_local_controller;

DMRP_ASSERT_SIZE(dmrp_command, 32);
DMRP_ASSERT_SIZE(dmrp_local_controller, 24);

#endif
