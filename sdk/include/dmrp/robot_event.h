/* SPDX-License-Identifier: MIT */
// robot_event.h: what happened to a robot, as metrics see it: clipped commands, recoveries, what the referee saw.
#ifndef DMRP_ROBOT_EVENT_H
#define DMRP_ROBOT_EVENT_H

#include "abi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Kinds of event. Open list: a reader skips an event of a kind that it does not know.
#define DMRP_ROBOT_EVENT_CLIPPED 1u   // its command was beyond its drive's ability, and the host clipped it
#define DMRP_ROBOT_EVENT_RECOVERY 2u  // its recovery began the step `detail`, or ended
#define DMRP_ROBOT_EVENT_CLASS 3u     // the referee's class of it is `detail` from this control tick on
#define DMRP_ROBOT_EVENT_MONITOR 4u   // a safety monitor took the place of its command; `detail` is the monitor's own
#define DMRP_ROBOT_EVENT_ROUTE 5u     // its way was led anew, around what stood on it
// At this control tick nothing could move any more: such a trial ends, but this one is drawn to run to its limit. Once in a
// trial, for each active robot.
#define DMRP_ROBOT_EVENT_RUNS_ON 6u

// `detail` of a recovery: what a robot does by itself, without its controller, when it makes no progress; until the next
// step or the end. Open list.
#define DMRP_RECOVERY_NONE 0u  // the recovery ended: the controller drives again
#define DMRP_RECOVERY_CLEAR_COSTMAP 1u
#define DMRP_RECOVERY_SPIN 2u
#define DMRP_RECOVERY_WAIT 3u
#define DMRP_RECOVERY_BACKUP 4u
#define DMRP_RECOVERY_REPLAN 5u

// `detail` of a class: what an active robot does, as the referee counts it (docs/endings.md): exactly one of these, and
// bits. The first sample has the class of every active robot, MOVING, later ones have changes. Open list.
#define DMRP_CLASS_MOVING 0u      // makes progress, or begins
#define DMRP_CLASS_SETTLING 1u    // meets its goal's conditions
#define DMRP_CLASS_RECOVERING 2u  // drives by itself
#define DMRP_CLASS_HELD 3u        // waits, as the plan's order says, for `other`
#define DMRP_CLASS_BLOCKED_PERSON 4u
#define DMRP_CLASS_BLOCKED_ROBOT 5u  // by `other`, on the next metre of its course
#define DMRP_CLASS_STUCK 6u          // nobody holds or blocks it
#define DMRP_CLASS_MASK 0xFFu
#define DMRP_CLASS_CIRCLING 0x100u  // a bit: not moving, but it travels or turns

// An event since the last sample. Array element.
typedef struct dmrp_robot_event {
  uint32_t kind;    // DMRP_ROBOT_EVENT_*
  uint32_t robot;   // index
  int64_t t_ns;     // simulated time
  uint32_t detail;  // by kind; 0 where it says nothing of it
  uint32_t other;   // of a class: the robot that holds or blocks it; DMRP_NOBODY otherwise
} dmrp_robot_event;

DMRP_ASSERT_SIZE(dmrp_robot_event, 24);

#ifdef __cplusplus
}
#endif

#endif
