// SPDX-License-Identifier: MIT
// replay_world.hpp: the static parts of a replay: world, robots' properties, plans.
#pragma once

#include <dmrp/world.h>

#include <deque>
#include <nlohmann/json.hpp>

#include "core/trace/trace_reader.hpp"

namespace dmrp::host {

nlohmann::json replay_world(const dmrp_world& world);

// Name, outline, limits and goals of a robot.
nlohmann::json replay_robot(const dmrp_robot& robot);

nlohmann::json replay_plans(const std::deque<core::TracePlan>& plans);

}  // namespace dmrp::host
