// SPDX-License-Identifier: MIT
// The library of the built-in pedestrian models.
#include "social_force/social_force.hpp"

DMRP_PLUGINS(dmrp::pedestrians::SocialForce)
