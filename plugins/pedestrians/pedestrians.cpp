// SPDX-License-Identifier: MIT
// The library of the built-in pedestrian models.
#include "orca/orca.hpp"
#include "social_force/social_force.hpp"

DMRP_PLUGINS(dmrp::pedestrians::Orca, dmrp::pedestrians::SocialForce)
