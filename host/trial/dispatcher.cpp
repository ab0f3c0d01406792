// SPDX-License-Identifier: MIT
#include "host/trial/dispatcher.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::host {

namespace {

// The position along a path at a time; after the last waypoint, the end of the path.
dmrp_vec2 position_at(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  const auto after = std::find_if(path.begin(), path.end(), [&](const dmrp_waypoint& w) { return w.t_ns > t_ns; });
  if (after == path.begin()) return toolkit::position(path.front());
  const dmrp_vec2 from = toolkit::position(*(after - 1));
  if (after == path.end()) return from;
  const double share =
      static_cast<double>(t_ns - (after - 1)->t_ns) / static_cast<double>(after->t_ns - (after - 1)->t_ns);
  return from + share * (toolkit::position(*after) - from);
}

// Whether the path turns by more than 135 degrees at a waypoint, which is not the last.
bool turns_back(const std::vector<dmrp_waypoint>& path, std::size_t at) {
  constexpr double cosine = -0.70710678118654752;
  const dmrp_vec2 here = toolkit::position(path[at]);
  std::size_t before = at, after = at;
  while (before > 0 && toolkit::position(path[before]) == here) --before;
  while (after + 1 < path.size() && toolkit::position(path[after]) == here) ++after;
  const dmrp_vec2 in = here - toolkit::position(path[before]);
  const dmrp_vec2 out = toolkit::position(path[after]) - here;
  return toolkit::dot(in, out) < cosine * toolkit::norm(in) * toolkit::norm(out);
}

// The last waypoint at the path's last goal that the path leaves, to come back later; -1 if there is none.
std::int64_t last_early_visit(const std::vector<dmrp_waypoint>& path, std::span<const dmrp_goal> goals,
                              double reach_m) {
  const std::uint32_t goal_index = path.back().goal_index;
  const dmrp_vec2 goal = toolkit::position(goals[goal_index].pose);
  bool left = false;
  for (std::size_t i = path.size(); i-- > 0 && path[i].goal_index == goal_index;) {
    const bool there = toolkit::distance(toolkit::position(path[i]), goal) < reach_m;
    if (there && left) return static_cast<std::int64_t>(i);
    left = left || !there;
  }
  return -1;
}

}  // namespace

Dispatcher::Dispatcher(const VariantWorld& variant, const core::World& world)
    : variant_(variant),
      world_(world),
      courses_(world.robots().size()),
      progress_(world.robots().size(), core::PathProgress(variant.planning_grid.view().resolution_m)),
      places_(world.robots().size()) {}

void Dispatcher::set_plan(const Plan& plan) {
  const double cell_m = variant_.planning_grid.view().resolution_m;
  ++revision_;
  std::vector<dmrp_vec2> positions;
  for (std::uint32_t i = 0; i < courses_.size(); ++i) {
    const core::RobotState& robot = world_.robots()[i];
    positions.push_back(toolkit::position(robot.pose));
    Course& course = courses_[i];
    course = {};
    if (robot.state != DMRP_ROBOT_ACTIVE) continue;
    course.path = path_to_drive(plan.paths[i], plan.is_partial(i), world_.goals(i), plan.step_duration_ns);
    course.is_partial = plan.is_partial(i);
    course.released = static_cast<std::uint32_t>(course.path.size() - 1);
    course.early_visit = last_early_visit(course.path, world_.goals(i), 0.7 * cell_m);
    course.behind = waypoints_behind(i, course.path);
    for (std::uint32_t k = 1; k + 1 < course.path.size(); ++k)
      if (turns_back(course.path, k)) course.turns.push_back(k);
    course.is_new = true;
    progress_[i].set_path(course.path, positions[i]);
    if (ordered()) find_stages(course);
  }
  if (ordered()) dependencies_.set_plan(variant_.planning_grid.view(), plan.paths, positions);
  update_places();
}

// Numbers the cells along the course as the dependency graph does: a leg from a cell's centre to a goal in the same cell
// does not count.
void Dispatcher::find_stages(Course& course) const {
  const dmrp_grid view = variant_.planning_grid.view();
  const toolkit::GridView grid(view);
  course.stages.assign(1, 0);
  for (std::size_t i = 1; i < course.path.size(); ++i) {
    const bool moves =
        grid.cell_of(toolkit::position(course.path[i])) != grid.cell_of(toolkit::position(course.path[i - 1]));
    course.stages.push_back(course.stages.back() + (moves ? 1 : 0));
  }
}

void Dispatcher::update_progress() {
  for (std::uint32_t i = 0; i < progress_.size(); ++i) {
    const core::RobotState& robot = world_.robots()[i];
    progress_[i].update(toolkit::position(robot.pose), robot.goal_index);
  }
  update_places();
}

