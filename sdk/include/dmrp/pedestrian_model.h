/* SPDX-License-Identifier: MIT */
// pedestrian_model.h: gives every person a velocity, one physics step at a time. One instance for all people.
//
// Who is there, where they go and when they come and leave is the host's; a model only moves them.
#ifndef DMRP_PEDESTRIAN_MODEL_H
#define DMRP_PEDESTRIAN_MODEL_H

#include "observation.h"
#include "person.h"
#include "plugin.h"

// The crowd at one physics step; made by the host for one call.
typedef struct dmrp_crowd {
  uint32_t struct_size;
  uint32_t person_count;
  int64_t t_ns;
  int64_t dt_ns;
  // All who are there, ordered by slot. A person is known by its id: whoever leaves gives up the place, and all after it
  // move up; somebody new who takes the slot, at once or later, has a new id, and the others keep theirs.
  const dmrp_person* people;
  const dmrp_agent* robots;  // all robots, as kind DMRP_AGENT_ROBOT, ordered by index
  uint32_t person_stride;
  uint32_t robot_count;
  uint32_t robot_stride;
  uint32_t reserved;
} dmrp_crowd;

typedef struct dmrp_pedestrian_model {
  uint32_t struct_size;
  uint32_t reserved;

  // Writes person_count velocities (m/s, world frame) for the step that begins now. Bodies are solid in the world:
  // it cancels the part of a velocity that would deepen an overlap. Velocities above 5 m/s or not finite are a fault
  // (bad_output); those of people who are replayed from a recording are not used. Returns DMRP_OK or DMRP_ERROR.
  // [step]
  int32_t (*step)(dmrp_instance* self, const dmrp_crowd* crowd, dmrp_vec2* velocities);
} dmrp_pedestrian_model;

DMRP_ASSERT_SIZE(dmrp_crowd, 56);
DMRP_ASSERT_SIZE(dmrp_pedestrian_model, 16);

#endif
