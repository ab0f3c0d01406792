// SPDX-License-Identifier: MIT
// testing.hpp: unit tests of global planners without dmrp-host: a hall drawn in text, one call, and what is wrong with the
// plan. For a test program that contains the plugin's source, and with it the library's entry.
//
//   #include "my_plugin.cpp"
//   #include <dmrp/testing.hpp>
//
//   int main() {
//     const auto plan = dmrp::testing::plan("org.example.my_plugin", dmrp::testing::Hall({"A.#.b",
//                                                                                         "..#..",
//                                                                                         "B...a"}));
//     return plan.status == DMRP_OK && plan.breach.empty() ? 0 : 1;
//   }
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "plugin.hpp"

DMRP_ENTRY_DECLARATION;  // of the plugin under test

namespace dmrp {
namespace testing {

// A world of square cells, the first row on top: '#' is a wall, capitals A, B, ... are starts of robots, in this order,
// and the small letters their goals; anything else is free. Cells are 1 m, robots are discs of 0.35 m.
class Hall {
 public:
  explicit Hall(const std::vector<std::string>& rows) : rows_(rows) {
    height_ = static_cast<std::uint32_t>(rows.size());
    width_ = height_ > 0 ? static_cast<std::uint32_t>(rows[0].size()) : 0;
    for (const std::string& row : rows)
      if (row.size() != width_) throw std::invalid_argument("a hall has rows of one length");
    draw_grid();
    for (char name = 'A'; name <= 'Z' && has(name); ++name) add_robot(name);
    finish();
  }
  Hall(const Hall&) = delete;
  Hall& operator=(const Hall&) = delete;

  const dmrp_world& world() const { return world_; }
  const dmrp_planning_problem& problem() const { return problem_; }
  bool is_free(Vec2 at) const { return cell_is_free(std::floor(at.x), std::floor(at.y)); }

 private:
  char letter(std::uint32_t column, std::uint32_t row) const { return rows_[height_ - 1 - row][column]; }
  bool cell_is_free(double column, double row) const {
    return column >= 0 && row >= 0 && column < width_ && row < height_ &&
           letter(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) != '#';
  }
  bool has(char wanted) const {
    for (const std::string& row : rows_)
      if (row.find(wanted) != std::string::npos) return true;
    return false;
  }
  Vec2 place_of(char wanted) const {
    for (std::uint32_t row = 0; row < height_; ++row)
      for (std::uint32_t column = 0; column < width_; ++column)
        if (letter(column, row) == wanted) return {column + 0.5, row + 0.5};
    throw std::invalid_argument(std::string("the hall has no '") + wanted + "'");
  }

  void draw_grid() {
    for (std::uint32_t row = 0; row < height_; ++row)
      for (std::uint32_t column = 0; column < width_; ++column) {
        const double x = column;
        const double y = row;
        const bool free = cell_is_free(x, y);
        std::uint8_t open = 0;
        const auto add = [&](std::uint32_t bit, double dx, double dy) {
          const bool clear = cell_is_free(x + dx, y + dy) && cell_is_free(x + dx, y) && cell_is_free(x, y + dy);
          if (free && clear) open = static_cast<std::uint8_t>(open | bit);
        };
        add(DMRP_EDGE_E, 1, 0), add(DMRP_EDGE_NE, 1, 1), add(DMRP_EDGE_N, 0, 1), add(DMRP_EDGE_NW, -1, 1);
        add(DMRP_EDGE_W, -1, 0), add(DMRP_EDGE_SW, -1, -1), add(DMRP_EDGE_S, 0, -1), add(DMRP_EDGE_SE, 1, -1);
        free_.push_back(free ? 1 : 0);
        edges_.push_back(open);
        clearance_.push_back(free ? 0.5f : 0.0f);
      }
  }

  void add_robot(char name) {
    const double any = std::numeric_limits<double>::quiet_NaN();
    const Vec2 start = place_of(name);
    const Vec2 goal = place_of(static_cast<char>(name - 'A' + 'a'));
    names_.emplace_back(1, name);
    goals_.push_back({{goal.x, goal.y, any}, 0.2, 0.3, 0.1, 0});
    dmrp_robot robot{};
    robot.name = names_.back().c_str();
    robot.type = "";
    robot.kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
    robot.goal_count = 1;
    robot.goals = &goals_.back();
    robot.goal_stride = sizeof(dmrp_goal);
    robot.limits = &limits_;
    robot.footprint = &footprint_;
    robot.start = {start.x, start.y, 0.0};
    robots_.push_back(robot);
    dmrp_planning_robot planning{};
    planning.goal_count = 1;
    planning.goals = robot.goals;
    planning.goal_stride = robot.goal_stride;
    planning.grid = &grid_;
    planning.pose = robot.start;
    planning.start = start;
    planning_.push_back(planning);
  }

