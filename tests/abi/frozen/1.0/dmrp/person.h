/* SPDX-License-Identifier: MIT */
// person.h: a person as pedestrian models and metrics see them.
#ifndef DMRP_PERSON_H
#define DMRP_PERSON_H

#include "values.h"

#ifdef __cplusplus
extern "C" {
#endif

// How a person answers to robots. Open list: a model treats a reaction that it does not know as UNSPECIFIED.
// (The others are the behaviours of HuNavSim, Perez-Higueras et al., RA-L 2023, section III.)
#define DMRP_REACTION_UNSPECIFIED 0u  // as the model and its parameters have it
#define DMRP_REACTION_REGULAR 1u      // avoids a robot as it avoids a person
#define DMRP_REACTION_IMPASSIVE 2u    // does not notice robots
#define DMRP_REACTION_SURPRISED 3u    // stops and looks at it
#define DMRP_REACTION_CURIOUS 4u      // walks up to it, then on
#define DMRP_REACTION_SCARED 5u       // keeps far away
#define DMRP_REACTION_THREATENING 6u  // gets in its way

// A person. Array element.
typedef struct dmrp_person {
  uint64_t id;         // stable; a respawned person has a new one
  uint32_t group;      // people of one group walk together; 0: alone; respawned people are a new group
  uint32_t target_id;  // people with the same target_id walk to the same place: a key for cached navigation fields
  dmrp_vec2 position;  // m
  dmrp_vec2 velocity;  // m/s, actual, over the last step
  double radius_m;
  double desired_speed;  // m/s
  dmrp_vec2 target;      // the current destination
  dmrp_vec2 area_lower;  // the place that target_id identifies: an axis-aligned rectangle that contains `target`
  dmrp_vec2 area_upper;
  uint32_t reaction;  // DMRP_REACTION_*
  uint32_t reserved;
} dmrp_person;

DMRP_ASSERT_SIZE(dmrp_person, 120);

#ifdef __cplusplus
}
#endif

#endif
