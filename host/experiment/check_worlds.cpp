// SPDX-License-Identifier: MIT
#include "host/experiment/check_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/people/first_places.hpp"
#include "core/people/flow_routes.hpp"
#include "core/people/population.hpp"
#include "core/people/walking_groups.hpp"
#include "core/scene/planning_grid.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/errors/input_error.hpp"

namespace dmrp::host {

namespace {

constexpr double start_distance_m = 2.0;  // between starts and between goals, by the method
constexpr double most_cells = 1 << 24;
constexpr int group_attempts = 32;

void check_size(const ScenarioFile& file, double resolution_m, const char* grid) {
  const core::Scenario& scenario = file.scenario;
  const double cells =
      (scenario.upper.x - scenario.lower.x) * (scenario.upper.y - scenario.lower.y) / (resolution_m * resolution_m);
  if (cells > most_cells)
    file.document->fail(file.size, fmt::format("the world is too large: {} of {} m cells would have {:.0f} of them, at "
                                               "most {:.0f}",
                                               grid, resolution_m, cells, most_cells));
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
    if (core::walker_count(scenario_) > 0) check_flows();
    check_tracks();
    for (const RecordingPlace& recording : file_.recordings) check_seen(recording);
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

  // A pose must stand on the cell that planners know it by.
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

  // Cells of the walking grid in a region, free ones.
  std::vector<std::uint32_t> free_cells(const toolkit::GridView& grid, const core::Region& region) const {
    std::vector<std::uint32_t> cells;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
      const dmrp_vec2 c = grid.center(cell);
      const double half = 0.5 * grid.resolution_m();
      if (grid.free(cell) && c.x >= region.lower.x - half && c.x <= region.upper.x + half &&
          c.y >= region.lower.y - half && c.y <= region.upper.y + half)
        cells.push_back(cell);
    }
    return cells;
  }

  void check_flows() const {
    const core::PlanningGrid walking = core::build_walking_grid(*geometry_, scenario_.people.radius_m);
    for (std::size_t i = 0; i < scenario_.flows.size(); ++i)
      if (scenario_.flows[i].people > 0) check_flow(walking, i);
    const core::FlowRoutes routes = core::find_flow_routes(scenario_, walking);
    check_room(routes);
    for (std::size_t i = 0; i < scenario_.flows.size(); ++i) check_groups(routes, i);
  }

  // Where somebody is at a row of a recording.
  void check_tracks() const {
    for (std::size_t i = 0; i < scenario_.tracks.size(); ++i)
      for (std::size_t row = 0; row < scenario_.tracks[i].points.size(); ++row) {
        const dmrp_vec2 point = scenario_.tracks[i].points[row].position;
        const TrackPlace& place = file_.tracks[i];
        const auto fail = [&](const std::string& where) {
          throw InputError(fmt::format("{}:{}:1: person {} is {}, at ({}, {})", place.shown_path, place.lines[row],
                                       place.id, where, point.x, point.y));
        };
        if (!geometry_->inside_world(point)) fail("outside the world");
        const core::NearestShape nearest = geometry_->nearest(point);
        if (nearest.clearance_m == 0.0 && nearest.shape != geometry_->border())
          fail(fmt::format("inside '{}'", geometry_->shape_name(nearest.shape)));
      }
  }

  // Times of a recording may be anywhere; but somebody should be there during the trial.
  void check_seen(const RecordingPlace& recording) {
    const core::SimulationSettings& simulation = experiment_.simulation;
    const double limit_s =
        experiment_.time_limit_set ? 1e-9 * static_cast<double>(simulation.time_limit_ns) : scenario_.time_limit_s;
    double first_s = std::numeric_limits<double>::infinity();
    double last_s = -first_s;
    for (std::size_t i = recording.first; i < recording.end; ++i) {
      const double from_s = 1e-9 * static_cast<double>(scenario_.tracks[i].points.front().t_ns);
      const double to_s = 1e-9 * static_cast<double>(scenario_.tracks[i].points.back().t_ns);
      if (to_s >= 0.0 && from_s <= limit_s) return;
      first_s = std::min(first_s, from_s);
      last_s = std::max(last_s, to_s);
    }
    warn(recording.position,
         fmt::format(
             "nobody of '{}' is there during the trial, from 0 to {:.10g} s: its rows are of {:.10g} to {:.10g} s",
             recording.shown_path, limit_s, first_s, last_s));
  }

