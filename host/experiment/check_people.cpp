// SPDX-License-Identifier: MIT
#include "host/experiment/check_people.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/people/first_places.hpp"
#include "core/people/flow_routes.hpp"
#include "core/people/population.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/mistakes.hpp"

namespace dmrp::host {

namespace {

constexpr int group_attempts = 32;
constexpr double fastest_mps = 5.0;  // that a person is taken to walk

class PeopleCheck {
 public:
  PeopleCheck(const ScenarioFile& file, const core::RobotTypes& types,
              const std::shared_ptr<const core::StaticGeometry>& geometry, const core::PlanningGrids& planning,
              const RandomRobots& drawn, Experiment& experiment, std::shared_ptr<const core::FlowRoutes>& routes)
      : file_(file),
        types_(types),
        scenario_(file.scenario),
        geometry_(geometry),
        planning_(planning),
        drawn_(drawn),
        experiment_(experiment),
        routes_(routes) {}

  void run() {
    Mistakes mistakes;
    mistakes.attempt([&] {
      if (core::walker_count(scenario_) > 0) check_flows();
    });
    mistakes.attempt([&] { check_tracks(); });
    mistakes.end();
    for (const RecordingPlace& recording : file_.recordings) {
      check_seen(recording);
      check_walks(recording);
    }
  }

 private:
  void warn(SourcePosition at, const std::string& text) {
    experiment_.warnings.push_back(file_.document->place(at) + ": " + text);
  }

  void check_flows() {
    const core::PlanningGrid walking = core::build_walking_grid(*geometry_, scenario_.people.radius_m);
    Mistakes mistakes;
    for (std::size_t i = 0; i < scenario_.flows.size(); ++i)
      if (scenario_.flows[i].people > 0) mistakes.attempt([&] { check_flow(walking, i); });
    mistakes.end();
    if (!routes_) routes_ = std::make_shared<core::FlowRoutes>(core::find_flow_routes(scenario_, walking));
    mistakes.attempt([&] { check_room(*routes_); });
    for (std::size_t i = 0; i < scenario_.flows.size(); ++i) mistakes.attempt([&] { check_groups(*routes_, i); });
    mistakes.end();
  }

  // The free cells of the walking grid that touch a region.
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

  // Checks that there is room for all people at t = 0 in every repetition: their places differ, and so do the starts of
  // robots with random tasks. One repetition suffices if there is room to spare and the robots' starts are fixed.
  void check_room(const core::FlowRoutes& routes) const {
    core::Scenario with_spare = scenario_;
    for (core::Flow& flow : with_spare.flows) flow.people += flow.people / 4;
    for (std::uint32_t repetition = 0; repetition < experiment_.trials; ++repetition) {
      const std::uint64_t seed = world_seed(experiment_, scenario_.name, repetition);
      const std::vector<dmrp_vec2> starts = starts_kept_clear(repetition);
      if (const auto none = missing_room(scenario_, routes, seed, starts))
        file_.document->fail(file_.flows[none->flow], none->what());
      if (drawn_.most == 0 && !missing_room(with_spare, routes, seed, starts)) return;
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

  // The starts of which people keep clear: of all robots that take part with any number of robots.
  std::vector<dmrp_vec2> starts_kept_clear(std::uint32_t repetition) const {
    std::vector<dmrp_vec2> starts = scenario_.other_starts;
    for (const core::RobotTask& task : scenario_.robots) starts.push_back({task.start.x, task.start.y});
    if (drawn_.most == 0) return starts;
    const std::uint64_t seed = task_seed(experiment_, scenario_.name, drawn_.wishes, repetition);
    for (const core::RobotTask& task : core::draw_tasks(planning_, request_of(drawn_, scenario_), seed).tasks)
      starts.push_back({task.start.x, task.start.y});
    return starts;
  }

  // Checks that a respawned group can stand together in the first region, side by side across its way.
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

  // Checks the position of every row of the recordings.
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

  // Warns if no recorded person is present during the trial. Times of a recording may have any range.
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
             "nobody in '{}' is present during the trial, from 0 to {:.10g} s: its rows are from {:.10g} to {:.10g} s",
             recording.shown_path, limit_s, first_s, last_s));
  }

  // Warns of what nobody walks, at the first of it: other units or axes, or rows that are missing.
  void check_walks(const RecordingPlace& recording) {
    Doubts fast, through, on_start;
    for (std::size_t i = recording.first; i < recording.end; ++i) {
      const core::Track& track = scenario_.tracks[i];
      const auto& points = track.points;
      for (std::size_t row = 1; row < points.size(); ++row) {
        const dmrp_vec2 from = points[row - 1].position;
        const dmrp_vec2 to = points[row].position;
        const double speed_mps =
            toolkit::distance(from, to) / (1e-9 * static_cast<double>(points[row].t_ns - points[row - 1].t_ns));
        if (speed_mps > fastest_mps)
          fast.add(i, row, fmt::format("moves at {:.1f} m/s, faster than {} m/s", speed_mps, fastest_mps));
        if (!geometry_->sweep_is_free(from, to, 0.0))
          through.add(
              i, row,
              fmt::format("goes through a wall or shape, from ({}, {}) to ({}, {})", from.x, from.y, to.x, to.y));
      }
      if (!core::is_on_track(track, 0)) continue;
      const dmrp_vec2 at = core::position_on(track, 0);
      for (std::size_t robot = 0; robot < scenario_.robots.size(); ++robot) {
        const core::RobotTask& task = scenario_.robots[robot];
        const double distance_m = toolkit::distance(at, {task.start.x, task.start.y});
        if (distance_m < types_.of(task).radius_m + scenario_.people.radius_m)
          on_start.add(i, 0, fmt::format("is on the start of robot {} at 0 s, {:.2f} m from it", robot, distance_m));
      }
    }
    for (const Doubts* doubts : {&fast, &through, &on_start})
      if (doubts->people > 0) warn(*doubts);
  }

  // What holds for rows of a recording: the first of them, and the number of people.
  struct Doubts {
    std::size_t people = 0;
    std::size_t track = 0;
    std::size_t row = 0;
    std::string text{};
    std::size_t last = 0;  // track

    void add(std::size_t of_track, std::size_t at_row, std::string what) {
      if (people > 0 && last == of_track) return;
      if (people++ == 0) {
        track = of_track;
        row = at_row;
        text = std::move(what);
      }
      last = of_track;
    }
  };

  void warn(const Doubts& doubts) {
    const TrackPlace& place = file_.tracks[doubts.track];
    const std::size_t others = doubts.people - 1;
    experiment_.warnings.push_back(fmt::format("{}:{}:1: person {} {}{}", place.shown_path, place.lines[doubts.row],
                                               place.id, doubts.text,
                                               others == 0 ? "" : fmt::format(" (and {} more)", others)));
  }

  const ScenarioFile& file_;
  const core::RobotTypes& types_;
  const core::Scenario& scenario_;
  std::shared_ptr<const core::StaticGeometry> geometry_;
  const core::PlanningGrids& planning_;
  const RandomRobots& drawn_;
  Experiment& experiment_;
  std::shared_ptr<const core::FlowRoutes>& routes_;
};

}  // namespace

void check_people(const ScenarioFile& file, const core::RobotTypes& types,
                  const std::shared_ptr<const core::StaticGeometry>& geometry, const core::PlanningGrids& planning,
                  const RandomRobots& drawn, Experiment& experiment, std::shared_ptr<const core::FlowRoutes>& routes) {
  PeopleCheck(file, types, geometry, planning, drawn, experiment, routes).run();
}

}  // namespace dmrp::host
