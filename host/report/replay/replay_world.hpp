// SPDX-License-Identifier: MIT
// replay_world.hpp: what stands still in a replay: the world, and the plans.
#pragma once

#include <dmrp/world.h>

#include <deque>
#include <nlohmann/json.hpp>

#include "core/trace/trace_reader.hpp"

namespace dmrp::host {

nlohmann::json replay_world(const dmrp_world& world);

// What of a robot does not change: name, outline, limits, goals.
nlohmann::json replay_robot(const dmrp_robot& robot);

nlohmann::json replay_plans(const std::deque<core::TracePlan>& plans);

}  // namespace dmrp::host