  // For all who are there at t = 0, in every repetition: they begin elsewhere each time, and so do robots that are drawn.
  // One is enough where there is room to spare and robots start where they always do.
  void check_room(const core::FlowRoutes& routes) const {
    core::Scenario with_spare = scenario_;
    for (core::Flow& flow : with_spare.flows) flow.people += flow.people / 4;
    for (std::uint32_t repetition = 0; repetition < experiment_.trials; ++repetition) {
      const std::uint64_t seed = world_seed(experiment_, scenario_.name, repetition);
      const std::vector<dmrp_vec2> starts = starts_kept_clear(seed);
      if (const auto none = missing_room(scenario_, routes, seed, starts))
        file_.document->fail(file_.flows[none->flow], none->what());
      if (most_drawn_ == 0 && !missing_room(with_spare, routes, seed, starts)) return;
    }
  }

  std::optional<core::NoRoom> missing_room(const core::Scenario& scenario, const core::FlowRoutes& routes,
                                           std::uint64_t seed, const std::vector<dmrp_vec2>& starts) const {
    try {
      const core::Population population(scenario, geometry_, routes, seed, starts);
      return std::nullopt;
    } catch (const core::NoRoom& none) {
      return none;
    }
  }

  // A group that begins anew stands in the first region together, across its way.
  void check_groups(const core::FlowRoutes& routes, std::size_t index) const {
    const core::Flow& flow = scenario_.flows[index];
    const std::uint32_t size = std::min(flow.group_size, flow.people);
    if (size < 2 || !flow.respawn) return;
    const core::Route& first_leg = routes.legs[index].front();
    const double heading = toolkit::heading_at(first_leg, toolkit::arc_lengths(first_leg), 0.0, 0.0);
    const core::Region& region = scenario_.regions[flow.regions.front()];
    const core::StandingRoom room = {*geometry_, scenario_.people.radius_m, {}, {}};
    for (int attempt = 0; attempt < group_attempts; ++attempt) {
      toolkit::Stream stream(experiment_.seed, "check.groups", index, attempt);
      if (core::draw_places(room, {region.lower, region.upper}, heading, size, stream)) return;
    }
    file_.document->fail(file_.flows[index], fmt::format("flow '{}': no room in region '{}' for a group of {}",
                                                         flow.name, region.name, size));
  }

  // Where nobody begins near: the starts of robots that take part, or would under another number.
  std::vector<dmrp_vec2> starts_kept_clear(std::uint64_t seed) const {
    std::vector<dmrp_vec2> starts = scenario_.other_starts;
    for (const core::RobotTask& task : scenario_.robots) starts.push_back({task.start.x, task.start.y});
    if (most_drawn_ > 0)
      for (const core::RobotTask& task : core::random_tasks(planning_, most_drawn_, seed))
        starts.push_back({task.start.x, task.start.y});
    return starts;
  }

  void check_flow(const core::PlanningGrid& walking, std::size_t index) const {
    const toolkit::GridView grid(walking.view());
    const core::Flow& flow = scenario_.flows[index];
    std::vector<bool> seen;
    std::string last;
    for (const std::uint32_t region_index : flow.regions) {
      const core::Region& region = scenario_.regions[region_index];
      const auto cells = free_cells(grid, region);
      if (cells.empty())
        file_.document->fail(file_.regions[region_index],
                             fmt::format("region '{}' has no free place for a person", region.name));
      if (seen.empty()) seen = core::reachable_cells(walking, cells.front());
      if (std::none_of(cells.begin(), cells.end(), [&](std::uint32_t cell) { return seen[cell]; }))
        file_.document->fail(file_.flows[index],
                             fmt::format("flow '{}': nobody can walk from '{}' to '{}'", flow.name, last, region.name));
      last = region.name;
    }
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

void check_world(const ScenarioFile& file, Experiment& experiment, const DrawnRobots& drawn) {
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
          fmt::format("scenario '{}' holds at most {} robots drawn so (repetition {}: starts, and goals, more "
                      "than {} m apart), not {}",
                      file.scenario.name, found, repetition, core::task_separation_m, drawn.most));
  }
}

}  // namespace dmrp::host
