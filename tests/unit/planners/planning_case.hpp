// SPDX-License-Identifier: MIT
// A planning problem written as text, handed to a planner through its C interface.
#pragma once

#include <dmrp/dmrp.h>

#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

struct CellXY {
  int x = 0;
  int y = 0;
  bool operator==(const CellXY&) const = default;
};

struct CaseRobot {
  CellXY start;
  std::vector<CellXY> goals;
  uint32_t state = DMRP_ROBOT_ACTIVE;
  double radius_m = 0.15;            // of the circle around the outline; robots of this size fit the cells
  std::vector<dmrp_vec2> outline{};  // a convex polygon; none: the disc
  std::vector<CellXY> closed{};      // cells that are not free for this robot alone
  int64_t waiting_ns = 0;
};

// Cells of 0.5 m with the lower left corner at (10, -3), so that planners cannot rely on unit cells or on the origin.
struct PlanningCase {
  static constexpr double resolution_m = 0.5;
  static constexpr dmrp_vec2 origin{10.0, -3.0};
  static constexpr int64_t effective_from_ns = 700'000'000;
  static constexpr int64_t step_duration_ns = 1'800'000'000;

  int width = 0;
  int height = 0;
  std::vector<uint8_t> free;
  std::vector<uint8_t> edges;  // edge masks of all eight directions, as from the host
  std::vector<CaseRobot> robots;

  // Rows from y = 0 upwards; '.' is free.
  explicit PlanningCase(const std::vector<std::string>& rows)
      : width(static_cast<int>(rows.at(0).size())), height(static_cast<int>(rows.size())) {
    for (const std::string& row : rows)
      for (const char c : row) free.push_back(c == '.');
    edges.assign(free.size(), 0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) open_edges({x, y});
  }

  PlanningCase& robot(CellXY start, std::vector<CellXY> goals, uint32_t state = DMRP_ROBOT_ACTIVE) {
    robots.push_back({start, std::move(goals), state});
    return *this;
  }

  // A thin wall: both cells stay free.
  PlanningCase& thin_wall(CellXY a, CellXY b) { return close_one_way(a, b).close_one_way(b, a); }
  PlanningCase& close_one_way(CellXY from, CellXY to) {
    edges[index(from)] &= static_cast<uint8_t>(~bit(to.x - from.x, to.y - from.y));
    return *this;
  }

  std::size_t index(CellXY c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  bool is_free(CellXY c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height && free[index(c)]; }
  bool is_open(CellXY from, CellXY to) const {
    return is_free(to) && (edges[index(from)] & bit(to.x - from.x, to.y - from.y));
  }
  dmrp_vec2 center(CellXY c) const {
    return {origin.x + (c.x + 0.5) * resolution_m, origin.y + (c.y + 0.5) * resolution_m};
  }

 private:
  static uint8_t bit(int dx, int dy) {
    static constexpr uint8_t bits[3][3] = {{DMRP_EDGE_SW, DMRP_EDGE_S, DMRP_EDGE_SE},
                                           {DMRP_EDGE_W, 0, DMRP_EDGE_E},
                                           {DMRP_EDGE_NW, DMRP_EDGE_N, DMRP_EDGE_NE}};
    return bits[dy + 1][dx + 1];
  }
  void open_edges(CellXY from) {
    if (!is_free(from)) return;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (is_free({from.x + dx, from.y + dy}) && is_free({from.x, from.y + dy}) && is_free({from.x + dx, from.y}))
          edges[index(from)] |= bit(dx, dy);
  }
};

struct Plan {
  int32_t status = -1;
  std::vector<std::vector<dmrp_waypoint>> paths;  // by robot; empty if the planner gave none
  std::map<std::string, double> statistics;

  // The sum of steps of all paths.
  int cost() const {
    int sum = 0;
    for (const auto& path : paths) sum += static_cast<int>(path.size()) - 1;
    return sum;
  }
};

// Owns the C structs of a case while a planner reads them.
class CProblem {
 public:
  explicit CProblem(const PlanningCase& c) {
    grid_.struct_size = sizeof(grid_);
    grid_.width = static_cast<uint32_t>(c.width);
    grid_.height = static_cast<uint32_t>(c.height);
    grid_.resolution_m = PlanningCase::resolution_m;
    grid_.origin = PlanningCase::origin;
    grid_.free = c.free.data();
    grid_.edges = c.edges.data();
    clearance_.assign(c.free.size(), 1.0f);
    grid_.clearance = clearance_.data();

    limits_.struct_size = sizeof(limits_);
    for (const CaseRobot& robot : c.robots) add(c, robot);

    problem_.struct_size = sizeof(problem_);
    problem_.robots = robots_.data();
    problem_.robot_count = static_cast<uint32_t>(robots_.size());
    problem_.robot_stride = sizeof(PaddedRobot);
    problem_.revision = 1;
    problem_.effective_from_ns = PlanningCase::effective_from_ns;
    problem_.step_duration_ns = PlanningCase::step_duration_ns;
    problem_.time_budget_ns = 10'000'000'000;
    problem_.grid = &grid_;

    world_.struct_size = sizeof(world_);
    world_.planning_grid = &grid_;
  }
  CProblem(const CProblem&) = delete;
  CProblem& operator=(const CProblem&) = delete;

