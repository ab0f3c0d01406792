// SPDX-License-Identifier: MIT
#include "controllers/e3mop/e3mop.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <limits>

#include "controllers/e3mop/path_follower.hpp"
#include "controllers/e3mop/velocity_profile.hpp"
#include "controllers/motion/unicycle.hpp"

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

// The path of the cycle before is kept for so long and at least so far ahead of the robot: what the robot is about to
// do does not change with every cycle.
constexpr double kept_s = 0.3;
constexpr double kept_m = 0.2;

// A robot farther off its path than this starts a new one.
constexpr double lost_m = 0.12;
constexpr double lost_rad = 0.6;

// A robot slower than this may leave in another direction than it heads for.
constexpr double slow_m_s = 0.1;

constexpr double sample_step_m = 0.05;

// So near to the goal the path is straight.
constexpr double last_leg_m = 0.5;

// A smoothed path that collides no farther ahead than this and what braking takes is no use.
constexpr double least_way_m = 0.3;

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
  path_.clear();
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
    read_field(now);
    plan_.prepare(limits_, lattice_resolution, foreseen_);
    warm_up(now);
  }
  read_field(now);
  const CostmapView map(*costmap_->costmap(costmap_));
  const FootprintCheck outline(map, now.footprint, footprint_padding, now.pose);
  FreeSpace foreseen(foreseen_, now.footprint, footprint_padding, now.pose, &outline);
  const FreeSpace seen(field_, now.footprint, footprint_padding, now.pose, &outline);
  ahead_.look(tracker_, now, map, max_global_plan_lookahead_dist, window_margin_m);
  lay_out_global_path();
  const Pose from = keep_path(now, foreseen);
  bool planned = plan(now, from, foreseen);
  if (!(planned && plan_.found().found) && foresees_) {
    // between people who step to and fro, what they may do leaves no way: where they are now counts
    foreseen_ = field_;
    foreseen = FreeSpace(foreseen_, now.footprint, footprint_padding, now.pose, &outline);
    raw_points_.resize(kept_);
    planned = plan(now, from, foreseen);
  }
  if (!planned) {
    path_.clear();
    return Status::ok;
  }

  // what leads aside or back is turned to in place; the path in hand is given up for that
  const bool free_to_turn = kept_ == 1 && now.velocity.v_x < slow_m_s;
  bool shaped = free_to_turn && shape_path(now, foreseen);
  const Vec2 lead = shaped ? lead_of_path() : raw_points_[std::min(raw_points_.size(), kept_ + lead_steps()) - 1];
  const double aside = toolkit::difference(from.theta, toolkit::bearing(from, lead));
  if (std::abs(aside) > (turning_ ? turn_end_rad : turn_begin_rad)) {
    turning_ = true;
    path_.clear();
    command = turn(now, toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, lead)), seen);
    return Status::ok;
  }
  turning_ = false;
  if (!shaped && !shape_path(now, foreseen)) {
    path_.clear();
    return Status::ok;
  }
  command = safe(now, follow(path_, now), seen);
  annotate();
  return Status::ok;
}

// Lets all buffers grow to what the longest path can need: later cycles allocate nothing.
void E3mop::warm_up(const Observation& now) {
  const FreeSpace anywhere(foreseen_, now.footprint, footprint_padding, now.pose);
  const double longest_m = smoothing_length + std::max(kept_m, kept_s * now.limits.v_max) + 3.0 * point_spacing;
  const auto count = static_cast<std::size_t>(longest_m / point_spacing) + 2;
  global_path_.reserve(static_cast<std::size_t>(max_global_plan_lookahead_dist / PathAhead::spacing_m) + 3);
  // wavering, so that it takes steps and samples
  raw_points_.clear();
  for (std::size_t i = 0; i < count; ++i)
    raw_points_.push_back(toolkit::position(now.pose) +
                          point_spacing * Vec2{static_cast<double>(i), i % 2 ? 0.7 : 0.0});
  kept_ = 1;
  shape_path(now, anywhere);
  path_.reserve(2 * path_.size());
  path_.clear();
  intended_.reserve(64);
}

std::size_t E3mop::lead_steps() const {
  return static_cast<std::size_t>(std::ceil(lead_m / point_spacing));
}

