// SPDX-License-Identifier: MIT
#include "controllers/dwa/dwa.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::controllers {

namespace {

// If standing still scores best, this many headings are tried, each by a straight path of this length.
constexpr int headings_tried = 36;
constexpr double probe_m = 0.4;

// A turn in place begins if the chosen heading deviates by more than the first angle, and ends below the second.
constexpr double turn_begin_rad = 0.3;
constexpr double turn_end_rad = 0.1;

// A turn must lower the critics' sum by this much. (The two goal critics add about 1.6 per metre.)
constexpr double turn_gain = 0.1;

// The robot waits within this distance of a goal that is cut off.
constexpr double wait_within_m = 0.15;

// After standing for this long, the robot counts as stalled.
constexpr std::int64_t stall_ns = 2'000'000'000;

}  // namespace

Descriptor Dwa::describe() {
  return describe_controller("dmrp.controller.dwa", "DWA")
      .summary("tries the velocities within reach on the costmap and takes the arc that scores best")
      .source(
          "Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation "
          "Magazine 4 (1997); critics as in ROS's dwa_local_planner")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Dwa::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  begin(start);
  tuning_ = {sim_time,      sim_granularity, angular_sim_granularity, path_distance_bias, goal_distance_bias,
             occdist_scale, twirling_scale,  forward_point_distance,  scaling_speed,      max_scaling_factor};
  window_.v.reserve(static_cast<std::size_t>(*vx_samples) + 1);
  window_.v_y.reserve(static_cast<std::size_t>(*vy_samples) + 1);
  window_.omega.reserve(static_cast<std::size_t>(*vth_samples) + 1);
  oscillation_.reset();
  standing_ns_ = 0;
  turn_to_.reset();
  leaving_ = false;
  stalled_at_.reset();
  return Status::ok;
}

Status Dwa::control(const Observation& now, Command& command) {
  const CostmapView map(*costmap_->costmap(costmap_, now.robot));
  FootprintCheck footprint(map, now.footprint, footprint_padding, now.pose);
  if (turn_to_ && std::abs(toolkit::difference(now.pose.theta, *turn_to_)) <= turn_end_rad) turn_to_.reset();
  if (at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    turn_to_.reset();
  } else if (turn_to_) {
    command = turn(now, *turn_to_, footprint);
  } else {
    return choose(now, map, footprint, command);
  }
  annotations_.arc(now.pose, command, tuning_.sim_time);
  return Status::ok;
}

// The dynamic window approach: scores the samples of the window by the critics and takes the best.
Status Dwa::choose(const Observation& now, const CostmapView& map, FootprintCheck& footprint, Command& command) {
  sample_window(now);
  const Vec2 robot = toolkit::position(now.pose);
  const dwa::FrontSettings settings = {now.footprint.inscribed_radius_m + footprint_padding,
                                       max_global_plan_lookahead_dist, forward_point_distance, extend_path};
  const dwa::LocalGoal goal = fronts_.spread(tracker_, robot, now.pose.theta, map, reachable_boxes(now), settings);
  const double to_goal_m = toolkit::distance(robot, goal.at);
  if (goal.is_cut && to_goal_m < wait_within_m) return Status::ok;

  const bool stalled = is_stalled(now);
  oscillation_.release(now.pose, oscillation_reset_dist, oscillation_reset_angle);
  const std::optional<FootprintCheck> room = room_to_leave_for(now, map, stalled && !goal.is_cut);
  const bool follow = !leaves_path(robot, stalled && !goal.is_cut);
  const bool align = to_goal_m > forward_point_distance;
  const dwa::Ramp ramp = {
      {now.velocity.v_x, now.velocity.omega, now.velocity.v_y}, now.limits.a_max, now.limits.alpha_max};
  const dwa::Scene scene = {now.pose,
                            now.limits.v_max,
                            map,
                            fronts_.terrain(),
                            fronts_.path(),
                            fronts_.goal(),
                            fronts_.nose(),
                            goal.front_length_m,
                            follow,
                            align,
                            oscillation_,
                            use_dwa ? nullptr : &ramp,
                            room ? &*room : nullptr};
  const std::optional<dwa::Sample> choice = dwa::cheapest(window_, scene, tuning_, footprint);
  if (!choice) {
    set_error("every arc within reach runs into an obstacle");
    return Status::no_solution;
  }
  annotate(scene, *choice);
  if (speed_of(*choice) == 0.0 && speed_of(now.velocity) < standing_m_s) {
    if (at_goal_.settles(tracker_.stop(), now)) {
      command = at_goal_.command(tracker_.stop(), now);
      return Status::ok;
    }
    if (turn_to_better_heading) turn_to_ = better_heading(scene, footprint);
    if (turn_to_) {
      command = turn(now, *turn_to_, footprint);
      return Status::ok;
    }
  }
  oscillation_.record(now.pose, *choice);
  command = approach(now, *choice);
  return Status::ok;
}

