// SPDX-License-Identifier: MIT
// observation.hpp: what a controller is told of its robot at a control tick.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>

#include "core/world/world.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/robot_sensors.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// Refers to `guidance`, and to the agents that the robot perceives at this tick.
dmrp_observation observation_of(std::uint32_t robot, const Guidance& guidance, const VariantWorld& variant,
                                const core::World& world, RobotSensors& sensors);

}  // namespace dmrp::host
