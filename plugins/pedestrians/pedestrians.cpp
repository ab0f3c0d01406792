// SPDX-License-Identifier: MIT
// The library of the built-in pedestrian models.
#include "pedestrians/collision_free_speed/collision_free_speed.hpp"
#include "pedestrians/orca/orca.hpp"
#include "pedestrians/social_force/social_force.hpp"

DMRP_PLUGINS(dmrp::pedestrians::CollisionFreeSpeed, dmrp::pedestrians::Orca, dmrp::pedestrians::SocialForce)
