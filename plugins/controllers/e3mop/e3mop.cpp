// SPDX-License-Identifier: MIT
#include "e3mop.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <limits>

#include "../motion/unicycle.hpp"
#include "velocity_profile.hpp"

namespace dmrp::controllers {

using namespace e3mop;

namespace {

constexpr double window_margin_m = 0.15;

// Turning in place begins when the path leaves further aside than the first, and ends below the second.
constexpr double turn_begin_rad = 0.7;
constexpr double turn_end_rad = 0.15;

// The path's direction at its start is looked for this far ahead.
constexpr double lead_m = 0.25;

// So near to where the way is cut off, the robot waits.
constexpr double wait_within_m = 0.2;

// The tracker's feedback.
constexpr double heading_gain = 2.0;
constexpr double cross_gain = 3.0;
constexpr double curvature_reach_m = 0.3;

constexpr double sample_step_m = 0.05;

}  // namespace

Descriptor E3mop::describe() {
  return Descriptor("dmrp.controller.e3mop", "E3MoP", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("searches a lattice of unicycle motions, smooths the path by optimisation and drives it time-optimally")
      .source(
          "Wen, Zhang, Gao, Yuan, Fang: E3MoP: Efficient motion planning based on heuristic-guided motion primitives "
          "pruning and path optimization with sparse-banded structure, IEEE T-ASE 19 (2022)")
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_DISTANCE_FIELD)
      .uses(DMRP_EXT_ANNOTATE);
}

Status E3mop::start(const World&, std::uint64_t) {
  costmap_ = extension<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  distance_field_ = extension<dmrp_distance_field>(DMRP_EXT_DISTANCE_FIELD);
  if (!costmap_ || !distance_field_) {
    set_error(costmap_ ? "the host has no " DMRP_EXT_DISTANCE_FIELD : "the host has no " DMRP_EXT_LOCAL_COSTMAP);
    return Status::error;
  }
  annotate_ = extension<dmrp_annotate>(DMRP_EXT_ANNOTATE);
  tracker_.clear();
  at_goal_.reset();
  limits_ = {};
  turning_ = false;
  return Status::ok;
}

void E3mop::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
}

Status E3mop::step(const Observation& now, Command& command) {
  command = braking(now);
  tracker_.update(now);
  if (tracker_.empty()) return Status::ok;
  if (at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  if (limits_.v_max != now.limits.v_max || limits_.omega_max != now.limits.omega_max) {
    limits_ = now.limits;
    plan_.prepare(limits_, lattice_resolution);
  }
  read_field(now);
  const CostmapView map(*costmap_->costmap(costmap_));
  const FootprintCheck outline(map, now.footprint, footprint_padding, now.pose);
  const FreeSpace foreseen(foreseen_, now.footprint, footprint_padding, now.pose, &outline);
  ahead_.look(tracker_, now, map, max_global_plan_lookahead_dist, window_margin_m);
  lay_out_global_path();
  plan_.look(now.pose, foreseen_, foreseen, now.footprint.inscribed_radius_m);
  if (!plan_.choose_goal(global_path_)) return Status::ok;
  const double to_goal_m = toolkit::distance(toolkit::position(now.pose), plan_.goal());
  if (plan_.is_cut() && to_goal_m < wait_within_m) return Status::ok;

  SearchSettings settings;
  settings.v_max = now.limits.v_max;
  settings.omega_max = now.limits.omega_max;
  settings.pruning = pruning;
  settings.first_turn_s = std::abs(now.velocity.v_x) / now.limits.a_max;
  plan_.search(now.pose, settings);
  lay_points(now);
  if (raw_points_.size() < 2) return Status::ok;

  // the direction in which the path leaves
  const Vec2 lead =
      raw_points_[std::min(raw_points_.size() - 1, static_cast<std::size_t>(std::ceil(lead_m / point_spacing)))];
  const double aside = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, lead));
  turning_ = std::abs(aside) > (turning_ ? turn_end_rad : turn_begin_rad);
  if (turning_) {
    command.omega = turning_rate(aside, now);
    return Status::ok;
  }
  const FreeSpace seen(field_, now.footprint, footprint_padding, now.pose, &outline);
  if (!shape_path(now, foreseen)) return Status::ok;
  command = safe(now, follow(now), seen);
  annotate();
  return Status::ok;
}

void E3mop::read_field(const Observation& now) {
  const dmrp_field& field = *distance_field_->field(distance_field_);
  field_.read(field);
  foreseen_.read(field);
  for (const Agent& agent : now.agents) {
    if (agent.state != DMRP_ROBOT_ACTIVE && agent.kind == DMRP_AGENT_ROBOT) continue;
    const Vec2 from = toolkit::position(agent.pose);
    foreseen_.add_swept_disc(from, from + prediction_time * agent.velocity, agent.radius_m);
  }
}