  void finish() {
    limits_.struct_size = sizeof(limits_);
    limits_.v_max = 1.0;
    limits_.omega_max = 1.0;
    limits_.a_max = 1.0;
    limits_.alpha_max = 2.0;
    footprint_.struct_size = sizeof(footprint_);
    footprint_.radius_m = footprint_.inscribed_radius_m = 0.35;
    grid_ = {sizeof(grid_), width_, height_, 0, 1.0, {0.0, 0.0}, free_.data(), edges_.data(), clearance_.data()};
    world_.struct_size = sizeof(world_);
    world_.upper = {static_cast<double>(width_), static_cast<double>(height_)};
    world_.step_ns = 20'000'000;
    world_.control_period_ns = 100'000'000;
    world_.time_limit_ns = 600'000'000'000;
    world_.call_budget_ns = 1'000'000'000;
    world_.robots = robots_.data();
    world_.robot_count = static_cast<std::uint32_t>(robots_.size());
    world_.robot_stride = sizeof(dmrp_robot);
    world_.planning_grid = &grid_;
    for (std::size_t i = 0; i < planning_.size(); ++i) planning_[i].robot = &robots_[i];
    problem_.struct_size = sizeof(problem_);
    problem_.robot_count = world_.robot_count;
    problem_.robots = planning_.data();
    problem_.robot_stride = sizeof(dmrp_planning_robot);
    problem_.revision = 1;
    problem_.step_duration_ns = 1'000'000'000;
    problem_.time_budget_ns = 10'000'000'000;
    problem_.grid = &grid_;
    problem_.in_force_stride = sizeof(dmrp_path);
  }

  std::vector<std::string> rows_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> edges_;
  std::vector<float> clearance_;
  dmrp_limits limits_{};
  dmrp_footprint footprint_{};
  dmrp_grid grid_{};
  std::deque<std::string> names_;  // robots point into these
  std::deque<dmrp_goal> goals_;
  std::vector<dmrp_robot> robots_;
  std::vector<dmrp_planning_robot> planning_;
  dmrp_world world_{};
  dmrp_planning_problem problem_{};
};

using Value = std::variant<bool, std::int64_t, double, std::string>;

struct PlannerAnswer {
  std::int32_t status = DMRP_ERROR;          // of the call that ended it: plan(), or create() or start()
  std::string error;                         // what the plugin said of it
  std::vector<std::vector<Waypoint>> paths;  // by robot
  std::map<std::string, double> statistics;
  std::vector<std::string> log;
  // What a host would refuse, or "": a path that does not begin at the start, ends elsewhere than at the goal, leaves the
  // free cells, or steps too far; two robots on one cell, or that change places.
  std::string breach;
};

namespace detail {

// A planner of this program, from create() to destroy().
class Rehearsal {
 public:
  Rehearsal(const Hall& hall, PlannerAnswer& out) : hall_(hall), out_(out) {
    host_.struct_size = sizeof(host_);
    host_.abi_minor = DMRP_ABI_MINOR;
    host_.context = this;
    host_.name = "dmrp-testing";
    host_.version = "1";
    host_.library_path = "";
    host_.log = [](const dmrp_host* host, std::int32_t, const char* text) { of(host).out_.log.emplace_back(text); };
    host_.set_error = [](const dmrp_host* host, const char* text) { of(host).out_.error = text; };
    host_.should_stop = [](const dmrp_host*) -> std::int32_t { return 0; };
    host_.get_extension = [](const dmrp_host*, const char*) -> const void* { return nullptr; };
    host_.budget_left_ns = [](const dmrp_host* host) { return of(host).hall_.problem().time_budget_ns; };
  }

  void run(const dmrp_descriptor& descriptor, const std::map<std::string, Value>& parameters) {
    const std::vector<dmrp_param_value> values = values_of(descriptor, parameters);
    const dmrp_params params = {sizeof(params), static_cast<std::uint32_t>(values.size()), sizeof(dmrp_param_value), 0,
                                values.data()};
    dmrp_plugin plugin{};
    plugin.struct_size = sizeof(plugin);
    out_.status = dmrp_entry_v1.create(&dmrp_entry_v1, &host_, descriptor.id, &params, &plugin);
    if (out_.status != DMRP_OK) return;
    const dmrp_start start = {sizeof(start), DMRP_NO_ROBOT, 1, &hall_.world()};
    out_.status = plugin.start(plugin.self, &start);
    if (out_.status == DMRP_OK) plan(plugin);
    plugin.destroy(plugin.self);
  }

 private:
  static Rehearsal& of(const dmrp_host* host) { return *static_cast<Rehearsal*>(host->context); }
  static Rehearsal& of(const dmrp_plan_sink* sink) { return *static_cast<Rehearsal*>(sink->context); }

