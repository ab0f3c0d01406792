// SPDX-License-Identifier: MIT
#include "host/experiment/check_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <map>
#include <memory>
#include <string>

#include "core/scene/footprint.hpp"
#include "core/scene/footprint_grid.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/robot_task.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/scene/step_overlaps.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/mistakes.hpp"
#include "host/experiment/check_people.hpp"
#include "host/experiment/check_regions.hpp"

namespace dmrp::host {

namespace {

constexpr double start_distance_m = 2.0;  // between starts and between goals, by the method
constexpr double max_cells = 1 << 24;

void check_size(const ScenarioFile& file, double resolution_m, const char* grid) {
  const core::Scenario& scenario = file.scenario;
  const double cells =
      (scenario.upper.x - scenario.lower.x) * (scenario.upper.y - scenario.lower.y) / (resolution_m * resolution_m);
  if (cells > max_cells)
    file.document->fail(file.size,
                        fmt::format("the world is too large: {} with cells of {} m would have {:.0f} cells, at "
                                    "most {:.0f}",
                                    grid, resolution_m, cells, max_cells));
}

// For a robot that has a type: its name and width, for a message.
std::string shown_size(const core::RobotSettings& type) {
  if (type.type.empty()) return "";
  return fmt::format(" (type '{}': {:.2f} m wide at its narrowest through the origin)", type.type,
                     2.0 * core::inscribed_radius(type));
}

// The footprint that the experiment file gives to robots of a type.
std::optional<TomlValue> footprint_of(const TomlTable* root, const std::string& type) {
  if (!root) return std::nullopt;
  auto table = root->find(type.empty() ? "robot" : "robot_type");
  if (table && !type.empty()) table = table->table().find(type);
  return table ? table->table().find("footprint") : std::nullopt;
}

class WorldCheck {
 public:
  WorldCheck(const ScenarioFile& file, const core::RobotTypes& types, Experiment& experiment, const RandomRobots& drawn,
             const TomlTable* root)
      : file_(file),
        types_(types),
        experiment_(experiment),
        drawn_(drawn),
        root_(root),
        scenario_(file.scenario),
        geometry_(std::make_shared<core::StaticGeometry>(scenario_)),
        planning_(*geometry_, types, experiment.simulation) {
    for (const core::RobotSettings& type : types.all()) grids_[type.type] = planning_.of(type.type).view();
  }

  const core::PlanningGrids& planning_grids() const { return planning_; }
  const core::StaticGeometry& geometry() const { return *geometry_; }

  void run(std::shared_ptr<const core::FlowRoutes>& routes) {
    Mistakes mistakes;
    std::vector<std::size_t> placed;  // robots without a mistake of their own
    for (std::size_t i = 0; i < scenario_.robots.size(); ++i)
      if (mistakes.attempt([&] { check_size_and_task(i); })) placed.push_back(i);
    for (std::size_t a = 0; a < placed.size(); ++a)
      for (std::size_t b = a + 1; b < placed.size(); ++b) mistakes.attempt([&] { check_pair(placed[a], placed[b]); });
    mistakes.attempt([&] { check_people(file_, types_, geometry_, planning_, drawn_, experiment_, routes); });
    mistakes.end();
    check_time_limit();
    if (experiment_.simulation.planning_body == core::PlanningBody::point) return check_margin_of_points();
    check_cell_size();
  }

 private:
  void warn(SourcePosition at, const std::string& text) {
    std::vector<std::string>& warnings = experiment_.warnings;
    const std::string warning = file_.document->place(at) + ": " + text;
    // the levels of one test would repeat it
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  }
  [[noreturn]] void fail_robot(std::size_t robot, const std::string& text) const {
    file_.document->fail(file_.robots[robot], fmt::format("robot {} {}", robot, text));
  }