// As far as the path does not turn back on itself: the tip of an excursion is to be reached before the way back counts.
void E3mop::lay_out_global_path() {
  global_path_.clear();
  const std::vector<Vec2>& points = ahead_.points();
  constexpr double tip_reached_m = 0.25;
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

// The lattice path, equally spaced, from the robot's place on; its end is the goal itself where it was reached.
void E3mop::lay_points(const Observation& now) {
  raw_points_.clear();
  const std::vector<Pose>& poses = plan_.found().poses;
  Vec2 last = toolkit::position(now.pose);
  raw_points_.push_back(last);
  double length_m = 0.0;
  const auto walk = [&](Vec2 to) {
    double left_m = toolkit::distance(last, to);
    while (left_m >= point_spacing && length_m < smoothing_length) {
      last = toolkit::lerp(last, to, point_spacing / left_m);
      left_m -= point_spacing;
      length_m += point_spacing;
      raw_points_.push_back(last);
    }
  };
  for (const Pose& pose : poses) walk(toolkit::position(pose));
  if (!plan_.found().found || length_m >= smoothing_length) return;
  walk(plan_.goal());
  if (raw_points_.size() > 1 && toolkit::distance(raw_points_.back(), plan_.goal()) < 0.5 * point_spacing)
    raw_points_.back() = plan_.goal();
  else if (toolkit::distance(raw_points_.back(), plan_.goal()) > 1e-3)
    raw_points_.push_back(plan_.goal());
}

bool E3mop::shape_path(const Observation& now, const FreeSpace& free_space) {
  points_ = raw_points_;
  SmoothingSettings settings;
  settings.weight_smoothness = weight_smoothness;
  settings.weight_obstacle = weight_obstacle;
  settings.safe_distance_m = safe_distance;
  settings.iterations = static_cast<int>(max_iterations);
  settings.needed_m = free_space.needed_m();
  // the path leaves along the robot's heading
  std::size_t fixed = 1;
  if (points_.size() > 3) {
    points_[1] = points_[0] + point_spacing * toolkit::from_angle(now.pose.theta);
    fixed = 2;
  }
  smoother_.smooth(points_, fixed, foreseen_, settings);
  if (fit(now, free_space)) return true;
  points_ = raw_points_;
  return fit(now, free_space);
}

// The spline and its speeds. False where it collides at once; where it collides later, it ends before.
bool E3mop::fit(const Observation& now, const FreeSpace& free_space) {
  spline_.fit(points_, now.pose.theta, sample_step_m, path_);
  const double braking_m = now.velocity.v_x * now.velocity.v_x / (2.0 * now.limits.a_max) + 0.3;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const PathPoint& point = path_[i];
    if (free_space.is_free(arc_state({point.at.x, point.at.y, point.theta}))) continue;
    if (point.arc_m < braking_m) return false;
    path_.resize(i);
    break;
  }
  if (path_.size() < 2) return false;
  plan_speeds(path_, now.velocity.v_x, 0.0, now.limits);
  return true;
}

// Feed-forward of the path's speed and curvature, feedback of the errors at the place where the robot will be when the
// command acts.
Command E3mop::follow(const Observation& now) const {
  const double period_s = seconds(now.dt_ns);
  ArcState at = arc_state(now.pose);
  ArcStepper(now.velocity.v_x, now.velocity.omega, period_s).step(at);
  std::size_t nearest = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const double distance_m = toolkit::distance({at.x, at.y}, path_[i].at);
    if (distance_m < nearest_m) {
      nearest = i;
      nearest_m = distance_m;
    }
  }
  const PathPoint& reference = path_[nearest];
  const double cross_m = toolkit::cross(toolkit::from_angle(reference.theta), Vec2{at.x, at.y} - reference.at);
  const double aside = toolkit::difference(reference.theta, std::atan2(at.sin_theta, at.cos_theta));
  std::size_t beyond = nearest;
  while (beyond + 1 < path_.size() && path_[beyond].arc_m < reference.arc_m + curvature_reach_m) ++beyond;
  const double span_m = path_[beyond].arc_m - reference.arc_m;
  const double curvature =
      span_m > 0.0 ? toolkit::difference(reference.theta, path_[beyond].theta) / span_m : reference.curvature;

  Command command;
  const double speed = std::clamp(speed_after(path_, period_s), 0.0, now.limits.v_max);
  command.v_x = std::clamp(toward(now.velocity.v_x, speed, now.limits.a_max * period_s), 0.0, now.limits.v_max);
  const double omega = command.v_x * curvature - heading_gain * aside - cross_gain * command.v_x * cross_m;
  command.omega = std::clamp(toward(now.velocity.omega, omega, now.limits.alpha_max * period_s), -now.limits.omega_max,
                             now.limits.omega_max);
  return command;
}

// The command, slower where its arc would run into something before the robot could stop.
Command E3mop::safe(const Observation& now, Command command, const FreeSpace& free_space) const {
  const double period_s = seconds(now.dt_ns);
  const double braking_s = command.v_x / now.limits.a_max + period_s;
  const int steps = 1 + static_cast<int>(command.v_x * braking_s / sample_step_m);
  ArcState at = arc_state(now.pose);
  // braking from v takes as long as the half of it at v
  const ArcStepper stepper(command.v_x, command.omega, 0.5 * (braking_s + period_s) / steps);
  for (int i = 0; i < steps; ++i) {
    stepper.step(at);
    if (free_space.is_free(at)) continue;
    Command slower = braking(now);
    slower.omega = command.omega;
    return slower;
  }
  return command;
}

void E3mop::annotate() const {
  if (!annotate_ || !annotate_->wanted(annotate_)) return;
}

}  // namespace dmrp::controllers
