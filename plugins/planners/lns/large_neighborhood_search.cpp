// SPDX-License-Identifier: MIT
#include "planners/lns/large_neighborhood_search.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dmrp::planners {

LargeNeighborhoodSearch::LargeNeighborhoodSearch(const Problem& problem, const std::vector<TourTable>& tables,
                                                 std::vector<std::vector<Location>> paths, std::uint64_t seed,
                                                 StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      stop_(stop),
      random_(seed, "lns"),
      plan_{SafeIntervals(problem.graph), std::move(paths)},
      low_level_(problem.graph, plan_.occupied, SippSearch::Preference::near),
      neighborhoods_(problem, tables, plan_, random_),
      kept_(Neighborhoods::most_robots) {
  for (std::size_t i = 0; i < plan_.paths.size(); ++i) {
    plan_.occupied.add(static_cast<std::int32_t>(i), plan_.paths[i]);
    cost_ += cost_of(plan_.paths[i]);
    least_cost_ += tables[i].distance(0, problem.agents[i].start);
  }
}

void LargeNeighborhoodSearch::run(std::int64_t iterations) {
  for (std::int64_t before = cost_ + cost_; cost_ < before - before / 50 && !stop_.raised();) {
    before = cost_;
    replan_each_alone();
  }
  std::vector<std::int32_t> agents;
  while (cost_ > least_cost_ && iterations_ != iterations && !stop_.poll_now()) {
    ++iterations_;
    neighborhoods_.draw(agents);
    const std::int64_t before = cost_;
    const std::int64_t expanded = low_level_.expanded();
    replan(agents);
    neighborhoods_.learn(before - cost_, low_level_.expanded() - expanded);
  }
}

// Once over all robots, those that lose most first: takes most of the waits out of a first plan.
void LargeNeighborhoodSearch::replan_each_alone() {
  std::vector<std::int32_t> order(plan_.paths.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [this](std::int32_t a, std::int32_t b) { return neighborhoods_.lost(a) > neighborhoods_.lost(b); });
  for (const std::int32_t agent : order)
    if (neighborhoods_.lost(agent) > 0 && !stop_.poll_now()) replan({agent});
}

// Plans the agents again in this order. False if the old paths are back.
bool LargeNeighborhoodSearch::replan(const std::vector<std::int32_t>& agents) {
  std::int64_t least = 0;   // of the robots that are not planned yet
  std::int64_t budget = 0;  // for these
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto agent = static_cast<std::size_t>(agents[i]);
    plan_.occupied.remove(plan_.paths[agent]);
    budget += cost_of(plan_.paths[agent]);
    least += tables_[agent].distance(0, problem_.agents[agent].start);
    kept_[i] = std::move(plan_.paths[agent]);
  }
  std::size_t planned = 0;
  for (; planned < agents.size(); ++planned) {
    const auto agent = static_cast<std::size_t>(agents[planned]);
    least -= tables_[agent].distance(0, problem_.agents[agent].start);
    const auto latest = static_cast<std::int32_t>(std::min<std::int64_t>(budget - least, forever - 1));
    std::vector<Location>& path = plan_.paths[agent];
    const auto result = low_level_.search(problem_.agents[agent], tables_[agent], {}, 0, stop_, path, latest);
    if (result != SippSearch::Result::free) break;
    plan_.occupied.add(agents[planned], path);
    budget -= cost_of(path);
  }
  if (planned == agents.size()) {
    cost_ -= budget;
    return true;
  }
  for (std::size_t i = 0; i < planned; ++i) plan_.occupied.remove(plan_.paths[static_cast<std::size_t>(agents[i])]);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    std::swap(plan_.paths[static_cast<std::size_t>(agents[i])], kept_[i]);
    plan_.occupied.add(agents[i], plan_.paths[static_cast<std::size_t>(agents[i])]);
  }
  return false;
}

}  // namespace dmrp::planners
