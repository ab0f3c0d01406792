// SPDX-License-Identifier: MIT
#include "host/world/variant_world.hpp"

#include <fmt/format.h>

#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <numbers>
#include <stdexcept>

#include "core/scene/footprint.hpp"
#include "core/scene/robot_task.hpp"
#include "host/files/sha256.hpp"

namespace dmrp::host {

namespace {

core::SimulationSettings with_time_limit(const Experiment& experiment, const ScenarioVariant& variant) {
  core::SimulationSettings settings = simulation_of(experiment, variant);
  if (!experiment.time_limit_set) settings.time_limit_ns = nanoseconds(variant.scenario.time_limit_s);
  return settings;
}

// The scenario with the trial's robots. It draws for the variant with the most robots, and keeps people clear of the other
// starts too: the first robots and the people are the same in all variants.
core::Scenario with_drawn_robots(const ScenarioVariant& variant, const core::PlanningGrids& grids, std::uint64_t seed) {
  core::Scenario scenario = variant.scenario;
  std::vector<core::RobotTask> drawn = core::draw_tasks(grids, task_request(variant), seed).tasks;
  if (drawn.size() < variant.most_drawn)
    throw std::runtime_error(fmt::format("scenario '{}' has no room for {} robots", scenario.name, variant.most_drawn));
  for (std::size_t i = variant.drawn_robots; i < drawn.size(); ++i)
    scenario.other_starts.push_back({drawn[i].start.x, drawn[i].start.y});
  drawn.resize(variant.drawn_robots);
  scenario.robots.insert(scenario.robots.end(), drawn.begin(), drawn.end());
  return scenario;
}

// Whether a robot of this type can begin there: free, and on the way from the centre of the same cell.
bool can_begin(const core::StaticGeometry& geometry, const core::PlanningGrid& planning,
               const core::RobotSettings& type, const dmrp_pose& listed, dmrp_vec2 place) {
  const dmrp_grid view = planning.view();
  const toolkit::GridView grid(view);
  if (!grid.contains(place) || grid.index_of(place) != grid.index_of({listed.x, listed.y})) return false;
  return geometry.disc_is_free(place, type.radius_m) &&
         geometry.sweep_is_free(grid.center(grid.cell_of(place)), place, core::inscribed_radius(type));
}

// Displaces the listed robots' starts, uniformly in a disc, and turns them. A robot that finds no free place near its
// own stays there.
void jitter_starts(const ScenarioVariant& variant, const core::StaticGeometry& geometry,
                   const core::PlanningGrids& grids, std::uint64_t seed, core::Scenario& scenario) {
  constexpr int most_tries = 50;
  for (std::size_t robot = 0; robot < variant.scenario.robots.size(); ++robot) {
    core::RobotTask& task = scenario.robots[robot];
    const dmrp_pose listed = core::start_of(task);
    toolkit::Stream stream(seed, "robots.jitter", robot);
    task.start.theta = listed.theta + stream.uniform(-variant.jitter.heading_rad, variant.jitter.heading_rad);
    for (int tries = 0; tries < most_tries; ++tries) {
      const double distance_m = variant.jitter.position_m * std::sqrt(stream.uniform());
      const double angle = stream.uniform(0.0, 2.0 * std::numbers::pi);
      const dmrp_vec2 place = {listed.x + distance_m * std::cos(angle), listed.y + distance_m * std::sin(angle)};
      if (!can_begin(geometry, grids.of(task.type), variant.types.of(task), listed, place)) continue;
      task.start.x = place.x;
      task.start.y = place.y;
      break;
    }
  }
}

core::FlowRoutes routes_of(const ScenarioVariant& variant, WalkingGrids& grids) {
  const core::Scenario& scenario = variant.scenario;
  if (variant.routes) return *variant.routes;
  if (core::walker_count(scenario) == 0) return {std::vector<std::vector<core::Route>>(scenario.flows.size())};
  return core::find_flow_routes(scenario, *grids.find(core::walking_resolution_m, scenario.people.radius_m));
}

std::optional<core::WorldView> view_of_points(const VariantWorld& world, std::int64_t call_budget_ns) {
  if (world.simulation.planning_body == core::PlanningBody::footprint) return std::nullopt;
  core::RobotTypes points;
  for (const core::RobotSettings& type : world.types.all()) points.put(core::planning_body_of(type, world.simulation));
  return core::WorldView(world.scenario, points, world.simulation, *world.geometry, world.planning_grid,
                         call_budget_ns);
}

core::Scenario scenario_of_trial(const ScenarioVariant& variant, const VariantWorld& shared, std::uint64_t seed) {
  core::Scenario scenario =
      variant.most_drawn > 0 ? with_drawn_robots(variant, *shared.planning_grids, seed) : variant.scenario;
  if (variant.jitter.position_m > 0.0 || variant.jitter.heading_rad > 0.0)
    jitter_starts(variant, *shared.geometry, *shared.planning_grids, seed, scenario);
  return scenario;
}

}  // namespace

VariantWorld::VariantWorld(const Experiment& experiment, const ScenarioVariant& variant)
    : scenario(variant.scenario),
      simulation(with_time_limit(experiment, variant)),
      geometry(std::make_shared<core::StaticGeometry>(scenario)),
      types(variant.types),
      planning_grids(std::make_shared<core::PlanningGrids>(*geometry, types, simulation)),
      planning_grid(planning_grids->common(types_in_use(variant))),
      walking_grids(std::make_shared<WalkingGrids>(geometry)),
      routes(routes_of(variant, *walking_grids)),
      view(scenario, types, simulation, *geometry, planning_grid, nanoseconds(experiment.limits.step_time_s)),
      point_view(view_of_points(*this, view.world().call_budget_ns)) {}

VariantWorld::VariantWorld(const Experiment& experiment, const ScenarioVariant& variant, const VariantWorld& shared,
                           std::uint64_t seed)
    : shared_(&shared),
      scenario(scenario_of_trial(variant, shared, seed)),
      simulation(shared.simulation),
      geometry(shared.geometry),
      types(shared.types),
      planning_grids(shared.planning_grids),
      planning_grid(shared.planning_grid),
      walking_grids(shared.walking_grids),
      routes(shared.routes),
      view(scenario, types, simulation, *geometry, planning_grid, nanoseconds(experiment.limits.step_time_s)),
      point_view(view_of_points(*this, view.world().call_budget_ns)) {}

bool VariantWorld::sweep_is_free(dmrp_vec2 from, dmrp_vec2 to, double radius_m) const {
  const bool is_point = simulation.planning_body == core::PlanningBody::point;
  return geometry->sweep_is_free(from, to, is_point ? simulation.planning_margin_m : radius_m);
}

std::string task_hash(const core::Scenario& scenario) {
  std::string places;
  const auto add = [&](const dmrp_pose& pose) { places += fmt::format("{} {} {},", pose.x, pose.y, pose.theta); };
  for (const core::RobotTask& task : scenario.robots) {
    add(core::start_of(task));
    for (const dmrp_pose& goal : task.goals) add(goal);
    places += ';';
  }
  return places.empty() ? "" : sha256_of_bytes(places).substr(0, 16);
}

}  // namespace dmrp::host