  const dmrp_planning_problem& problem() const { return problem_; }
  const dmrp_world& world() const { return world_; }

 private:
  // Longer than the plugin's struct, as from a later host.
  struct PaddedRobot : dmrp_planning_robot {
    uint64_t of_a_later_version = ~uint64_t{0};
  };

  void add(const PlanningCase& c, const CaseRobot& robot) {
    std::vector<dmrp_goal>& goals = goals_.emplace_back();
    for (const CellXY& cell : robot.goals) {
      dmrp_goal goal{};
      goal.pose = {c.center(cell).x, c.center(cell).y, std::nan("")};
      goals.push_back(goal);
    }
    dmrp_robot& whole = whole_.emplace_back();
    whole = {};
    whole.name = "robot";
    whole.kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
    whole.limits = &limits_;
    whole.footprint = footprint_of(robot);
    PaddedRobot& planning = robots_.emplace_back();
    planning.state = robot.state;
    planning.goals = goals.data();
    planning.goal_count = static_cast<uint32_t>(goals.size());
    planning.goal_stride = sizeof(dmrp_goal);
    planning.first_goal_index = 3;  // as if the robot had already reached three goals
    planning.waiting_ns = robot.waiting_ns;
    planning.robot = &whole;
    planning.grid = grid_of(c, robot);
    planning.start = c.center(robot.start);
    planning.pose = {planning.start.x, planning.start.y, 0.0};
  }

  const dmrp_footprint* footprint_of(const CaseRobot& robot) {
    dmrp_polygon& part = parts_.emplace_back();
    part = {robot.outline.data(), static_cast<uint32_t>(robot.outline.size()), 0};
    dmrp_footprint& footprint = footprints_.emplace_back();
    footprint = {
        sizeof(dmrp_footprint), robot.outline.empty() ? 0u : 1u, robot.radius_m, 0.1, &part, sizeof(dmrp_polygon), 0};
    return &footprint;
  }
  const dmrp_grid* grid_of(const PlanningCase& c, const CaseRobot& robot) {
    if (robot.closed.empty()) return &grid_;
    std::vector<uint8_t>& free = free_.emplace_back(c.free);
    for (const CellXY& cell : robot.closed) free[c.index(cell)] = 0;
    own_grids_.push_back(grid_);
    own_grids_.back().free = free.data();
    return &own_grids_.back();
  }

  dmrp_grid grid_{};  // for all robots but those with closed cells
  std::vector<float> clearance_;
  std::deque<dmrp_grid> own_grids_;
  std::deque<std::vector<uint8_t>> free_;
  dmrp_limits limits_{};
  std::deque<dmrp_polygon> parts_;
  std::deque<dmrp_footprint> footprints_;
  std::deque<std::vector<dmrp_goal>> goals_;
  std::deque<dmrp_robot> whole_;
  std::vector<PaddedRobot> robots_;
  dmrp_planning_problem problem_{};
  dmrp_world world_{};
};

inline Plan run_planner(PluginUnderTest& planner, const PlanningCase& c, uint64_t seed = 1) {
  const CProblem problem(c);
  Plan plan;
  plan.paths.resize(c.robots.size());
  dmrp_plan_sink sink{};
  sink.struct_size = sizeof(sink);
  sink.context = &plan;
  sink.path = [](dmrp_plan_sink* to, uint32_t robot, const dmrp_path* path) -> int32_t {
    auto& paths = static_cast<Plan*>(to->context)->paths;
    if (robot >= paths.size() || !paths[robot].empty()) return DMRP_ERROR;
    for (uint32_t i = 0; i < path->count; ++i)
      paths[robot].push_back(*DMRP_AT(dmrp_waypoint, path->waypoints, path->stride, i));
    return DMRP_OK;
  };
  sink.statistic = [](dmrp_plan_sink* to, const char* name, double value) -> int32_t {
    static_cast<Plan*>(to->context)->statistics[name] = value;
    return DMRP_OK;
  };
  if (planner.start(problem.world(), seed) != DMRP_OK) throw std::runtime_error("start() failed");
  plan.status = planner.as<dmrp_global_planner>().plan(planner.self(), &problem.problem(), &sink);
  return plan;
}

inline Plan run_planner(const std::string& id, const PlanningCase& c, ParamOverrides overrides = {}) {
  PluginUnderTest planner("libdmrp_planners.so", id, std::move(overrides));
  return run_planner(planner, c);
}

}  // namespace dmrp::test
