// SPDX-License-Identifier: MIT
#include "core/execution/referee.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::core {
namespace {

constexpr double look_ahead_m = 1.0;     // of the course: a body there blocks it
constexpr double blocked_gap_m = 0.1;    // from the strip that the body sweeps
constexpr double still_m = 0.05;         // a robot that moves no farther
constexpr double still_rad = 0.1;        // and turns no farther stands
constexpr double neighbourhood_m = 3.0;  // of standing robots: somebody who moves here may open their way

bool is_settling(const RobotState& robot) {
  return robot.settling_since_ns >= 0;
}

// The way begins at the robot's position and follows the next metre of its course.
std::vector<dmrp_vec2> way_ahead(dmrp_vec2 from, const CoursePlace& course) {
  std::vector<dmrp_vec2> way = {from};
  double left_m = look_ahead_m;
  for (std::size_t i = course.passed + 1; i < course.path.size() && left_m > 0.0; ++i) {
    const dmrp_vec2 to = toolkit::position(course.path[i]);
    const double length_m = toolkit::distance(way.back(), to);
    if (length_m == 0.0) continue;
    way.push_back(way.back() + std::min(1.0, left_m / length_m) * (to - way.back()));
    left_m -= length_m;
  }
  return way;
}

// The distance by the way to a point within reach_m of it; infinity if it is not within reach.
double distance_by(const std::vector<dmrp_vec2>& way, dmrp_vec2 point, double reach_m) {
  double arc_m = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const dmrp_vec2 to = way[std::min(i + 1, way.size() - 1)];
    if (toolkit::distance(dmrp_segment{way[i], to}, point) <= reach_m) return arc_m + toolkit::distance(way[i], point);
    arc_m += toolkit::distance(way[i], to);
  }
  return std::numeric_limits<double>::infinity();
}

// The length of the course's part that leads to this goal.
double leg_m(const CoursePlace& course, std::uint32_t goal_index) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < course.path.size(); ++i)
    if (course.path[i].goal_index == goal_index)
      length_m += toolkit::distance(toolkit::position(course.path[i - 1]), toolkit::position(course.path[i]));
  return length_m;
}

}  // namespace

Referee::Referee(World& world, const PlanningGrids& grids, Settings settings, std::uint64_t seed)
    : world_(world), grids_(grids), settings_(settings), robots_(world.robots().size()), gained_m_(robots_.size()) {
  toolkit::Stream random(seed, "referee");
  continues_ = random.uniform() < continued_share;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    robots_[i].pose = robots_[i].still_pose = world_.robots()[i].pose;
    if (!is_active(i)) continue;
    begin_goal(i);
    changes_.push_back({DMRP_ROBOT_EVENT_CLASS, i, world_.t_ns(), DMRP_CLASS_MOVING, DMRP_NOBODY});
  }
  judge_arrivals(std::vector<CoursePlace>(robots_.size()));
}

void Referee::begin_goal(std::uint32_t robot) {
  const RobotState& state = world_.robots()[robot];
  Watched& it = robots_[robot];
  const dmrp_grid grid = grids_.of(world_.robot_settings(robot).type).view();
  it.distances = distances_.to(grid, toolkit::position(world_.goals(robot)[state.goal_index].pose));
  it.nearest_m = it.distances->from(toolkit::position(state.pose));
  it.credit_m.reset();
  it.waits_since_ns = -1;
  restart_window(robot);
}

void Referee::restart_window(std::uint32_t robot) {
  Watched& it = robots_[robot];
  it.window.clear();
  it.window.push_back({world_.t_ns(), gained_m_[robot], it.travelled_m, it.turned_rad});
}

void Referee::judge_arrivals(std::span<const CoursePlace> courses) {
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    const RobotState& state = world_.robots()[i];
    Watched& it = robots_[i];
    if (!is_active(i)) continue;
    if (!is_settling(state)) {
      it.waits_since_ns = -1;
      continue;
    }
    const auto goals = world_.goals(i);
    if (world_.t_ns() - state.settling_since_ns < goals[state.goal_index].settle_ns) continue;
    const bool visits = it.waits_since_ns < 0;
    if (visits) ++it.visits;
    if (state.goal_index + 1 < goals.size()) {
      world_.visit(i);
      begin_goal(i);
    } else if (!courses[i].returns) {
      world_.park(i);
      it.distances.reset();
    } else if (visits) {
      it.waits_since_ns = world_.t_ns();
    }
  }
}

bool Referee::wants_plan() {
  bool wants = false;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    Watched& it = robots_[i];
    if (!is_active(i) || it.waits_since_ns < 0 || it.verdict.kind == DMRP_CLASS_HELD ||
        world_.t_ns() - it.waits_since_ns < progress_window_ns)
      continue;
    it.waits_since_ns = world_.t_ns();
    wants = true;
  }
  return wants;
}