void Dispatcher::update_places() {
  const std::optional<std::uint32_t> late = in_lockstep() ? late_robot() : std::nullopt;
  for (std::uint32_t i = 0; i < courses_.size(); ++i) places_[i] = place_of(i, late);
}

// `late`: the robot for which the others wait in lockstep.
core::CoursePlace Dispatcher::place_of(std::uint32_t robot, std::optional<std::uint32_t> late) const {
  const Course& course = courses_[robot];
  if (course.path.empty()) return {};
  core::CoursePlace place;
  place.revision = revision_;
  place.path = course.path;
  place.arc_m = progress_[robot].progress_m();
  place.passed = progress_[robot].waypoint();
  place.returns = course.early_visit >= place.passed;
  if (ordered() && is_held(robot)) place.holder = dependencies_.holder(robot);
  if (late && is_at_target(robot)) place.holder = late;
  return place;
}

void Dispatcher::update_targets() {
  if (ordered()) release();
  for (std::uint32_t i = 0; i < courses_.size(); ++i) {
    if (!is_driving(i)) continue;
    cut(i);
    if (by_waypoint() && !in_lockstep()) advance(i);
  }
  if (in_lockstep()) advance_together();
}

bool Dispatcher::is_driving(std::uint32_t robot) const {
  return world_.robots()[robot].state == DMRP_ROBOT_ACTIVE && !courses_[robot].path.empty();
}

void Dispatcher::cut(std::uint32_t robot) {
  Course& course = courses_[robot];
  const std::uint32_t passed = progress_[robot].waypoint();
  const auto is_behind = [&](std::uint32_t turn) {
    return turn <= passed || (turn == course.cut && is_near(robot, course.path[turn]));
  };
  while (!course.turns.empty() && is_behind(course.turns.front())) course.turns.erase(course.turns.begin());
  std::uint32_t end = std::min({course.released, progress_[robot].before_return(), goal_waypoint(robot)});
  if (!course.turns.empty()) end = std::min(end, course.turns.front());
  if (end == course.cut) return;
  course.cut = end;
  if (!by_waypoint()) course.is_new = true;
}

void Dispatcher::release() {
  for (std::uint32_t i = 0; i < courses_.size(); ++i) {
    const Course& course = courses_[i];
    if (course.path.empty()) continue;
    if (world_.robots()[i].state == DMRP_ROBOT_FINISHED) {  // it leaves its last cell no more, however it came there
      dependencies_.reached(i, dependencies_.last_stage(i));
      continue;
    }
    const std::uint32_t passed = progress_[i].waypoint();
    const std::uint32_t next = std::min<std::uint32_t>(passed + 1, course.released);
    if (progress_[i].has_begun() || is_near(i, course.path[0])) dependencies_.reached(i, course.stages[passed]);
    if (progress_[i].has_begun() && is_near(i, course.path[next])) dependencies_.reached(i, course.stages[next]);
  }
  for (std::uint32_t i = 0; i < courses_.size(); ++i) {
    Course& course = courses_[i];
    if (course.path.empty()) continue;
    const auto beyond = std::upper_bound(course.stages.begin(), course.stages.end(), dependencies_.released(i));
    course.released = static_cast<std::uint32_t>(beyond - course.stages.begin()) - 1;
  }
}

void Dispatcher::advance(std::uint32_t robot) {
  Course& course = courses_[robot];
  while (course.target < course.cut && is_at_target(robot)) {
    ++course.target;
    course.is_new = true;
  }
}

bool Dispatcher::is_at_target(std::uint32_t robot) const {
  const Course& course = courses_[robot];
  return course.target < course.behind || is_near(robot, course.path[course.target]);
}

// The robot with the lowest number that is not at its waypoint; none if all are.
std::optional<std::uint32_t> Dispatcher::late_robot() const {
  for (std::uint32_t i = 0; i < courses_.size(); ++i)
    if (is_driving(i) && !is_at_target(i)) return i;
  return std::nullopt;
}

void Dispatcher::advance_together() {
  for (bool has_more = true; has_more && !late_robot();) {
    has_more = false;
    for (std::uint32_t i = 0; i < courses_.size(); ++i) {
      Course& course = courses_[i];
      if (!is_driving(i) || course.target >= course.cut) continue;
      ++course.target;
      course.is_new = has_more = true;
    }
  }
}

// How many waypoints at the beginning of a path the robot need not drive back to: it is in their cell, off its centre, and
// can drive straight on. A plan that is made on the way begins so.
std::uint32_t Dispatcher::waypoints_behind(std::uint32_t robot, const std::vector<dmrp_waypoint>& path) const {
  const dmrp_vec2 first = toolkit::position(path.front());
  const auto next =
      std::find_if(path.begin(), path.end(), [&](const dmrp_waypoint& w) { return toolkit::position(w) != first; });
  const dmrp_grid view = variant_.planning_grid.view();
  const toolkit::GridView grid(view);
  const dmrp_vec2 here = toolkit::position(world_.robots()[robot].pose);
  const bool goes_on =
      next != path.end() && grid.cell_of(here) == grid.cell_of(first) &&
      variant_.geometry->sweep_is_free(here, toolkit::position(*next), world_.robot_settings(robot).radius_m);
  return goes_on ? static_cast<std::uint32_t>(next - path.begin()) : 0;
}