  // A robot that is late even on straight ways at full speed.
  void check_time_limit() {
    const double limit_s = experiment_.time_limit_set ? static_cast<double>(experiment_.simulation.time_limit_ns) * 1e-9
                                                      : scenario_.time_limit_s;
    for (std::size_t i = 0; i < scenario_.robots.size(); ++i) {
      const core::RobotTask& task = scenario_.robots[i];
      const core::RobotSettings& type = types_.of(task);
      const double speed = std::hypot(type.v_max, type.v_y_max);
      double way_m = 0.0;
      dmrp_pose from = task.start;
      for (const dmrp_pose& goal : task.goals) {
        way_m += std::hypot(goal.x - from.x, goal.y - from.y);
        from = goal;
      }
      if (way_m - experiment_.simulation.goal.tolerance_m > limit_s * speed)
        return warn(file_.robots[i],
                    fmt::format("robot {} cannot arrive: {:.1f} m as the crow flies take {:.0f} s at {} m/s, and "
                                "time_limit_s = {}",
                                i, way_m, way_m / speed, speed, limit_s));
    }
  }

  // Plans may lead robots into walls where points keep less clearance than a robot needs.
  void check_margin_of_points() {
    const core::SimulationSettings& simulation = experiment_.simulation;
    for (const core::RobotTask& task : scenario_.robots)
      if (const double radius_m = types_.of(task).radius_m; simulation.planning_margin_m < radius_m)
        return warn(file_.size, fmt::format("planning_body = \"point\" with planning_margin_m = {}: plans lead robots "
                                            "of radius {} m into walls",
                                            simulation.planning_margin_m, radius_m));
  }

  // The two largest robots fit cells next to each other, whatever they do.
  void check_cell_size() {
    std::vector<double> radii_m;
    for (const core::RobotTask& task : scenario_.robots) radii_m.push_back(types_.of(task).radius_m);
    if (radii_m.size() < 2) return;
    std::sort(radii_m.rbegin(), radii_m.rend());
    const double safe_cell_m = std::sqrt(2.0) * (radii_m[0] + radii_m[1]);
    if (experiment_.simulation.grid_resolution_m < safe_cell_m)
      warn(file_.size,
           fmt::format("cells of {} m are smaller than {} = {:.3f} m: robots can touch on different cells; plans "
                       "keep them apart by their footprints",
                       experiment_.simulation.grid_resolution_m,
                       radii_m[0] == radii_m[1] ? "2 sqrt(2) r" : "sqrt(2) (r1 + r2)", safe_cell_m));
  }

  // Shows what the map is made of if hardly anything of it is free: then its thresholds or its inversion are the mistake.
  std::string shown_map() const {
    constexpr double hardly = 0.1;
    if (!file_.census) return "";
    const MapCensus& census = *file_.census;
    const std::size_t free = census.free + (census.unknown_is_free ? census.unknown : 0);
    if (static_cast<double>(free) >= hardly * static_cast<double>(census.cells)) return "";
    return fmt::format("; hardly anything is free in {}: {}", census.file, census_text(census));
  }

  // Whether the robot's outline is free at a pose; a free heading is always right.
  bool outline_is_free(const core::RobotSettings& type, const dmrp_pose& pose) const {
    return std::isnan(pose.theta) || std::all_of(type.parts.begin(), type.parts.end(), [&](const auto& part) {
             return geometry_->clearance(toolkit::to_world(pose, part), 1.0) > 0.0;
           });
  }

  // Whether a robot of this type could do the task on the planning grid of these settings.
  bool would_do(const core::RobotTask& task, const core::RobotSettings& type,
                const core::SimulationSettings& simulation) const {
    const core::PlanningGrid planning = core::build_planning_grid(*geometry_, type, simulation);
    const dmrp_grid view = planning.view();
    const toolkit::GridView grid(view);
    std::vector<bool> seen;
    const auto is_reached = [&](const dmrp_pose& pose) {
      const dmrp_vec2 point = {pose.x, pose.y};
      const toolkit::Cell cell = grid.cell_of(point);
      if (!grid.contains(cell) || !grid.free(cell)) return false;
      if (!geometry_->sweep_is_free(grid.center(cell), point, core::inscribed_radius(type))) return false;
      if (seen.empty()) seen = core::reachable_cells(planning, grid.index(cell));
      return static_cast<bool>(seen[grid.index(cell)]);
    };
    return is_reached(task.start) && std::all_of(task.goals.begin(), task.goals.end(), is_reached);
  }

