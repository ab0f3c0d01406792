// SPDX-License-Identifier: MIT
#include "controllers/e3mop/e3mop.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "controllers/e3mop/guarded_motion.hpp"
#include "controllers/e3mop/lay_by.hpp"
#include "controllers/e3mop/path_follower.hpp"
#include "controllers/e3mop/velocity_profile.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

using namespace e3mop;

namespace {

// The outermost part of the costmap's window that is not planned in.
constexpr double window_margin_m = 0.15;

// A turn in place begins if the path starts at a larger angle than the first, and ends below the second.
constexpr double turn_begin_rad = 0.7;
constexpr double turn_end_rad = 0.15;

// The path's direction at its start is that to the point at this distance.
constexpr double lead_m = 0.25;

// The robot waits within this distance of the point where its way is cut off.
constexpr double wait_within_m = 0.2;

// Where it lets somebody pass, it comes as close as this to the place beside its path.
constexpr double lay_by_reached_m = 0.02;

// The last cycle's path is kept for this time and at least this distance ahead of the robot, so that its next motion
// does not change in every cycle.
constexpr double kept_s = 0.3;
constexpr double kept_m = 0.2;

// A robot with a larger tracking error starts a new path.
constexpr double lost_m = 0.12;
constexpr double lost_rad = 0.6;

// At a turning point of the path, the robot has to come this close before the way back counts.
constexpr double tip_reached_m = 0.25;

}  // namespace

Descriptor E3mop::describe() {
  return describe_controller("dmrp.controller.e3mop", "E3MoP")
      .summary("searches a lattice of unicycle motions, smooths the path by optimisation and drives it time-optimally")
      .source(
          "Wen, Zhang, Gao, Yuan, Fang: E3MoP: Efficient motion planning based on heuristic-guided motion primitives "
          "pruning and path optimization with sparse-banded structure, IEEE T-ASE 19 (2022)")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_DISTANCE_FIELD)
      .uses(DMRP_EXT_ANNOTATE);
}

Status E3mop::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  distance_field_ = &extension<dmrp_distance_field>();
  begin(start);
  limits_ = {};
  turning_ = false;
  way_out_.reset();
  path_.clear();
  return Status::ok;
}

Status E3mop::control(const Observation& now, Command& command) {
  if (at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  if (limits_.v_max != now.limits.v_max || limits_.omega_max != now.limits.omega_max) prepare(now);
  command = drive(now);
  // it cannot come closer
  const bool stands = std::max(command.v_x, now.velocity.v_x) < stopped_m_s;
  if (stands && at_goal_.settles(tracker_.stop(), now)) command = at_goal_.command(tracker_.stop(), now);
  return Status::ok;
}

// Builds the lattice for the robot's limits and lets all buffers grow to the size of the longest path, so that later
// cycles do not allocate.
void E3mop::prepare(const Observation& now) {
  limits_ = now.limits;
  read_fields(now);
  local_plan_.prepare(limits_, lattice_resolution, foreseen_);
  global_path_.reserve(static_cast<std::size_t>(max_global_plan_lookahead_dist / PathAhead::spacing_m) + 3);
  // a zigzag path, so that the smoothing iterates
  const double longest_m = smoothing_length + std::max(kept_m, kept_s * now.limits.v_max) + 3.0 * point_spacing;
  const auto count = static_cast<std::size_t>(longest_m / point_spacing) + 2;
  rough_ = {};
  for (std::size_t i = 0; i < count; ++i)
    rough_.points.push_back(toolkit::position(now.pose) +
                            point_spacing * Vec2{static_cast<double>(i), i % 2 ? 0.7 : 0.0});
  shape_path(now, FreeSpace(foreseen_, now.footprint, footprint_padding, now.pose));
  path_.reserve(2 * path_.size());
  path_.clear();
  intended_.reserve(64);
}

// The paper's steps, one after the other: the obstacles and the path ahead, a search on the lattice, smoothing and the
// velocity profile, and the tracking controller. The robot turns in place where the path leads aside or back.
Command E3mop::drive(const Observation& now) {
  const CostmapView map(*costmap_->costmap(costmap_, now.robot));
  const FootprintCheck outline(map, now.footprint, footprint_padding, now.pose);
  const bool has_agents = read_fields(now);
  const FreeSpace seen(field_, now.footprint, footprint_padding, now.pose, &outline);
  if (way_out_.is_taken()) return way_out_.drive(now, seen);
  lay_out_global_path(now, map);

  const std::optional<Plan> plan = choose_plan(now, outline, has_agents);
  if (!plan) {
    path_.clear();
    return braking(now);
  }

  // a robot that may turn in place sees where the shaped path leads before it gives up the kept one
  const bool may_turn = rough_.kept == 1 && now.velocity.v_x < slow_m_s;
  bool is_shaped = may_turn && shape_path(now, plan->free_space);
  const Vec2 lead = lead_point(is_shaped);
  const double aside = toolkit::difference(plan->from.theta, toolkit::bearing(plan->from, lead));
  turning_ = std::abs(aside) > (turning_ ? turn_end_rad : turn_begin_rad);
  if (turning_) {
    path_.clear();
    return guarded_turn(now, toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, lead)), seen);
  }
  is_shaped = is_shaped || shape_path(now, plan->free_space);

  const Command command = is_shaped ? guarded(now, follow(path_, now), seen) : braking(now);
  if (is_shaped) annotate(plan->found->poses);
  const bool leaves = leave_padding && way_out_.take(now, command, toolkit::bearing(now.pose, lead), seen);
  if (!is_shaped || leaves) path_.clear();
  return command;
}