void Referee::judge_progress(std::span<const CoursePlace> courses) {
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    if (!is_active(i)) continue;
    Watched& it = robots_[i];
    if (world_.t_ns() - it.command_ns >= controller_silence_ns) {
      it.failure = DMRP_FAILURE_CONTROLLER;
      world_.fail(i);
      continue;
    }
    gain(i, courses[i]);
    remember(i);
    const Verdict verdict = classify(i, courses[i]);
    const bool moves_freely =
        verdict.kind != DMRP_CLASS_SETTLING && verdict.kind != DMRP_CLASS_RECOVERING && verdict.kind != DMRP_CLASS_HELD;
    if (moves_freely && !it.was_moving_freely) restart_window(i);
    it.was_moving_freely = moves_freely;
    it.circled = it.circled || verdict.circles;
    if (verdict != it.verdict) {
      const std::uint32_t detail = verdict.kind | (verdict.circles ? DMRP_CLASS_CIRCLING : 0u);
      changes_.push_back({DMRP_ROBOT_EVENT_CLASS, i, world_.t_ns(), detail, verdict.other});
    }
    it.verdict = verdict;
  }
  watch_standstill(courses);
}

void Referee::gain(std::uint32_t robot, const CoursePlace& course) {
  Watched& it = robots_[robot];
  const double to_goal_m = it.distances->from(toolkit::position(world_.robots()[robot].pose));
  double approach_m = 0.0;
  if (to_goal_m < it.nearest_m) {
    if (std::isfinite(it.nearest_m)) approach_m = it.nearest_m - to_goal_m;
    it.nearest_m = to_goal_m;
  }
  if (!it.credit_m && !course.path.empty())
    it.credit_m = leg_m(course, world_.robots()[robot].goal_index) + detour_credit_m;
  const double advance_m = course.revision == it.course ? course.arc_m - it.arc_m : 0.0;
  it.course = course.revision;
  it.arc_m = course.arc_m;
  const double detour_m = std::clamp(advance_m - approach_m, 0.0, it.credit_m.value_or(0.0));
  if (it.credit_m) *it.credit_m -= detour_m;
  gained_m_[robot] += approach_m + detour_m;
  if (gained_m_[robot] - it.counted_m < least_progress_m) return;
  it.counted_m = gained_m_[robot];
  it.gained_ns = world_.t_ns();
}

// The oldest moment kept is the latest that is a whole window old.
void Referee::remember(std::uint32_t robot) {
  Watched& it = robots_[robot];
  const dmrp_pose pose = world_.robots()[robot].pose;
  it.travelled_m += toolkit::distance(toolkit::position(it.pose), toolkit::position(pose));
  it.turned_rad += std::abs(toolkit::difference(it.pose.theta, pose.theta));
  it.pose = pose;
  it.window.push_back({world_.t_ns(), gained_m_[robot], it.travelled_m, it.turned_rad});
  while (it.window.size() > 1 && it.window[1].t_ns <= world_.t_ns() - progress_window_ns) it.window.pop_front();
}

bool Referee::is_moving(std::uint32_t robot) const {
  const Moment& then = robots_[robot].window.front();
  return world_.t_ns() - then.t_ns < progress_window_ns || gained_m_[robot] - then.gained_m >= least_progress_m;
}

Referee::Verdict Referee::classify(std::uint32_t robot, const CoursePlace& course) const {
  const Watched& it = robots_[robot];
  if (is_settling(world_.robots()[robot])) return {DMRP_CLASS_SETTLING};
  if (it.recovering) return {DMRP_CLASS_RECOVERING};
  if (course.holder) return {DMRP_CLASS_HELD, *course.holder};
  if (is_moving(robot)) return {DMRP_CLASS_MOVING};
  Verdict verdict = blocked_by(robot, course);
  const Moment& then = it.window.front();
  verdict.circles =
      it.travelled_m - then.travelled_m > circling_travel_m || it.turned_rad - then.turned_rad > circling_turn_rad;
  return verdict;
}

// The first body on the next metre of the course blocks the robot.
Referee::Verdict Referee::blocked_by(std::uint32_t robot, const CoursePlace& course) const {
  const std::vector<dmrp_vec2> way = way_ahead(toolkit::position(world_.robots()[robot].pose), course);
  const double own_m = world_.robot_settings(robot).radius_m + blocked_gap_m;
  Verdict verdict = {DMRP_CLASS_STUCK};
  double first_m = std::numeric_limits<double>::infinity();
  for (const dmrp_agent& other : world_.robot_agents()) {
    if (other.id == robot) continue;
    const double at_m = distance_by(way, toolkit::position(other.pose), own_m + other.radius_m);
    if (at_m >= first_m) continue;
    first_m = at_m;
    verdict = {DMRP_CLASS_BLOCKED_ROBOT, static_cast<std::uint32_t>(other.id)};
  }
  for (const dmrp_agent& person : world_.person_agents()) {
    const double at_m = distance_by(way, toolkit::position(person.pose), own_m + person.radius_m);
    if (at_m >= first_m) continue;
    first_m = at_m;
    verdict = {DMRP_CLASS_BLOCKED_PERSON};
  }
  return verdict;
}

std::uint32_t Referee::root_of(std::uint32_t robot) const {
  std::uint32_t root = robot;
  for (std::size_t i = 0; i < robots_.size() && is_active(root) && robots_[root].verdict.kind == DMRP_CLASS_HELD; ++i)
    root = robots_[root].verdict.other;
  return root;
}

