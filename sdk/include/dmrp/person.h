/* SPDX-License-Identifier: MIT */
// person.h: a person as pedestrian models and metrics see them.
#ifndef DMRP_PERSON_H
#define DMRP_PERSON_H

#include "values.h"

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
} dmrp_person;

DMRP_ASSERT_SIZE(dmrp_person, 112);

#endif
