// SPDX-License-Identifier: MIT
#include "host/guests/exchange/plan_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/results/whole_number.hpp"

namespace dmrp::host {

PlanInput plan_input(Arena& arena, Arena& output, const SentWorld& world, const dmrp_planning_problem& problem) {
  const dmrp_planning_problem* const sent = world.copy(arena, problem);
  const std::size_t room = output.room() / sizeof(dmrp_waypoint);
  return {sent, output.make<dmrp_waypoint>(room), room};
}

std::string plan_text(const PlannerAnswer& answer, const PlanInput& input, const CallSite& site) {
  std::vector<std::size_t> counts;
  std::uint64_t written = 0;
  for (const auto& path : answer.paths) {
    if (path.size() > input.room - written)
      throw PluginFault(fault_kind::bad_output, site, fmt::format("gave more than {} waypoints", input.room));
    std::copy(path.begin(), path.end(), input.waypoints + written);
    written += path.size();
    counts.push_back(path.size());
  }
  return nlohmann::json{
      {"status", answer.status},  {"planning_ns", answer.planning_ns}, {"processor_ns", answer.processor_ns},
      {"text", answer.text},      {"statistics", answer.statistics},   {"counts", counts},
      {"partial", answer.partial}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

PlannerAnswer planner_answer(std::string_view text, const PlanInput& input, std::uint32_t robot_count,
                             const CallSite& site) {
  PlannerAnswer answer;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    answer.status = whole_number<std::int32_t>(json.at("status"));
    answer.planning_ns = whole_number<std::int64_t>(json.at("planning_ns"));
    answer.processor_ns = whole_number<std::int64_t>(json.at("processor_ns"));
    json.at("text").get_to(answer.text);
    json.at("statistics").get_to(answer.statistics);
    const dmrp_waypoint* next = input.waypoints;
    std::uint64_t left = input.room;
    for (const nlohmann::json& one : json.at("counts")) {
      const auto count = whole_number<std::uint64_t>(one);
      if (count > left || answer.paths.size() == robot_count) throw UnbelievableMessage("with too many waypoints");
      answer.paths.emplace_back(next, next + count);
      next += count;
      left -= count;
    }
    if (!answer.paths.empty() && answer.paths.size() != robot_count) throw UnbelievableMessage("without all paths");
    json.at("partial").get_to(answer.partial);
    if (!answer.partial.empty() && answer.partial.size() != answer.paths.size())
      throw UnbelievableMessage("without all flags");
    return answer;
  } catch (const std::exception&) {  // no JSON, or what no planner gives
    throw PluginFault(fault_kind::abi_breach, site, wrote_into_shared_memory, true);
  }
}

}  // namespace dmrp::host
