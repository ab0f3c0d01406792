/* SPDX-License-Identifier: MIT */
// waypoint_with_velocity.h: dmrp_waypoint as a later minor version would have it, with a field appended. A plugin that is
// built with such headers asks by the stride whether the other side knows the field.
#ifndef DMRP_TESTS_WAYPOINT_WITH_VELOCITY_H
#define DMRP_TESTS_WAYPOINT_WITH_VELOCITY_H

#include <dmrp/path.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct waypoint_with_velocity {
  dmrp_waypoint known;
  double v;  // m/s, at this waypoint
} waypoint_with_velocity;

DMRP_ASSERT_SIZE(waypoint_with_velocity, 48);

#ifdef __cplusplus
}
#endif

#endif
