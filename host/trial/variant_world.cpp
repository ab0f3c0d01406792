// SPDX-License-Identifier: MIT
#include "host/trial/variant_world.hpp"

namespace dmrp::host {

namespace {

core::SimulationSettings with_time_limit(const Experiment& experiment, const core::Scenario& scenario) {
  core::SimulationSettings settings = experiment.simulation;
  if (!experiment.time_limit_set) settings.time_limit_ns = nanoseconds(scenario.time_limit_s);
  return settings;
}

}  // namespace

VariantWorld::VariantWorld(const Experiment& experiment, const ScenarioVariant& variant)
    : scenario(variant.scenario),
      simulation(with_time_limit(experiment, scenario)),
      geometry(std::make_shared<core::StaticGeometry>(scenario)),
      planning_grid(core::build_planning_grid(*geometry, simulation.grid_resolution_m, experiment.robot.radius_m,
                                              simulation.planning_margin_m)),
      walking_grid(core::build_walking_grid(*geometry)),
      routes(core::find_flow_routes(scenario, walking_grid)),
      view(scenario, experiment.robot, simulation, *geometry, planning_grid, walking_grid,
           nanoseconds(experiment.limits.step_time_s)) {}

}  // namespace dmrp::host