void Dwa::sample_window(const Observation& now) {
  const dwa::SampleCounts counts = {static_cast<std::size_t>(*vx_samples), static_cast<std::size_t>(*vy_samples),
                                    static_cast<std::size_t>(*vth_samples)};
  if (use_dwa) {
    window_.sample(now, seconds(now.dt_ns), std::max(now.limits.v_max, now.limits.v_y_max), counts);
  } else {
    // a velocity kept for the whole simulated time must not overshoot the goal
    const double stop_m = toolkit::distance(toolkit::position(now.pose), tracker_.stop().position);
    window_.sample(now, sim_time, stop_m / sim_time, counts);
  }
}

// What the critics look up: cells about the robot, more if it stands and may probe headings, and cells about the ends
// of the arcs and their noses.
std::array<dwa::Box, 2> Dwa::reachable_boxes(const Observation& now) const {
  const Vec2 robot = toolkit::position(now.pose);
  const auto box_about = [robot](double half_m) {
    return dwa::Box{robot - Vec2{half_m, half_m}, robot + Vec2{half_m, half_m}};
  };
  const bool is_standing = speed_of(now.velocity) < standing_m_s;
  const dwa::Box near = box_about(is_standing ? probe_m + forward_point_distance : 0.0);

  const double fastest = std::hypot(std::max(std::abs(window_.v.front()), std::abs(window_.v.back())),
                                    window_.v_y.back() - window_.v_y.front());
  if (!use_dwa) return {near, box_about(fastest * sim_time + forward_point_distance)};
  dwa::Box ends;
  for (const double omega : window_.omega) {
    // the end of an arc is linear in its speeds
    DirectedPoint unit_end = directed({0.0, 0.0}, now.pose.theta);
    ArcStepper(1.0, omega, sim_time).step(unit_end);
    const Vec2 unit_aside = toolkit::perpendicular(unit_end.at);
    for (const double v : {window_.v.front(), window_.v.back()})
      for (const double v_y : {window_.v_y.front(), window_.v_y.back()})
        for (const double nose_m : {0.0, *forward_point_distance})
          ends.add(robot + v * unit_end.at + v_y * unit_aside + nose_m * unit_end.heading);
  }
  return {near, ends};
}

// A footprint with a cell more of padding, while the robot leaves an obstacle: from a stall beside it until it is
// clear. Beside the end of a wall, all free arcs may lead away from the goal; by the goal critics alone, the robot
// would stand there for ever.
std::optional<FootprintCheck> Dwa::room_to_leave_for(const Observation& now, const CostmapView& map, bool begins) {
  leaving_ = leave_padding && (leaving_ || begins);
  if (!leaving_) return {};
  const StopPoint& stop = tracker_.stop();
  const FootprintCheck room(map, now.footprint, footprint_padding + map.resolution_m(), now.pose);
  leaving_ =
      room.starts_too_close() && toolkit::distance(toolkit::position(now.pose), stop.position) > stop.tolerance_m;
  return leaving_ ? std::optional(room) : std::nullopt;
}

// True once each time that the robot has stood for stall_ns.
bool Dwa::is_stalled(const Observation& now) {
  standing_ns_ = stands(now.velocity) ? standing_ns_ + now.dt_ns : 0;
  if (standing_ns_ < stall_ns) return false;
  standing_ns_ = 0;
  return true;
}