  // "; grid_resolution_m = 0.5 or planning_margin_m = 0.05 would do".
  std::string shown_remedy(std::size_t robot) const {
    const core::SimulationSettings& now = experiment_.simulation;
    const double world_m2 = (scenario_.upper.x - scenario_.lower.x) * (scenario_.upper.y - scenario_.lower.y);
    const core::RobotTask& task = scenario_.robots[robot];
    const core::RobotSettings& type = types_.of(task);
    std::vector<std::string> found;
    for (const double cell_m : proposed_cells_m) {
      if (cell_m >= now.grid_resolution_m || world_m2 / (cell_m * cell_m) > most_cells_tried) continue;
      core::SimulationSettings finer = now;
      finer.grid_resolution_m = cell_m;
      if (!would_do(task, type, finer)) continue;
      found.push_back(fmt::format("grid_resolution_m = {}", cell_m));
      break;
    }
    for (const double margin_m : {0.05, 0.02, 0.0}) {
      core::SimulationSettings closer = now;
      closer.planning_margin_m = margin_m;
      if (margin_m >= now.planning_margin_m || !would_do(task, type, closer)) continue;
      found.push_back(fmt::format("planning_margin_m = {}", margin_m));
      break;
    }
    if (found.empty()) return "; neither smaller cells nor a smaller planning_margin_m would do";
    return fmt::format("; {} would do", fmt::join(found, " or "));
  }

  // A pose must be reachable from the centre of its planning cell, which stands for it in plans.
  void check_place(std::size_t robot, const char* verb, const char* noun, const dmrp_pose& pose) const {
    const dmrp_vec2 point = {pose.x, pose.y};
    const core::RobotSettings& type = types_.of(scenario_.robots[robot]);
    const double radius_m = core::inscribed_radius(type);
    const double needed_m = core::planning_clearance_m(type, experiment_.simulation);
    if (!geometry_->inside_world(point))
      fail_robot(robot, fmt::format("{} outside the world, at ({}, {})", verb, point.x, point.y));
    const core::NearestShape nearest = geometry_->nearest(point);
    const std::string shape(geometry_->shape_name(nearest.shape));
    const bool border = nearest.shape == geometry_->border();
    const std::string name = border                        ? shape
                             : shape.starts_with("cells ") ? fmt::format("a wall of the map, '{}',", shape)
                                                           : "'" + shape + "'";
    if (nearest.clearance_m < radius_m)
      fail_robot(robot, fmt::format("{} {} {} at ({}, {}) (clearance {:.2f} m, needs {:.2f} m){}", verb,
                                    nearest.clearance_m == 0.0 ? "inside" : "too near to", name, point.x, point.y,
                                    nearest.clearance_m, needed_m, shown_map()));
    if (!outline_is_free(type, pose))
      fail_robot(robot, fmt::format("{} with its outline in a wall or shape, at ({}, {}, {:.2f} rad)", verb, pose.x,
                                    pose.y, pose.theta));
    const dmrp_grid view = planning_.of(type.type).view();
    const toolkit::GridView grid(view);
    const toolkit::Cell cell = grid.cell_of(point);
    const dmrp_vec2 center = grid.center(cell);
    if (!grid.contains(cell) || !grid.free(cell))
      fail_robot(robot,
                 fmt::format("has its {} ({}, {}) on a planning cell that is not free (centre ({}, {}), clearance "
                             "{:.2f} m, needs {:.2f} m{})",
                             noun, point.x, point.y, center.x, center.y, geometry_->clearance(center), needed_m,
                             shown_remedy(robot)));
    if (!geometry_->sweep_is_free(center, point, radius_m))
      fail_robot(robot, fmt::format("cannot get from its {} ({}, {}) to the centre of its cell{}", noun, point.x,
                                    point.y, shown_remedy(robot)));
  }

