// SPDX-License-Identifier: MIT
#include "core/people/flow_routes.hpp"

#include <dmrp/toolkit/navigation_field.hpp>
#include <optional>

namespace dmrp::core {
namespace {

// Follows the field from `from` into the target. Nothing if that leads to where the field is not known.
std::optional<Route> walk_down(const toolkit::NavigationField& field, dmrp_vec2 from, const Region& target) {
  const toolkit::Rectangle goal = {target.lower, target.upper};
  const double stride_m = field.grid().resolution_m();
  Route route = {from};
  for (std::uint32_t steps = 0; steps < field.grid().size() && !toolkit::contains(goal, route.back()); ++steps) {
    if (!field.knows(route.back())) return std::nullopt;
    const dmrp_vec2 direction = field.direction(route.back());
    if (direction == dmrp_vec2{0.0, 0.0}) break;
    route.push_back(route.back() + stride_m * direction);
  }
  if (!toolkit::contains(goal, route.back())) return Route{from, middle_of(target)};
  return route;
}

// Finds ways to one target after another.
class WayFinder {
 public:
  explicit WayFinder(const PlanningGrid& walking_grid) : grid_(walking_grid.view()) {}

  std::vector<Route> ways(const std::vector<dmrp_vec2>& starts, const Region& target) {
    const toolkit::Rectangle goal = {target.lower, target.upper};
    field_.compute_from(toolkit::GridView(grid_), starts, goal);
    std::vector<Route> ways;
    for (const dmrp_vec2 from : starts) {
      std::optional<Route> way = walk_down(field_, from, target);
      if (!way) {
        field_.compute(toolkit::GridView(grid_), goal);
        way = walk_down(field_, from, target);
      }
      ways.push_back(std::move(*way));
    }
    return ways;
  }

 private:
  dmrp_grid grid_;
  toolkit::NavigationField field_;
};

// The flows of which the next leg leads to the region.
std::vector<std::size_t> flows_to(std::uint32_t region, const Scenario& scenario, const FlowRoutes& routes) {
  std::vector<std::size_t> flows;
  for (std::size_t flow = 0; flow < scenario.flows.size(); ++flow) {
    const std::size_t next = routes.legs[flow].size() + 1;
    const auto& regions = scenario.flows[flow].regions;
    if (next < regions.size() && regions[next] == region) flows.push_back(flow);
  }
  return flows;
}

}  // namespace

FlowRoutes find_flow_routes(const Scenario& scenario, const PlanningGrid& walking_grid) {
  WayFinder finder(walking_grid);
  FlowRoutes routes;
  routes.legs.resize(scenario.flows.size());
  // A leg begins where the one before ends, so this repeats until no flow has a next leg.
  for (bool any = true; any;) {
    any = false;
    for (std::uint32_t region = 0; region < scenario.regions.size(); ++region) {
      const std::vector<std::size_t> flows = flows_to(region, scenario, routes);
      if (flows.empty()) continue;
      any = true;
      std::vector<dmrp_vec2> starts;
      for (const std::size_t flow : flows) {
        const std::vector<Route>& legs = routes.legs[flow];
        starts.push_back(legs.empty() ? middle_of(scenario.regions[scenario.flows[flow].regions.front()])
                                      : legs.back().back());
      }
      std::vector<Route> ways = finder.ways(starts, scenario.regions[region]);
      for (std::size_t i = 0; i < flows.size(); ++i) routes.legs[flows[i]].push_back(std::move(ways[i]));
    }
  }
  return routes;
}

}  // namespace dmrp::core
