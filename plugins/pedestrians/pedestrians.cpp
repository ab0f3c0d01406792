// SPDX-License-Identifier: MIT
// The library of the built-in pedestrian models.
#include "collision_free_speed/collision_free_speed.hpp"
#include "orca/orca.hpp"
#include "social_force/social_force.hpp"

DMRP_PLUGINS(dmrp::pedestrians::CollisionFreeSpeed, dmrp::pedestrians::Orca, dmrp::pedestrians::SocialForce)