// Plans among the agents' predicted motion; among their current positions, if that blocks every path; and to where the
// robot lets somebody pass who leaves it no way.
std::optional<E3mop::Plan> E3mop::choose_plan(const Observation& now, const FootprintCheck& outline, bool has_agents) {
  const auto free_space = [&] { return FreeSpace(foreseen_, now.footprint, footprint_padding, now.pose, &outline); };
  std::optional<Plan> chosen = plan(now, free_space());
  if (!(chosen && chosen->found->found) && has_agents) {
    foreseen_ = field_;
    chosen = plan(now, free_space());
  }
  const bool is_open = chosen && chosen->found->found && !chosen->goal.is_cut;
  if (is_open || !keep_right) return chosen;
  const std::optional<Vec2> place = lay_by(now, global_path_, prediction_time, free_space());
  if (!place || !local_plan_.can_reach(*place)) return chosen;
  if (toolkit::distance(toolkit::position(now.pose), *place) < lay_by_reached_m) return {};
  return plan_to({*place, true, false}, keep_path(now, free_space()), now, free_space());
}

// Whether there are agents whose motion is foreseen.
bool E3mop::read_fields(const Observation& now) {
  const dmrp_field& field = *distance_field_->field(distance_field_, now.robot);
  field_.read(field);
  foreseen_.read(field);
  bool has_agents = false;
  for (const Agent& agent : now.agents) {
    if (agent.state != DMRP_ROBOT_ACTIVE && agent.kind == DMRP_AGENT_ROBOT) continue;
    const Vec2 from = toolkit::position(agent.pose);
    foreseen_.add_swept_disc(from, from + prediction_time * agent.velocity, agent.radius_m);
    has_agents = true;
  }
  return has_agents;
}

// The path ahead up to a turning point: the robot has to reach the tip of an excursion before the way back counts.
void E3mop::lay_out_global_path(const Observation& now, const CostmapView& map) {
  ahead_.look(tracker_, now, map, max_global_plan_lookahead_dist, window_margin_m);
  global_path_.clear();
  const std::vector<Vec2>& points = ahead_.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i >= 2) {
      const Vec2 before = points[i - 1] - points[i - 2];
      const Vec2 after = points[i] - points[i - 1];
      const bool turns_back = toolkit::dot(before, after) < -0.3 * toolkit::norm(before) * toolkit::norm(after);
      if (turns_back && (i - 1) * PathAhead::spacing_m > tip_reached_m) break;
    }
    global_path_.push_back(points[i]);
  }
}

// Begins rough_ with the part of the last path that the robot is about to drive, or with the robot's position if there
// is none. Returns the pose at its end.
Pose E3mop::keep_path(const Observation& now, const FreeSpace& free_space) {
  std::vector<Vec2>& points = rough_.points;
  points.assign(1, toolkit::position(now.pose));
  rough_.kept = 1;
  rough_.start_theta = now.pose.theta;
  if (path_.empty()) return now.pose;
  const TrackingError error = tracking_error(path_, now.pose);
  if (std::abs(error.cross_m) > lost_m || std::abs(error.heading_rad) > lost_rad) return now.pose;
  const double reach_m = std::max(kept_m, kept_s * now.velocity.v_x);
  const double first_m = path_[error.index].arc_m;
  std::size_t last = error.index;
  for (std::size_t i = error.index + 1; i < path_.size() && path_[i].arc_m < first_m + reach_m + 1e-6; ++i) {
    const PathPoint& point = path_[i];
    if (!free_space.is_free(directed(point.at, point.theta))) break;
    if (point.arc_m - path_[last].arc_m < point_spacing - 1e-6) continue;
    points.push_back(point.at);
    last = i;
  }
  if (points.size() == 1) return now.pose;
  points[0] = path_[error.index].at;
  rough_.kept = points.size();
  rough_.start_theta = path_[error.index].theta;
  return {path_[last].at.x, path_[last].at.y, path_[last].theta};
}