Vec2 E3mop::lead_of_path() const {
  const auto beyond =
      std::find_if(path_.begin(), path_.end(), [](const PathPoint& point) { return point.arc_m >= lead_m; });
  return beyond == path_.end() ? path_.back().at : beyond->at;
}

// The part of the last path that the robot is about to drive goes into raw_points_; returns where it ends, which is the
// robot's own place where there is none.
Pose E3mop::keep_path(const Observation& now, const FreeSpace& free_space) {
  raw_points_.clear();
  raw_points_.push_back(toolkit::position(now.pose));
  kept_ = 1;
  start_theta_ = now.pose.theta;
  if (path_.empty()) return now.pose;
  const TrackingError error = tracking_error(path_, now.pose);
  if (std::abs(error.cross_m) > lost_m || std::abs(error.aside_rad) > lost_rad) return now.pose;
  const double reach_m = std::max(kept_m, kept_s * now.velocity.v_x);
  const double first_m = path_[error.index].arc_m;
  std::size_t last = error.index;
  raw_points_[0] = path_[last].at;
  for (std::size_t i = error.index + 1; i < path_.size() && path_[i].arc_m < first_m + reach_m + 1e-6; ++i) {
    const PathPoint& point = path_[i];
    if (!free_space.is_free(arc_state({point.at.x, point.at.y, point.theta}))) break;
    if (point.arc_m - path_[last].arc_m < point_spacing - 1e-6) continue;
    raw_points_.push_back(point.at);
    last = i;
  }
  kept_ = raw_points_.size();
  if (kept_ == 1) {
    raw_points_[0] = toolkit::position(now.pose);
    return now.pose;
  }
  start_theta_ = path_[error.index].theta;
  return {path_[last].at.x, path_[last].at.y, path_[last].theta};
}

// The lattice path from there on. False where there is nowhere to go.
bool E3mop::plan(const Observation& now, const Pose& from, const FreeSpace& free_space) {
  plan_.look(from, foreseen_, free_space, now.footprint.inscribed_radius_m);
  if (!plan_.choose_goal(global_path_)) return false;
  const double to_goal_m = toolkit::distance(toolkit::position(now.pose), plan_.goal());
  if (plan_.is_cut() && to_goal_m < wait_within_m) return false;
  SearchSettings settings;
  settings.v_max = now.limits.v_max;
  settings.omega_max = now.limits.omega_max;
  settings.pruning = pruning;
  settings.first_turn_s = std::abs(now.velocity.v_x) / now.limits.a_max;
  plan_.search(from, settings);
  lay_points();
  return raw_points_.size() > 1;
}

