/* SPDX-License-Identifier: MIT */
// pedestrian_model.h: gives every person a velocity, one physics step at a time. One instance for all people.
//
// The host decides which people are present, where they go and when they come and leave; a model only moves them.
#ifndef DMRP_PEDESTRIAN_MODEL_H
#define DMRP_PEDESTRIAN_MODEL_H

#include "observation.h"
#include "person.h"
#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

// The crowd at one physics step; made by the host for one call.
typedef struct dmrp_crowd {
  uint32_t struct_size;
  uint32_t person_count;
  int64_t t_ns;
  int64_t dt_ns;
  // All present people, ordered by slot. The id identifies a person, the index does not: when a person leaves, all
  // people after it move up by one; a new person who takes the slot, at once or later, has a new id.
  const dmrp_person* people;
  const dmrp_agent* robots;  // all robots, as kind DMRP_AGENT_ROBOT, ordered by index
  uint32_t person_stride;
  uint32_t robot_count;
  uint32_t robot_stride;
  uint32_t reserved;
} dmrp_crowd;

// The motion of one person in the step that begins now. Array element.
typedef struct dmrp_motion {
  dmrp_vec2 velocity;  // m/s, world frame
} dmrp_motion;

// Output of step(); allocated, zeroed and sized by the host.
typedef struct dmrp_motions {
  uint32_t struct_size;
  uint32_t count;   // crowd.person_count
  uint32_t stride;  // of motions
  uint32_t reserved;
  dmrp_motion* motions;  // motions[i] is for people[i]; DMRP_AT_OUT finds it
} dmrp_motions;

typedef struct dmrp_pedestrian_model {
  uint32_t struct_size;
  uint32_t reserved;

  // Writes the motion of every person. Bodies are solid: the world removes the part of a velocity that would deepen an
  // overlap. A velocity above 5 m/s or not finite is a fault (bad_output). The host ignores the motions of people who
  // follow a recording.
  // [step]
  int32_t (*step)(dmrp_instance* self, const dmrp_crowd* crowd, dmrp_motions* motions);
} dmrp_pedestrian_model;

DMRP_ASSERT_SIZE(dmrp_crowd, 56);
DMRP_ASSERT_SIZE(dmrp_motion, 16);
DMRP_ASSERT_SIZE(dmrp_motions, 24);
DMRP_ASSERT_SIZE(dmrp_pedestrian_model, 16);

#ifdef __cplusplus
}
#endif

#endif