// Sets rough_ to the part of the last path that stays and the lattice path from there. Nothing if the robot has to wait.
std::optional<E3mop::Plan> E3mop::plan(const Observation& now, const FreeSpace& free_space) {
  const Pose from = keep_path(now, free_space);
  const std::optional<LatticeGoal> goal = local_plan_.choose_goal(toolkit::position(from), foreseen_, free_space,
                                                                  now.footprint.inscribed_radius_m, global_path_);
  if (!goal) return {};
  if (goal->is_cut && toolkit::distance(toolkit::position(now.pose), goal->at) < wait_within_m) return {};
  return plan_to(*goal, from, now, free_space);
}

std::optional<E3mop::Plan> E3mop::plan_to(const LatticeGoal& goal, const Pose& from, const Observation& now,
                                          const FreeSpace& free_space) {
  SearchSettings settings;
  settings.v_max = now.limits.v_max;
  settings.omega_max = now.limits.omega_max;
  settings.pruning = pruning;
  settings.first_turn_s = std::abs(now.velocity.v_x) / now.limits.a_max;
  const Plan plan = {goal, &local_plan_.search(from, free_space, settings), from, free_space};
  append_points(plan);
  if (rough_.points.size() <= 1) return {};
  return plan;
}

// Samples the lattice path at equal distances; ends at the goal itself if the search reached it.
void E3mop::append_points(const Plan& plan) {
  std::vector<Vec2>& points = rough_.points;
  Vec2 last = points.back();
  double length_m = 0.0;
  const auto walk = [&](Vec2 to) {
    double left_m = toolkit::distance(last, to);
    while (left_m >= point_spacing && length_m < smoothing_length) {
      last = toolkit::lerp(last, to, point_spacing / left_m);
      left_m -= point_spacing;
      length_m += point_spacing;
      points.push_back(last);
    }
  };
  for (const Pose& pose : plan.found->poses) walk(toolkit::position(pose));
  rough_.path_end.reset();
  if (!plan.found->found) return;
  if (plan.goal.is_path_end) rough_.path_end = plan.goal.at;
  if (length_m >= smoothing_length) return;
  walk(plan.goal.at);
  if (points.size() > 1 && toolkit::distance(points.back(), plan.goal.at) < 0.5 * point_spacing)
    points.back() = plan.goal.at;
  else if (toolkit::distance(points.back(), plan.goal.at) > 1e-3)
    points.push_back(plan.goal.at);
}

bool E3mop::shape_path(const Observation& now, const FreeSpace& free_space) {
  ShapeSettings settings;
  settings.smoothing.weight_smoothness = weight_smoothness;
  settings.smoothing.weight_obstacle = weight_obstacle;
  settings.smoothing.safe_distance_m = safe_distance;
  settings.smoothing.iterations = max_iterations;
  settings.point_spacing_m = point_spacing;
  return shaper_.shape(rough_, now, foreseen_, free_space, settings, path_);
}

// The point that gives the path's direction at its start: of the shaped path, otherwise of the rough one.
Vec2 E3mop::lead_point(bool is_shaped) const {
  if (!is_shaped) {
    const auto steps = static_cast<std::size_t>(std::ceil(lead_m / point_spacing));
    return rough_.points[std::min(rough_.points.size(), rough_.kept + steps) - 1];
  }
  const auto beyond =
      std::find_if(path_.begin(), path_.end(), [](const PathPoint& point) { return point.arc_m >= lead_m; });
  return beyond == path_.end() ? path_.back().at : beyond->at;
}

// The lattice path as the candidate, the velocity profile as the prediction.
void E3mop::annotate(const std::vector<Pose>& lattice_path) {
  if (!annotations_.wanted()) return;
  constexpr double step_s = 0.1;
  constexpr int steps = 30;
  if (lattice_path.size() > 1) annotations_.trajectory(DMRP_ANNOTATE_CANDIDATE, lattice_path, step_s);
  intended_.clear();
  std::size_t i = 0;
  for (int k = 0; k <= steps; ++k) {
    while (i + 2 < path_.size() && path_[i + 1].time_s < k * step_s) ++i;
    const double span_s = path_[i + 1].time_s - path_[i].time_s;
    const double share = std::isfinite(span_s) ? std::clamp((k * step_s - path_[i].time_s) / span_s, 0.0, 1.0) : 0.0;
    const Vec2 at = toolkit::lerp(path_[i].at, path_[i + 1].at, share);
    intended_.push_back({at.x, at.y, path_[i].theta});
  }
  annotations_.trajectory(DMRP_ANNOTATE_PREDICTED, intended_, step_s);
}

}  // namespace dmrp::controllers
