/* SPDX-License-Identifier: MIT */
// local_controller.h: drives a robot along its path with one command per control period. One instance per robot; or,
// with DMRP_FLAG_CENTRAL, one instance for the robots of its fleet.
#ifndef DMRP_LOCAL_CONTROLLER_H
#define DMRP_LOCAL_CONTROLLER_H

#include "observation.h"
#include "path.h"
#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

// A path to follow; made by the host for one call.
typedef struct dmrp_path_update {
  uint32_t struct_size;
  uint32_t robot;         // index
  uint64_t revision;      // 1 for the robot's first path after start(), then one more with each
  const dmrp_path* path;  // valid until the call returns: copy what you keep
  uint32_t flags;         // DMRP_PATH_CONTINUES
  uint32_t reserved;
} dmrp_path_update;

// The command for one control period, in the robot's frame.
// The host clips it to the robot's velocity limits. The clipped command appears as observation.applied in the next
// period and as dmrp_robot_sample.command in the trace; the robot follows it within its acceleration limits. A value
// that is not finite is a fault (bad_output).
// Growable; an array of commands has a stride like every array.
typedef struct dmrp_command {
  uint32_t struct_size;
  int32_t status;  // read after step_all() only: DMRP_OK, or DMRP_NO_SOLUTION if there is no command for this robot
  double v_x;      // m/s, forward
  double v_y;      // m/s, left; ignored unless the robot is holonomic
  double omega;    // rad/s, counter-clockwise
} dmrp_command;

// All active robots at one control tick; made by the host for one call of step_all().
typedef struct dmrp_fleet {
  uint32_t struct_size;
  uint32_t count;
  const dmrp_observation* observations;  // one per active robot, ordered by robot
  uint32_t observation_stride;
  uint32_t command_stride;
  dmrp_command* commands;  // output: commands[i] is for the robot of observations[i]; zeroed, DMRP_AT_OUT finds it
} dmrp_fleet;

typedef struct dmrp_local_controller {
  uint32_t struct_size;
  uint32_t reserved;

  // The path to follow. **It ends where the robot must stop**: at its current goal, or, if it is partial, where the order
  // of the plan makes it wait, where the way turns back, or where the planner's window ends. A controller that drives to
  // the end and stops there needs to know nothing else. When the robot may drive on, it is handed a path that continues
  // the one before, often while it still drives: about as often as others replan.
  // A path that is not partial leads to the goal itself, which may lie off the centre of its cell; observation.progress_*
  // refer to the path. After a replan it begins at the cell that the robot was driving to.
  // It is a single waypoint, to be approached like a goal, if dispatch = "waypoint" or "lockstep".
  // Called for active robots alone, as the functions below.
  // [step]
  int32_t (*set_path)(dmrp_instance* self, const dmrp_path_update* update);

  // Computes the next command. Returns
  //   DMRP_OK           command is valid
  //   DMRP_NO_SOLUTION  there is no admissible command; the host brakes within the limits. Not a fault; without
  //                     a command for some time the robot fails (DMRP_FAILURE_CONTROLLER)
  //   DMRP_ERROR        the instance is unusable until the next start(); the trial ends with a fault
  // Must not block, allocate without bound, or read a clock. NULL with DMRP_FLAG_CENTRAL.
  //
  // Rationale: the host checks arrival, so that all controllers are judged alike; a controller that considers itself
  // arrived commands zero.
  // [step]
  int32_t (*step)(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command);

  // With DMRP_FLAG_CENTRAL, instead of step(): the commands of all active robots at once. NULL otherwise.
  // [step]
  int32_t (*step_all)(dmrp_instance* self, const dmrp_fleet* fleet);
} dmrp_local_controller;

DMRP_ASSERT_SIZE(dmrp_path_update, 32);
DMRP_ASSERT_SIZE(dmrp_command, 32);
DMRP_ASSERT_SIZE(dmrp_fleet, 32);
DMRP_ASSERT_SIZE(dmrp_local_controller, 32);

#ifdef __cplusplus
}
#endif

#endif