  // Where a robot of the usual size could do the task, the experiment's footprint is the mistake, told once.
  void check_size_and_task(std::size_t robot) {
    const core::RobotTask& task = scenario_.robots[robot];
    const core::RobotSettings& type = types_.of(task);
    const core::RobotSettings usual;
    const core::SimulationSettings& simulation = experiment_.simulation;
    const auto footprint = footprint_of(root_, type.type);
    try {
      check_robot(robot);
    } catch (const InputError& mistake) {
      if (!footprint || type.radius_m <= usual.radius_m || !would_do(task, usual, simulation)) throw;
      const std::string& first = too_large_.try_emplace(type.type, mistake.what()).first->second;
      footprint->fail(
          fmt::format("robots of radius {} m do not fit into scenario '{}': {}", type.radius_m, scenario_.name, first));
    }
  }

  void check_robot(std::size_t robot) {
    const core::RobotTask& task = scenario_.robots[robot];
    const dmrp_vec2 start = {task.start.x, task.start.y};
    Mistakes mistakes;
    mistakes.attempt([&] { check_place(robot, "starts", "start", core::start_of(task)); });
    for (const dmrp_pose& goal : task.goals)
      mistakes.attempt([&] { check_place(robot, "has its goal", "goal", goal); });
    mistakes.end();
    const core::PlanningGrid& planning = planning_.of(task.type);
    const dmrp_grid view = planning.view();
    const toolkit::GridView grid(view);
    const auto seen = core::reachable_cells(planning, grid.index(grid.cell_of(start)));
    for (const dmrp_pose& goal : task.goals) {
      const dmrp_vec2 point = {goal.x, goal.y};
      if (!seen[grid.index(grid.cell_of(point))])
        fail_robot(robot,
                   fmt::format("cannot reach its goal ({}, {}) from its start ({}, {}) on the planning grid{}{}",
                               goal.x, goal.y, start.x, start.y, shown_size(types_.of(task)), shown_remedy(robot)));
    }
  }

  void check_pair(std::size_t a, std::size_t b) {
    const core::RobotTask& first = scenario_.robots[a];
    const core::RobotTask& second = scenario_.robots[b];
    check_distance(a, b, "start", first.start, second.start);
    check_distance(a, b, "goal", first.goals.back(), second.goals.back());
  }

  void check_distance(std::size_t a, std::size_t b, const char* noun, const dmrp_pose& p, const dmrp_pose& q) {
    const dmrp_grid view = planning_.standard().view();
    const toolkit::GridView grid(view);
    const double distance_m = std::hypot(p.x - q.x, p.y - q.y);
    const double touching_m = types_.of(scenario_.robots[a]).radius_m + types_.of(scenario_.robots[b]).radius_m;
    if (distance_m < touching_m)
      fail_robot(b, fmt::format("overlaps robot {} at its {} (distance {:.2f} m, needs {:.2f} m)", a, noun, distance_m,
                                touching_m));
    if (grid.index(grid.cell_of({p.x, p.y})) == grid.index(grid.cell_of({q.x, q.y})))
      fail_robot(b, fmt::format("has its {} on the same planning cell as robot {}", noun, a));
    check_cells(a, b, noun, grid.cell_of({p.x, p.y}), grid.cell_of({q.x, q.y}));
    if (distance_m <= start_distance_m)
      warn(file_.robots[b],
           fmt::format("the {}s of robots {} and {} are {:.2f} m apart; the method wants more than {} m", noun, a, b,
                       distance_m, start_distance_m));
  }

