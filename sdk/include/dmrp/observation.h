/* SPDX-License-Identifier: MIT */
// observation.h: the input of a local controller at a control tick.
#ifndef DMRP_OBSERVATION_H
#define DMRP_OBSERVATION_H

#include "robot.h"

#ifdef __cplusplus
extern "C" {
#endif

// Kinds of agent. Open list: a controller avoids an agent of unknown kind as it does a person.
#define DMRP_AGENT_ROBOT 1u
#define DMRP_AGENT_PERSON 2u

// A moving robot or person. Array element.
typedef struct dmrp_agent {
  uint64_t id;         // a robot's index; a person's id, as in dmrp_person: a respawned person has a new one
  uint32_t kind;       // DMRP_AGENT_*
  uint32_t state;      // robots: DMRP_ROBOT_*
  dmrp_pose pose;      // a person's theta is the direction of motion
  dmrp_vec2 velocity;  // m/s, world frame
  double radius_m;
} dmrp_agent;

// Made by the host for one call of step(). No pointer is NULL, except `agents` when agent_count is 0.
// Growable; an array of observations has a stride like every array.
//
// If the experiment sets odometry noise, `pose` is the robot's estimate and `velocity` its odometry reading; agents,
// lidar and costmap are then placed relative to the estimated pose, as in a robot's own map. Goal and path keep their
// true places; progress, arrival and metrics use the true pose.
//
// If the experiment compensates latency, `pose`, `velocity`, `applied` and `steering_angle` are those to which the
// commands under way lead the robot by the time at which the answer takes effect.
typedef struct dmrp_observation {
  uint32_t struct_size;
  uint32_t robot;       // index
  int64_t t_ns;         // simulated time
  int64_t dt_ns;        // the control period
  dmrp_pose pose;       // estimated
  dmrp_twist velocity;  // measured
  dmrp_twist applied;   // the last command as the host applied it, after clipping
  // The current goal; where waypoints are dispatched, the one on the way there, with the goal's tolerances.
  const dmrp_goal* goal;
  uint32_t goal_index;
  uint32_t goal_count;  // of the goals known so far
  // Where the robot is on the path that its controller was handed last: the arc length of the point that it has reached,
  // which never decreases on one path.
  double progress_m;
  uint32_t progress_waypoint;  // last waypoint passed
  uint32_t goal_stride;        // of `goal`
  const dmrp_limits* limits;
  const dmrp_footprint* footprint;
  const dmrp_agent* agents;  // other agents that `tracking` makes visible, with its noise; ordered by kind, then id
  uint32_t agent_count;
  uint32_t agent_stride;
  double steering_angle;  // rad, present, left is positive; Ackermann only, otherwise 0
} dmrp_observation;

DMRP_ASSERT_SIZE(dmrp_agent, 64);
DMRP_ASSERT_SIZE(dmrp_observation, 168);

#ifdef __cplusplus
}
#endif

#endif
