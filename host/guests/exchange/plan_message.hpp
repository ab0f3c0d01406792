// SPDX-License-Identifier: MIT
// plan_message.hpp: what a planner's guest is asked and answers.
#pragma once

#include <string>
#include <string_view>

#include "host/guests/exchange/arena.hpp"
#include "host/guests/exchange/guest_request.hpp"
#include "host/guests/exchange/sent_world.hpp"
#include "host/plans/planning.hpp"

namespace dmrp::host {

// The request for a plan; all of the output becomes room for waypoints.
PlanInput plan_input(Arena& arena, Arena& output, const SentWorld& world, const dmrp_planning_problem& problem);

// The guest's side: writes the waypoints to the output of `input`. Returns the text. Throws PluginFault at `site` if there
// are too many.
std::string plan_text(const PlannerAnswer& answer, const PlanInput& input, const CallSite& site);

// The judge's side. A guest can have written anything: what cannot be is a PluginFault at `site`.
PlannerAnswer planner_answer(std::string_view text, const PlanInput& input, std::uint32_t robot_count,
                             const CallSite& site);

}  // namespace dmrp::host