  // Plans stand robots on the centres of cells, at any heading.
  void check_cells(std::size_t a, std::size_t b, const char* noun, toolkit::Cell cell_a, toolkit::Cell cell_b) const {
    const auto body = [&](std::size_t robot) {
      const core::RobotSettings& type = types_.of(scenario_.robots[robot]);
      const core::RobotSettings body = core::planning_body_of(type, experiment_.simulation);
      return core::StepOverlaps::Robot{body.radius_m, body.parts, &grids_.at(type.type), true};
    };
    const double cell_m = experiment_.simulation.grid_resolution_m;
    core::StepOverlaps overlaps(cell_m, {body(a), body(b)});
    if (!overlaps.are_possible() || !overlaps.overlap(0, cell_a, 1, cell_b)) return;
    fail_robot(
        b, fmt::format("has its {} on a cell that overlaps robot {} on its own (centres {:.2f} m apart, radii {:.2f} "
                       "and {:.2f} m)",
                       noun, a, cell_m * std::hypot(cell_a.column - cell_b.column, cell_a.row - cell_b.row),
                       body(a).radius_m, body(b).radius_m));
  }

  const ScenarioFile& file_;
  const core::RobotTypes& types_;
  Experiment& experiment_;
  const RandomRobots& drawn_;
  const TomlTable* root_;
  const core::Scenario& scenario_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  core::PlanningGrids planning_;
  std::map<std::string, dmrp_grid> grids_;        // by type of robot
  std::map<std::string, std::string> too_large_;  // by type of robot: the first mistake of one
};

bool any_on_free_cell(std::span<const dmrp_vec2> points, const core::PlanningGrid& planning) {
  const dmrp_grid view = planning.view();
  const toolkit::GridView grid(view);
  return std::any_of(points.begin(), points.end(), [&](dmrp_vec2 point) {
    const toolkit::Cell cell = grid.cell_of(point);
    return grid.contains(cell) && grid.free(cell);
  });
}

// Without a free cell under one of the points, the largest free space would count: on an open map that is the outside.
void check_points_inside(const ScenarioFile& file, const WorldCheck& check, const Experiment& experiment) {
  const core::Scenario& scenario = file.scenario;
  const core::SimulationSettings& now = experiment.simulation;
  if (any_on_free_cell(scenario.inside, check.planning_grids().standard())) return;
  if (file.inside) file.document->fail(*file.inside, "'inside_m' must lie on a free planning cell");
  if (!scenario.edge_is_open || scenario.inside.empty()) return;
  const auto would_do = [&](double cell_m) {
    core::SimulationSettings finer = now;
    finer.grid_resolution_m = cell_m;
    return cell_m < now.grid_resolution_m &&
           any_on_free_cell(scenario.inside, core::build_planning_grid(check.geometry(), experiment.robot, finer));
  };
  const auto found = std::find_if(proposed_cells_m.begin(), proposed_cells_m.end(), would_do);
  file.document->fail(
      file.robots.front(),
      fmt::format("robots are drawn in what the listed starts reach, but none of these lies on a free planning cell{}",
                  found == proposed_cells_m.end() ? "" : fmt::format("; grid_resolution_m = {} would do", *found)));
}

// Around a building on a map there can be free cells, too.
void check_inside(const ScenarioFile& file, const core::PlanningGrid& planning, Experiment& experiment) {
  const core::Scenario& scenario = file.scenario;
  const double cell_m2 = planning.resolution_m * planning.resolution_m;
  const auto part = core::part_for_tasks(planning, scenario.inside);
  const auto warn = [&](const std::string& text) {
    experiment.warnings.push_back(file.document->place(file.size) + ": " + text);
  };
  if (const auto largest = core::part_for_tasks(planning, {}); largest.size() > part.size()) {
    const bool is_open = std::binary_search(largest.begin(), largest.end(), part.front());
    const double part_m2 = cell_m2 * static_cast<double>(part.size());
    const double largest_m2 = cell_m2 * static_cast<double>(largest.size());
    if (is_open)
      warn(fmt::format(
          "robots are drawn in the {:.0f} m2 around {}; the outside, {:.0f} m2 beyond ways narrower than "
          "{} m, is left out",
          part_m2, file.inside ? "'inside_m'" : "the listed starts", largest_m2 - part_m2, core::way_outside_m));
    else
      warn(
          fmt::format("robots are drawn in the {:.0f} m2 that {} reach{}; larger free space beyond, {:.0f} m2, is left "
                      "out",
                      part_m2, file.inside ? "'inside_m'" : "the listed starts", file.inside ? "es" : "", largest_m2));
  }
  const auto is_at_edge = [&](std::uint32_t cell) { return planning.at_open_edge[cell] != 0; };
  if (scenario.edge_is_open && std::any_of(part.begin(), part.end(), is_at_edge))
    warn(fmt::format("drawn robots may begin outside the building: {} the edge of the map{}",
                     scenario.inside.empty() ? "their free space reaches" : "the way is open from its inside to",
                     scenario.inside.empty() ? " ('inside_m' = [x, y] in [scenario] names a point inside)"
                                             : " (a [[box]] can close the gap)"));
}

// That every repetition has room for its tasks, and tasks as wished.
void check_drawn_tasks(const ScenarioFile& file, const core::PlanningGrids& grids, const Experiment& experiment,
                       const RandomRobots& drawn) {
  const core::Scenario& scenario = file.scenario;
  const core::TaskWishes& wishes = drawn.wishes;
  if (drawn.most == 0) return;
  if (wishes.drawn == 0 && drawn.types.empty() &&
      core::has_room_for_tasks(grids.standard(), drawn.most, scenario.inside))
    return;
  const std::uint32_t sets = wishes.drawn > 0 ? std::min(wishes.drawn, experiment.trials) : experiment.trials;
  for (std::uint32_t repetition = 0; repetition < sets; ++repetition) {
    const std::uint64_t seed = task_seed(experiment, scenario.name, wishes, repetition);
    const core::DrawnTasks tasks = core::draw_tasks(grids, request_of(drawn, scenario), seed);
    if (const std::size_t found = tasks.tasks.size(); found < drawn.most)
      drawn.at->fail(fmt::format("scenario '{}' has room for {} robots with random tasks (repetition {}: {}), not {}",
                                 scenario.name, found, repetition, lacking_rule(tasks), drawn.most));
    if (!tasks.as_wished)
      drawn.at->fail(
          fmt::format("scenario '{}': none of {} draws of tasks for {} robots has as many conflicts as "
                      "'tasks' wishes (repetition {}; the last one has {}, {} of them in corridors{})",
                      scenario.name, core::task_attempts, drawn.most, repetition, tasks.difficulty.conflicts,
                      tasks.difficulty.corridor_conflicts,
                      tasks.difficulty.well_formed ? "" : ", and robots stand in each other's only way"));
  }
}

}  // namespace

std::string lacking_rule(const core::DrawnTasks& drawn) {
  if (drawn.lack == core::TaskLack::length)
    return fmt::format("a goal must be at least {} m from its start", core::min_task_length_m);
  if (drawn.tasks.empty()) return "no planning cell is free";
  return fmt::format("{}s must be more than {} m apart", drawn.lack == core::TaskLack::goal ? "goal" : "start",
                     core::task_separation_m);
}

core::TaskRequest request_of(const RandomRobots& drawn, const core::Scenario& scenario) {
  return {drawn.most, drawn.types, scenario.inside, drawn.wishes};
}

std::shared_ptr<const core::FlowRoutes> check_world(const ScenarioFile& file, const core::RobotTypes& types,
                                                    Experiment& experiment, const RandomRobots& drawn,
                                                    const TomlTable* root,
                                                    std::shared_ptr<const core::FlowRoutes> routes) {
  check_size(file, experiment.simulation.grid_resolution_m, "the planning grid");
  check_size(file, core::walking_resolution_m, "the grid for people");
  WorldCheck check(file, types, experiment, drawn, root);
  check.run(routes);
  if (drawn.most > 0) check_points_inside(file, check, experiment);
  if (drawn.most > 0) check_inside(file, check.planning_grids().standard(), experiment);
  check_drawn_tasks(file, check.planning_grids(), experiment, drawn);
  return routes;
}

}  // namespace dmrp::host