void E3mop::read_field(const Observation& now) {
  const dmrp_field& field = *distance_field_->field(distance_field_);
  field_.read(field);
  foreseen_.read(field);
  foresees_ = false;
  for (const Agent& agent : now.agents) {
    if (agent.state != DMRP_ROBOT_ACTIVE && agent.kind == DMRP_AGENT_ROBOT) continue;
    const Vec2 from = toolkit::position(agent.pose);
    foreseen_.add_swept_disc(from, from + prediction_time * agent.velocity, agent.radius_m);
    foresees_ = true;
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

// The lattice path, equally spaced; its end is the goal itself where it was reached.
void E3mop::lay_points() {
  Vec2 last = raw_points_.back();
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
  for (const Pose& pose : plan_.found().poses) walk(toolkit::position(pose));
  if (!plan_.found().found || length_m >= smoothing_length) return;
  walk(plan_.goal());
  if (raw_points_.size() > 1 && toolkit::distance(raw_points_.back(), plan_.goal()) < 0.5 * point_spacing)
    raw_points_.back() = plan_.goal();
  else if (toolkit::distance(raw_points_.back(), plan_.goal()) > 1e-3)
    raw_points_.push_back(plan_.goal());
}

bool E3mop::shape_path(const Observation& now, const FreeSpace& free_space) {
  if (lay_last_leg() && fit(now, free_space, {}, 2.0 * last_leg_m)) return true;
  points_ = raw_points_;
  SmoothingSettings settings;
  settings.weight_smoothness = weight_smoothness;
  settings.weight_obstacle = weight_obstacle;
  settings.safe_distance_m = safe_distance;
  settings.iterations = static_cast<int>(max_iterations);
  settings.needed_m = free_space.needed_m();
  std::size_t fixed = kept_;
  std::optional<double> start_theta = start_theta_;
  if (kept_ == 1 && now.velocity.v_x < slow_m_s) {
    start_theta.reset();
  } else if (kept_ == 1 && points_.size() > 3) {
    points_[1] = points_[0] + point_spacing * toolkit::from_angle(start_theta_);
    fixed = 2;
  }
  smoother_.smooth(points_, fixed, foreseen_, settings);
  const double needed_m = now.velocity.v_x * now.velocity.v_x / (2.0 * now.limits.a_max) + least_way_m;
  if (fit(now, free_space, start_theta, needed_m)) return true;
  points_ = raw_points_;
  return fit(now, free_space, start_theta, 0.0);
}

// The last bit of the way straight to the goal: too short for smoothing, which would bend it off what stands beside.
bool E3mop::lay_last_leg() {
  const Vec2 from = raw_points_[kept_ - 1];
  const double left_m = toolkit::distance(from, plan_.goal());
  if (!plan_.found().found || !plan_.is_path_end() || left_m > last_leg_m || left_m < 1e-3) return false;
  points_.assign(raw_points_.begin(), raw_points_.begin() + static_cast<std::ptrdiff_t>(kept_));
  const auto steps = std::max(1, static_cast<int>(left_m / point_spacing));
  for (int i = 1; i <= steps; ++i) points_.push_back(toolkit::lerp(from, plan_.goal(), static_cast<double>(i) / steps));
  return true;
}

// The spline and its speeds; ends where it would collide. False where that is nearer than `needed_m`.
bool E3mop::fit(const Observation& now, const FreeSpace& free_space, std::optional<double> start_theta,
                double needed_m) {
  spline_.fit(points_, start_theta, sample_step_m, path_);
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const PathPoint& point = path_[i];
    if (free_space.is_free(arc_state({point.at.x, point.at.y, point.theta}))) continue;
    if (point.arc_m < needed_m) return false;
    path_.resize(i);
    break;
  }
  if (path_.size() < 2) return false;
  plan_speeds(path_, now.velocity.v_x, 0.0, now.limits);
  return true;
}

// Brakes and turns in place, as long as the outline has the room for it.
Command E3mop::turn(const Observation& now, double angle, const FreeSpace& free_space) {
  Command command = braking(now);
  const double omega = turning_rate(angle, now);
  const double turned = omega * (seconds(now.dt_ns) + 0.5 * std::abs(omega) / now.limits.alpha_max);
  for (const double share : {0.5, 1.0})
    if (!free_space.is_free(arc_state({now.pose.x, now.pose.y, now.pose.theta + share * turned}))) return command;
  command.omega = omega;
  return command;
}

// The command, slower where its arc would run into something before the robot could stop.
Command E3mop::safe(const Observation& now, Command command, const FreeSpace& free_space) {
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

// The lattice path as what was considered, the profile as what is intended.
void E3mop::annotate() {
  if (!annotate_ || !annotate_->wanted(annotate_)) return;
  constexpr double step_s = 0.1;
  constexpr int steps = 30;
  constexpr auto step_ns = static_cast<std::int64_t>(step_s * 1e9);
  const std::vector<Pose>& lattice_path = plan_.found().poses;
  if (lattice_path.size() > 1)
    annotate_->trajectory(annotate_, DMRP_ANNOTATE_CANDIDATE, lattice_path.data(),
                          static_cast<std::uint32_t>(lattice_path.size()), step_ns);
  intended_.clear();
  std::size_t i = 0;
  for (int k = 0; k <= steps; ++k) {
    while (i + 2 < path_.size() && path_[i + 1].time_s < k * step_s) ++i;
    const double span_s = path_[i + 1].time_s - path_[i].time_s;
    const double share = std::isfinite(span_s) ? std::clamp((k * step_s - path_[i].time_s) / span_s, 0.0, 1.0) : 0.0;
    const Vec2 at = toolkit::lerp(path_[i].at, path_[i + 1].at, share);
    intended_.push_back({at.x, at.y, path_[i].theta});
  }
  annotate_->trajectory(annotate_, DMRP_ANNOTATE_PREDICTED, intended_.data(),
                        static_cast<std::uint32_t>(intended_.size()), step_ns);
}

}  // namespace dmrp::controllers