bool Dispatcher::is_near(std::uint32_t robot, const dmrp_waypoint& waypoint) const {
  const core::RobotState& state = world_.robots()[robot];
  return toolkit::distance(toolkit::position(waypoint), toolkit::position(state.pose)) <
         world_.goals(robot)[state.goal_index].tolerance_m;
}

// The waypoint at which the way to the robot's current goal ends.
std::uint32_t Dispatcher::goal_waypoint(std::uint32_t robot) const {
  const auto& path = courses_[robot].path;
  const std::uint32_t current = world_.robots()[robot].goal_index;
  const auto beyond = std::partition_point(
      path.begin(), path.end(), [&](const dmrp_waypoint& waypoint) { return waypoint.goal_index <= current; });
  return beyond == path.begin() ? 0 : static_cast<std::uint32_t>(beyond - path.begin()) - 1;
}

// Whether the robot reaches its current goal at this waypoint.
bool Dispatcher::ends_at_goal(std::uint32_t robot, std::uint32_t waypoint) const {
  const Course& course = courses_[robot];
  return waypoint == goal_waypoint(robot) && !(course.is_partial && waypoint + 1 == course.path.size());
}

PathUpdate Dispatcher::take_new_path(std::uint32_t robot) {
  Course& course = courses_[robot];
  if (!std::exchange(course.is_new, false)) return {};
  if (by_waypoint()) return {{&course.path[course.target], 1}};
  PathUpdate handed = {{course.path.data(), course.cut + std::size_t{1}}};
  if (!ends_at_goal(robot, course.cut)) handed.flags = DMRP_PATH_PARTIAL;
  if (std::exchange(course.is_begun, true)) handed.update_flags = DMRP_PATH_CONTINUES;
  return handed;
}

Guidance Dispatcher::guidance(std::uint32_t robot) const {
  const Course& course = courses_[robot];
  const dmrp_goal& goal = world_.goals(robot)[world_.robots()[robot].goal_index];
  if (!by_waypoint()) return {goal, progress_[robot].progress_m(), progress_[robot].waypoint()};
  Guidance guidance = {goal, 0.0, 0};
  if (!ends_at_goal(robot, course.target)) {
    const dmrp_waypoint& waypoint = course.path[course.target];
    guidance.goal.pose = {waypoint.x, waypoint.y, waypoint.theta};
  }
  return guidance;
}

std::vector<PathPosition> Dispatcher::positions_on_paths(std::int64_t later_ns) const {
  std::vector<PathPosition> positions;
  for (std::uint32_t i = 0; i < courses_.size(); ++i) {
    const auto& path = courses_[i].path;
    const dmrp_vec2 position = toolkit::position(world_.robots()[i].pose);
    if (path.empty() || world_.robots()[i].state == DMRP_ROBOT_FAILED) {
      positions.push_back({position, position, 0});
      continue;
    }
    const std::size_t next =
        std::min<std::size_t>(progress_[i].has_begun() ? progress_[i].waypoint() + 1 : 0, path.size() - 1);
    positions.push_back({toolkit::position(path[next]),
                         later_ns == 0 ? position : position_at(path, time_on_path_ns(i) + later_ns), 0});
  }
  return positions;
}

// Whether the robot is at the last waypoint that the order releases, and waits for others.
bool Dispatcher::is_held(std::uint32_t robot) const {
  const Course& course = courses_[robot];
  if (course.path.empty() || course.released + 1 == course.path.size() || course.cut < course.released) return false;
  return progress_[robot].waypoint() >= course.released || is_near(robot, course.path[course.released]);
}

// The time at which the plan puts the robot at its current progress.
std::int64_t Dispatcher::time_on_path_ns(std::uint32_t robot) const {
  const auto& path = courses_[robot].path;
  const std::uint32_t passed = progress_[robot].waypoint();
  if (!progress_[robot].has_begun() || passed + 1 == path.size()) return path[passed].t_ns;
  const std::vector<double> arcs = toolkit::arc_lengths(path);
  const double share = (progress_[robot].progress_m() - arcs[passed]) / (arcs[passed + 1] - arcs[passed]);
  const auto leg_ns = static_cast<double>(path[passed + 1].t_ns - path[passed].t_ns);
  return path[passed].t_ns + std::llround(std::clamp(share, 0.0, 1.0) * leg_ns);
}

}  // namespace dmrp::host
