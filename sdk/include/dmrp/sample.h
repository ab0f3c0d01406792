/* SPDX-License-Identifier: MIT */
// sample.h: the state of a trial after one physics step, as metrics see it.
#ifndef DMRP_SAMPLE_H
#define DMRP_SAMPLE_H

#include "person.h"
#include "plan.h"
#include "robot.h"
#include "robot_event.h"

#ifdef __cplusplus
extern "C" {
#endif

// A robot at one sample. Array element.
typedef struct dmrp_robot_sample {
  dmrp_pose pose;
  dmrp_twist velocity;    // actual
  dmrp_twist command;     // in force, clipped to the velocity limits; `velocity` follows it within a_max, alpha_max
  uint32_t state;         // DMRP_ROBOT_*
  uint32_t goal_index;    // the current goal
  double progress_m;      // along its path in force
  double steering_angle;  // rad; Ackermann only, otherwise 0
  // What its controller answered since the last sample, before the host clipped or delayed it; NaN: nothing.
  dmrp_twist answer;
  int32_t answer_status;  // the status of that answer; DMRP_OK where there is none
  uint32_t reserved;
} dmrp_robot_sample;

// Kinds of contact. Open list: a reader skips a contact of a kind that it does not know.
#define DMRP_CONTACT_STATIC 1u  // `a` a robot, `b` an index into world.shapes, or shape_count for the border
#define DMRP_CONTACT_ROBOT 2u   // `a`, `b` robots, a < b
#define DMRP_CONTACT_PERSON 3u  // `a` a robot, `b` an index into sample.people

// Bits of a contact. Open list. Fault is passive motion safety (Bouraine, Fraichard, Salhi 2012): a body is at fault
// unless it was at rest, as the referee counts it (docs/endings.md), or moving away from the other when they touched; a
// wall is at rest.
// Whether a braking response excuses a robot at fault is no bit: a metric judges it by the samples before.
#define DMRP_CONTACT_BEGINS 1u   // first sample of an event: this pair was not in contact just before
#define DMRP_CONTACT_FAULT_A 2u  // robot `a` is at fault
#define DMRP_CONTACT_FAULT_B 4u  // robot `b`, or the person, is at fault

// Two bodies that overlap by more than 1 mm at this sample. Array element.
typedef struct dmrp_contact {
  uint32_t kind;   // DMRP_CONTACT_*
  uint32_t flags;  // DMRP_CONTACT_BEGINS, ...; every sample of an event carries the fault
  uint32_t a;
  uint32_t b;
  double depth_m;
  dmrp_vec2 point;
  double impact_speed;  // m/s, relative, along the normal, 0 or more; NaN: not the first sample of its event
} dmrp_contact;

// Kinds of call. Open list: a reader skips a call of a kind that it does not know.
#define DMRP_CALL_PLAN 1u
#define DMRP_CALL_CONTROL 2u
#define DMRP_CALL_PEOPLE 3u

#define DMRP_ALL_ROBOTS 0xFFFFFFFEu  // the robot of a call that concerns all

// A plugin call since the last sample. Array element.
typedef struct dmrp_call {
  uint32_t kind;   // DMRP_CALL_*
  uint32_t robot;  // that the controller drives; DMRP_ALL_ROBOTS of a central one, of planner and people
  int32_t status;  // the returned status
  uint32_t reserved;
  int64_t duration_ns;  // wall time
} dmrp_call;

// What a controller was handed to follow since the last sample. Array element.
typedef struct dmrp_route {
  uint32_t robot;         // index
  uint32_t flags;         // DMRP_PATH_CONTINUES
  const dmrp_path* path;  // valid until observe() returns
} dmrp_route;

// The state after a physics step; the first sample is the state at t = 0. Valid until observe() returns.
typedef struct dmrp_sample {
  uint32_t struct_size;
  uint32_t control_tick;  // 1: t_ns is a control tick: controllers act on this state, unless the trial ends here
  int64_t t_ns;
  int64_t dt_ns;          // since the last sample; 0 for the first
  const dmrp_plan* plan;  // in force; NULL if there is none. Valid until finish() returns
  const dmrp_robot_sample* robots;
  uint32_t robot_count;
  uint32_t robot_stride;
  const dmrp_person* people;  // all present people, as a pedestrian model sees them: people come and leave
  uint32_t person_count;
  uint32_t person_stride;
  const dmrp_contact* contacts;
  uint32_t contact_count;
  uint32_t contact_stride;
  const dmrp_call* calls;
  uint32_t call_count;
  uint32_t call_stride;
  const dmrp_robot_event* events;  // ordered by robot
  uint32_t event_count;
  uint32_t event_stride;
  const dmrp_route* routes;  // ordered by robot
  uint32_t route_count;
  uint32_t route_stride;
} dmrp_sample;

DMRP_ASSERT_SIZE(dmrp_robot_sample, 128);
DMRP_ASSERT_SIZE(dmrp_contact, 48);
DMRP_ASSERT_SIZE(dmrp_call, 24);
DMRP_ASSERT_SIZE(dmrp_route, 16);
DMRP_ASSERT_SIZE(dmrp_sample, 128);

#ifdef __cplusplus
}
#endif

#endif