  void plan(const dmrp_plugin& plugin) {
    dmrp_plan_sink sink{};
    sink.struct_size = sizeof(sink);
    sink.context = this;
    sink.path = [](dmrp_plan_sink* to, std::uint32_t robot, const dmrp_path* path) -> std::int32_t {
      auto& paths = of(to).out_.paths;
      if (robot >= paths.size() || !paths[robot].empty()) return DMRP_ERROR;
      for (const Waypoint& waypoint : Path(*path)) paths[robot].push_back(waypoint);
      return DMRP_OK;
    };
    sink.statistic = [](dmrp_plan_sink* to, const char* name, double value) -> std::int32_t {
      of(to).out_.statistics[name] = value;
      return DMRP_OK;
    };
    out_.paths.assign(hall_.world().robot_count, {});
    out_.status = static_cast<const dmrp_global_planner*>(plugin.table)->plan(plugin.self, &hall_.problem(), &sink);
    if (out_.status == DMRP_OK) out_.breach = breach();
  }

  static std::vector<dmrp_param_value> values_of(const dmrp_descriptor& descriptor,
                                                 const std::map<std::string, Value>& parameters) {
    std::vector<dmrp_param_value> values;
    for (std::uint32_t i = 0; i < descriptor.param_count; ++i) {
      const auto& spec = *DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i);
      values.push_back(
          {spec.key, spec.type, spec.count, spec.integer, spec.number, spec.text, spec.numbers, spec.texts});
      const auto given = parameters.find(spec.key);
      if (given == parameters.end()) continue;
      if (const auto* flag = std::get_if<bool>(&given->second)) values.back().integer = *flag ? 1 : 0;
      if (const auto* integer = std::get_if<std::int64_t>(&given->second)) values.back().integer = *integer;
      if (const auto* number = std::get_if<double>(&given->second)) values.back().number = *number;
      if (const auto* text = std::get_if<std::string>(&given->second)) values.back().text = text->c_str();
    }
    return values;
  }

  // Where a robot is at a step; it rests at its last waypoint.
  Vec2 at(std::size_t robot, std::size_t step) const {
    const std::vector<Waypoint>& path = out_.paths[robot];
    const Waypoint& waypoint = path[step < path.size() ? step : path.size() - 1];
    return {waypoint.x, waypoint.y};
  }
  static bool same(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-6; }

  std::string breach_of_path(std::size_t robot) const {
    const auto& asked = hall_.problem().robots[robot];
    const std::string name = hall_.world().robots[robot].name;
    if (out_.paths[robot].empty()) return name + " has no path";
    if (!same(at(robot, 0), asked.start)) return name + " does not begin at its start";
    if (!same(at(robot, out_.paths[robot].size() - 1), {asked.goals->pose.x, asked.goals->pose.y}))
      return name + " does not end at its goal";
    for (std::size_t step = 0; step < out_.paths[robot].size(); ++step) {
      const std::string when = " at step " + std::to_string(step);
      if (!hall_.is_free(at(robot, step))) return name + " is on no free cell" + when;
      if (step == 0) continue;
      const Vec2 before = at(robot, step - 1);
      const Vec2 now = at(robot, step);
      if (std::fabs(now.x - before.x) > 1.0 + 1e-6 || std::fabs(now.y - before.y) > 1.0 + 1e-6)
        return name + " moves more than a cell" + when;
    }
    return "";
  }

  std::string breach() const {
    std::size_t steps = 0;
    for (std::size_t robot = 0; robot < out_.paths.size(); ++robot) {
      const std::string why = breach_of_path(robot);
      if (!why.empty()) return why;
      if (out_.paths[robot].size() > steps) steps = out_.paths[robot].size();
    }
    for (std::size_t step = 0; step < steps; ++step)
      for (std::size_t a = 0; a < out_.paths.size(); ++a)
        for (std::size_t b = a + 1; b < out_.paths.size(); ++b) {
          const std::string both = std::string(hall_.world().robots[a].name) + " and " + hall_.world().robots[b].name;
          if (same(at(a, step), at(b, step))) return both + " are on one cell at step " + std::to_string(step);
          if (step > 0 && same(at(a, step), at(b, step - 1)) && same(at(b, step), at(a, step - 1)))
            return both + " change places at step " + std::to_string(step);
        }
    return "";
  }

  const Hall& hall_;
  PlannerAnswer& out_;
  dmrp_host host_{};
};

}  // namespace detail

// Makes the planner with this id, with its default parameters but for those given, and asks it once.
inline PlannerAnswer plan(const std::string& id, const Hall& hall,
                          const std::map<std::string, Value>& parameters = {}) {
  PlannerAnswer answer;
  for (std::uint32_t i = 0; i < dmrp_entry_v1.plugin_count(&dmrp_entry_v1); ++i) {
    const dmrp_descriptor* descriptor = dmrp_entry_v1.descriptor(&dmrp_entry_v1, i);
    if (!descriptor || id != descriptor->id) continue;
    if (descriptor->kind != DMRP_KIND_GLOBAL_PLANNER) throw std::invalid_argument(id + " is no global planner");
    detail::Rehearsal(hall, answer).run(*descriptor, parameters);
    return answer;
  }
  throw std::invalid_argument("this program has no plugin " + id);
}

}  // namespace testing
}  // namespace dmrp
