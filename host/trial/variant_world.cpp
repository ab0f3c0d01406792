// SPDX-License-Identifier: MIT
#include "host/trial/variant_world.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace dmrp::host {

namespace {

core::SimulationSettings with_time_limit(const Experiment& experiment, const core::Scenario& scenario) {
  core::SimulationSettings settings = experiment.simulation;
  if (!experiment.time_limit_set) settings.time_limit_ns = nanoseconds(scenario.time_limit_s);
  return settings;
}

// The scenario with the trial's robots. It draws for the variant with the most robots, and keeps people clear of the other
// starts too: the first robots and the people are the same in all variants.
core::Scenario with_drawn_robots(const ScenarioVariant& variant, const core::PlanningGrids& grids, std::uint64_t seed) {
  core::Scenario scenario = variant.scenario;
  std::vector<core::RobotTask> drawn = grids.draw(variant.drawn_types, variant.most_drawn, seed);
  if (drawn.size() < variant.most_drawn)
    throw std::runtime_error(fmt::format("scenario '{}' has no room for {} robots", scenario.name, variant.most_drawn));
  for (std::size_t i = variant.drawn_robots; i < drawn.size(); ++i)
    scenario.other_starts.push_back({drawn[i].start.x, drawn[i].start.y});
  drawn.resize(variant.drawn_robots);
  scenario.robots.insert(scenario.robots.end(), drawn.begin(), drawn.end());
  return scenario;
}

}  // namespace

VariantWorld::VariantWorld(const Experiment& experiment, const ScenarioVariant& variant)
    : scenario(variant.scenario),
      simulation(with_time_limit(experiment, scenario)),
      geometry(std::make_shared<core::StaticGeometry>(scenario)),
      types(variant.types),
      planning_grids(std::make_shared<core::PlanningGrids>(*geometry, types, simulation.grid_resolution_m,
                                                           simulation.planning_margin_m)),
      planning_grid(planning_grids->common(types_in_use(variant))),
      walking_grids(std::make_shared<WalkingGrids>(geometry)),
      routes(
          core::find_flow_routes(scenario, *walking_grids->find(core::walking_resolution_m, scenario.people.radius_m))),
      view(scenario, types, simulation, *geometry, planning_grid, nanoseconds(experiment.limits.step_time_s)) {}

VariantWorld::VariantWorld(const Experiment& experiment, const ScenarioVariant& variant, const VariantWorld& shared,
                           std::uint64_t seed)
    : scenario(with_drawn_robots(variant, *shared.planning_grids, seed)),
      simulation(shared.simulation),
      geometry(shared.geometry),
      types(shared.types),
      planning_grids(shared.planning_grids),
      planning_grid(shared.planning_grid),
      walking_grids(shared.walking_grids),
      routes(shared.routes),
      view(scenario, types, simulation, *geometry, planning_grid, nanoseconds(experiment.limits.step_time_s)) {}

}  // namespace dmrp::host
