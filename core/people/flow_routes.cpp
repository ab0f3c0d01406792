// SPDX-License-Identifier: MIT
#include "core/people/flow_routes.hpp"

#include <dmrp/toolkit/navigation_field.hpp>
#include <map>

namespace dmrp::core {
namespace {

// Follows the field from `from` into the target.
Route walk_down(const toolkit::NavigationField& field, dmrp_vec2 from, const Region& target) {
  const toolkit::Rectangle goal = {target.lower, target.upper};
  const double stride_m = field.grid().resolution_m();
  Route route = {from};
  for (std::uint32_t steps = 0; steps < field.grid().size() && !toolkit::contains(goal, route.back()); ++steps) {
    const dmrp_vec2 direction = field.direction(route.back());
    if (direction == dmrp_vec2{0.0, 0.0}) break;
    route.push_back(route.back() + stride_m * direction);
  }
  if (!toolkit::contains(goal, route.back())) return {from, middle_of(target)};
  return route;
}

}  // namespace

FlowRoutes find_flow_routes(const Scenario& scenario, const PlanningGrid& walking_grid) {
  const dmrp_grid grid = walking_grid.view();
  std::map<std::uint32_t, toolkit::NavigationField> fields;
  FlowRoutes routes;
  for (const Flow& flow : scenario.flows) {
    std::vector<Route>& legs = routes.legs.emplace_back();
    dmrp_vec2 from = middle_of(scenario.regions[flow.regions.front()]);
    for (std::size_t leg = 1; leg < flow.regions.size(); ++leg) {
      const Region& target = scenario.regions[flow.regions[leg]];
      const auto [field, is_new] = fields.try_emplace(flow.regions[leg]);
      if (is_new) field->second.compute(toolkit::GridView(grid), toolkit::Rectangle{target.lower, target.upper});
      legs.push_back(walk_down(field->second, from, target));
      from = legs.back().back();
    }
  }
  return routes;
}

}  // namespace dmrp::core