void Referee::watch_standstill(std::span<const CoursePlace> courses) {
  bool still = !people_stir();
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    Watched& it = robots_[i];
    if (!is_active(i)) continue;
    const dmrp_pose pose = world_.robots()[i].pose;
    const bool stands = toolkit::distance(toolkit::position(it.still_pose), toolkit::position(pose)) <= still_m &&
                        std::abs(toolkit::difference(it.still_pose.theta, pose.theta)) <= still_rad;
    if (!stands) it.still_pose = pose;
    still = still && stands && !it.recovering && !courses[i].path.empty();
  }
  if (!still || settings_.replans) still_since_ns_ = world_.t_ns();
  if (!continues_ || runs_on_ || world_.t_ns() - still_since_ns_ < fixed_point_ns) return;
  runs_on_ = true;
  for (std::uint32_t i = 0; i < robots_.size(); ++i)
    if (is_active(i)) changes_.push_back({DMRP_ROBOT_EVENT_RUNS_ON, i, world_.t_ns(), 0, DMRP_NOBODY});
}

// Whether somebody near an active robot has moved by least_progress_m since they last did, or will go on as recorded.
bool Referee::people_stir() {
  bool stir = false;
  const auto people = world_.person_agents();
  for (std::size_t place = 0; place < people.size(); ++place) {
    const dmrp_vec2 here = toolkit::position(people[place].pose);
    const auto [known, is_new] = people_.try_emplace(people[place].id, here);
    const bool stands = !is_new && toolkit::distance(known->second, here) < least_progress_m;
    if (stands && !world_.is_recorded(place)) continue;
    known->second = here;
    for (std::uint32_t i = 0; i < robots_.size() && !stir; ++i)
      stir = is_active(i) && toolkit::distance(toolkit::position(world_.robots()[i].pose), here) < neighbourhood_m;
  }
  return stir;
}

bool Referee::all_held_behind_failed() const {
  if (settings_.replans) return false;
  bool any = false;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    if (!is_active(i)) continue;
    any = true;
    if (robots_[i].verdict.kind != DMRP_CLASS_HELD) return false;
    if (world_.robots()[root_of(i)].state != DMRP_ROBOT_FAILED) return false;
  }
  return any;
}

std::uint32_t Referee::ending() const {
  const std::int64_t t_ns = world_.t_ns();
  const bool late = t_ns >= world_.settings().time_limit_ns;
  if (robots_.empty()) return world_.is_deserted() ? DMRP_ENDING_DESERTED : late ? DMRP_ENDING_TIME_LIMIT : 0;
  bool all_parked = true;
  bool none_active = true;
  for (const RobotState& robot : world_.robots()) {
    all_parked = all_parked && robot.state == DMRP_ROBOT_FINISHED;
    none_active = none_active && robot.state != DMRP_ROBOT_ACTIVE;
  }
  if (all_parked) return DMRP_ENDING_ARRIVED;
  if (none_active) return DMRP_ENDING_OVER;
  if (late) return DMRP_ENDING_TIME_LIMIT;
  const bool fixed = t_ns - still_since_ns_ >= fixed_point_ns && !continues_;
  return fixed || all_held_behind_failed() ? DMRP_ENDING_DEADLOCK : 0;
}

std::vector<dmrp_robot_end> Referee::robot_ends(std::uint32_t ending) const {
  const auto failure_of = [&](std::uint32_t robot) -> std::uint32_t {
    const Watched& it = robots_[robot];
    if (it.failure != DMRP_FAILURE_NONE) return it.failure;
    if (world_.robots()[robot].state == DMRP_ROBOT_FINISHED)
      return settings_.oscillation_fails && it.circled ? DMRP_FAILURE_OSCILLATION : DMRP_FAILURE_NONE;
    if (ending == DMRP_ENDING_NO_PLAN) return DMRP_FAILURE_NO_PLAN;
    if (it.verdict.circles) return DMRP_FAILURE_CIRCLING;
    switch (it.verdict.kind) {
      case DMRP_CLASS_HELD:
        return DMRP_FAILURE_HELD_BEHIND;
      case DMRP_CLASS_BLOCKED_PERSON:
        return DMRP_FAILURE_BLOCKED_PERSON;
      case DMRP_CLASS_BLOCKED_ROBOT:
        return DMRP_FAILURE_BLOCKED_ROBOT;
      case DMRP_CLASS_STUCK:
        return DMRP_FAILURE_STUCK;
      default:
        return DMRP_FAILURE_TIMEOUT;
    }
  };
  std::vector<dmrp_robot_end> ends;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    const std::uint32_t failure = failure_of(i);
    const std::uint32_t culprit = failure == DMRP_FAILURE_HELD_BEHIND     ? root_of(i)
                                  : failure == DMRP_FAILURE_BLOCKED_ROBOT ? robots_[i].verdict.other
                                                                          : DMRP_NOBODY;
    ends.push_back({world_.robots()[i].state, failure, world_.robots()[i].arrival_ns, robots_[i].visits, culprit});
  }
  return ends;
}

}  // namespace dmrp::core
