// SPDX-License-Identifier: MIT
#include "host/experiment/check_worlds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <memory>
#include <string>

#include "core/scene/planning_grid.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/check_people.hpp"

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

class WorldCheck {
 public:
  WorldCheck(const ScenarioFile& file, Experiment& experiment, std::size_t most_drawn)
      : file_(file),
        experiment_(experiment),
        most_drawn_(most_drawn),
        scenario_(file.scenario),
        radius_m_(experiment.robot.radius_m),
        needed_m_(radius_m_ + experiment.simulation.planning_margin_m),
        geometry_(std::make_shared<core::StaticGeometry>(scenario_)),
        planning_(core::build_planning_grid(*geometry_, experiment.simulation.grid_resolution_m, radius_m_,
                                            experiment.simulation.planning_margin_m)) {}

  const core::PlanningGrid& planning_grid() const { return planning_; }

  void run() {
    for (std::size_t i = 0; i < scenario_.robots.size(); ++i) check_robot(i);
    for (std::size_t a = 0; a < scenario_.robots.size(); ++a)
      for (std::size_t b = a + 1; b < scenario_.robots.size(); ++b) check_pair(a, b);
    check_people(file_, geometry_, planning_, most_drawn_, experiment_);
    const double safe_cell_m = 2.0 * std::sqrt(2.0) * radius_m_;
    if (scenario_.robots.size() > 1 && experiment_.simulation.grid_resolution_m < safe_cell_m)
      warn(file_.size,
           fmt::format("cells of {} m are smaller than 2 sqrt(2) r = {:.3f} m: robots that follow a valid plan can "
                       "touch",
                       experiment_.simulation.grid_resolution_m, safe_cell_m));
  }

 private:
  void warn(SourcePosition at, const std::string& text) {
    experiment_.warnings.push_back(file_.document->place(at) + ": " + text);
  }
  [[noreturn]] void fail_robot(std::size_t robot, const std::string& text) const {
    file_.document->fail(file_.robots[robot], fmt::format("robot {} {}", robot + 1, text));
  }

  // A pose must be reachable from the centre of its planning cell, which stands for it in plans.
  void check_place(std::size_t robot, const char* verb, const char* noun, dmrp_vec2 point) const {
    if (!geometry_->inside_world(point))
      fail_robot(robot, fmt::format("{} outside the world, at ({}, {})", verb, point.x, point.y));
    const core::NearestShape nearest = geometry_->nearest(point);
    const std::string shape(geometry_->shape_name(nearest.shape));
    const bool border = nearest.shape == geometry_->border();
    const std::string name = border ? shape : "'" + shape + "'";
    if (nearest.clearance_m < radius_m_)
      fail_robot(robot, fmt::format("{} {} {} (clearance {:.2f} m, needs {:.2f} m)", verb,
                                    nearest.clearance_m == 0.0 ? "inside" : "too near to", name, nearest.clearance_m,
                                    needed_m_));
    const dmrp_grid view = planning_.view();
    const toolkit::GridView grid(view);
    const toolkit::Cell cell = grid.cell_of(point);
    const dmrp_vec2 center = grid.center(cell);
    if (!grid.contains(cell) || !grid.free(cell))
      fail_robot(robot,
                 fmt::format("has its {} ({}, {}) on a planning cell that is not free (centre ({}, {}), clearance "
                             "{:.2f} m, needs {:.2f} m)",
                             noun, point.x, point.y, center.x, center.y, geometry_->clearance(center), needed_m_));
    if (!geometry_->sweep_is_free(center, point, radius_m_))
      fail_robot(robot,
                 fmt::format("cannot get from its {} ({}, {}) to the centre of its cell", noun, point.x, point.y));
  }

  void check_robot(std::size_t robot) const {
    const core::RobotTask& task = scenario_.robots[robot];
    const dmrp_vec2 start = {task.start.x, task.start.y};
    check_place(robot, "starts", "start", start);
    const dmrp_grid view = planning_.view();
    const toolkit::GridView grid(view);
    const auto seen = core::reachable_cells(planning_, grid.index(grid.cell_of(start)));
    for (const dmrp_pose& goal : task.goals) {
      const dmrp_vec2 point = {goal.x, goal.y};
      check_place(robot, "has its goal", "goal", point);
      if (!seen[grid.index(grid.cell_of(point))])
        fail_robot(robot, fmt::format("cannot reach its goal ({}, {}) from its start ({}, {}) on the planning grid",
                                      goal.x, goal.y, start.x, start.y));
    }
  }

  void check_pair(std::size_t a, std::size_t b) {
    const core::RobotTask& first = scenario_.robots[a];
    const core::RobotTask& second = scenario_.robots[b];
    check_distance(a, b, "start", first.start, second.start);
    check_distance(a, b, "goal", first.goals.back(), second.goals.back());
  }

  void check_distance(std::size_t a, std::size_t b, const char* noun, const dmrp_pose& p, const dmrp_pose& q) {
    const dmrp_grid view = planning_.view();
    const toolkit::GridView grid(view);
    const double distance_m = std::hypot(p.x - q.x, p.y - q.y);
    if (distance_m < 2.0 * radius_m_)
      fail_robot(b, fmt::format("overlaps robot {} at its {} (distance {:.2f} m, needs {:.2f} m)", a + 1, noun,
                                distance_m, 2.0 * radius_m_));
    if (grid.index(grid.cell_of({p.x, p.y})) == grid.index(grid.cell_of({q.x, q.y})))
      fail_robot(b, fmt::format("has its {} on the same planning cell as robot {}", noun, a + 1));
    if (distance_m <= start_distance_m)
      warn(file_.robots[b],
           fmt::format("the {}s of robots {} and {} are {:.2f} m apart; the method wants more than {} m", noun, a + 1,
                       b + 1, distance_m, start_distance_m));
  }

  const ScenarioFile& file_;
  Experiment& experiment_;
  std::size_t most_drawn_;
  const core::Scenario& scenario_;
  double radius_m_;
  double needed_m_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  core::PlanningGrid planning_;
};

}  // namespace

void check_world(const ScenarioFile& file, Experiment& experiment, const RandomRobots& drawn) {
  check_size(file, experiment.simulation.grid_resolution_m, "the planning grid");
  check_size(file, core::walking_resolution_m, "the grid for people");
  WorldCheck check(file, experiment, drawn.most);
  check.run();
  if (drawn.most == 0 || core::has_room_for_tasks(check.planning_grid(), drawn.most)) return;
  for (std::uint32_t repetition = 0; repetition < experiment.trials; ++repetition) {
    const std::uint64_t seed = world_seed(experiment, file.scenario.name, repetition);
    const std::size_t found = core::random_tasks(check.planning_grid(), drawn.most, seed).size();
    if (found < drawn.most)
      drawn.at->fail(
          fmt::format("scenario '{}' has room for {} robots with random tasks (repetition {}: starts, and goals, more "
                      "than {} m apart), not {}",
                      file.scenario.name, found, repetition, core::task_separation_m, drawn.most));
  }
}

}  // namespace dmrp::host