// Before a right angle of the path, path critics that weigh more than twice the goal critics hold the robot one nose's
// length before it. From a stall until it has driven that far, they do not count.
bool Dwa::leaves_path(Vec2 robot, bool stalled) {
  if (stalled && leave_path_if_stalled) stalled_at_ = robot;
  if (stalled_at_ && toolkit::distance(robot, *stalled_at_) > forward_point_distance) stalled_at_.reset();
  return stalled_at_.has_value();
}

// Called if standing still scores best: the slow arcs of the window may be too short to show a way on. Scores a
// straight path in every direction and returns the best heading, if that is clearly better and far enough from the
// current one.
std::optional<double> Dwa::better_heading(const dwa::Scene& scene, FootprintCheck& footprint) const {
  const dwa::Sample probe = {probe_m / tuning_.sim_time, 0.0};
  const dwa::OscillationGuard no_history;
  double best = dwa::score({0.0, 0.0}, scene, tuning_, footprint, std::numeric_limits<double>::infinity());
  if (best == dwa::rejected) best = std::numeric_limits<double>::infinity();
  best -= turn_gain;
  double aside = 0.0;
  for (int i = 0; i < headings_tried; ++i) {
    const double angle = toolkit::wrap(i * 2.0 * toolkit::pi / headings_tried);
    const dwa::Scene turned = dwa::with_heading(scene, toolkit::wrap(scene.pose.theta + angle), no_history);
    const double cost = dwa::score(probe, turned, tuning_, footprint, best);
    if (cost == dwa::rejected || !(cost < best)) continue;
    best = cost;
    aside = angle;
  }
  // a robot that leaves an obstacle has no other way
  if (!(std::abs(aside) > (scene.room ? turn_end_rad : turn_begin_rad))) return {};
  return toolkit::wrap(scene.pose.theta + aside);
}

Command Dwa::turn(const Observation& now, double heading, FootprintCheck& footprint) const {
  Command command = braking(now);
  const double omega = turning_rate(toolkit::difference(now.pose.theta, heading), now);
  footprint.scale(1.0);
  const int steps = dwa::simulation_steps({0.0, omega}, tuning_);
  if (footprint.arc_cost(now.pose, 0.0, omega, tuning_.sim_time, steps) != in_collision) command.omega = omega;
  return command;
}

// The command of this period toward the chosen velocity.
Command Dwa::approach(const Observation& now, const dwa::Sample& choice) const {
  Command command;
  command.v_x = choice.v;
  command.v_y = choice.v_y;
  command.omega = choice.omega;
  if (use_dwa) return command;
  const double period_s = seconds(now.dt_ns);
  const Vec2 v =
      toward(Vec2{now.velocity.v_x, now.velocity.v_y}, Vec2{choice.v, choice.v_y}, now.limits.a_max * period_s);
  const double omega = toward(now.velocity.omega, choice.omega, now.limits.alpha_max * period_s);
  command.v_x = std::clamp(v.x, now.limits.v_min, now.limits.v_max);
  command.v_y = std::clamp(v.y, -now.limits.v_y_max, now.limits.v_y_max);
  command.omega = std::clamp(omega, -now.limits.omega_max, now.limits.omega_max);
  return command;
}

// The samples and the choice.
void Dwa::annotate(const dwa::Scene& scene, const dwa::Sample& choice) const {
  if (!annotations_.wanted()) return;
  constexpr int steps = 17;
  std::array<Pose, steps + 1> poses;
  const auto add = [&](const dwa::Sample& sample, std::uint32_t role) {
    dwa::Rollout rollout(sample, scene, tuning_.sim_time, steps);
    DirectedPoint at = directed(scene.pose);
    for (Pose& pose : poses) {
      pose = pose_of(at);
      rollout.step(at);
    }
    annotations_.trajectory(role, poses, tuning_.sim_time / steps);
  };
  for (const double v : window_.v)
    for (const double v_y : window_.v_y)
      for (const double omega : window_.omega) add(window_.at(v, v_y, omega), DMRP_ANNOTATE_CANDIDATE);
  add(choice, DMRP_ANNOTATE_PREDICTED);
}

}  // namespace dmrp::controllers
