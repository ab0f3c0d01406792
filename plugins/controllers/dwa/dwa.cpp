// SPDX-License-Identifier: MIT
#include "controllers/dwa/dwa.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "controllers/motion/annotate_arc.hpp"

namespace dmrp::controllers {

namespace {

// Of a straight way across a window of usual size; more costs an allocation.
constexpr std::size_t most_plan_points = 1024;

// Closer to obstacles than this, beyond what the footprint needs, the goal's fronts count steps by their effort.
constexpr double easy_m = 0.15;

// Headings looked at where standing still is best, and how far straight ahead in each.
constexpr int headings_tried = 36;
constexpr double probe_m = 0.4;

// Turning in place begins when the chosen heading is further aside than the first, and ends below the second.
constexpr double turn_begin_rad = 0.3;
constexpr double turn_end_rad = 0.1;

// What a turn must promise to gain, in the critics' sum: the goal's two come to some 1.6 for a metre.
constexpr double turn_gain = 0.1;

// So near to where the way is cut off, the robot waits.
constexpr double wait_within_m = 0.15;

// Below this the robot counts as standing.
constexpr double standing_m_s = 0.05;
constexpr double standing_rad_s = 0.05;

// Standing for so long is a stall.
constexpr std::int64_t stall_ns = 2'000'000'000;

}  // namespace

Descriptor Dwa::describe() {
  return Descriptor("dmrp.controller.dwa", "DWA", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("tries the velocities within reach on the costmap and takes the arc that scores best")
      .source(
          "Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation "
          "Magazine 4 (1997); critics as in ROS's dwa_local_planner")
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Dwa::start(const World&, std::uint64_t) {
  costmap_ = extension<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  if (!costmap_) {
    set_error("the host has no " DMRP_EXT_LOCAL_COSTMAP);
    return Status::error;
  }
  annotate_ = extension<dmrp_annotate>(DMRP_EXT_ANNOTATE);
  tuning_ = {sim_time,      sim_granularity, angular_sim_granularity, path_distance_bias, goal_distance_bias,
             occdist_scale, twirling_scale,  forward_point_distance,  scaling_speed,      max_scaling_factor};
  window_.v.reserve(static_cast<std::size_t>(*vx_samples) + 1);
  window_.omega.reserve(static_cast<std::size_t>(*vth_samples) + 1);
  plan_.reserve(most_plan_points);
  tracker_.clear();
  at_goal_.reset();
  oscillation_.reset();
  standing_ns_ = 0;
  turning_ = false;
  return Status::ok;
}

void Dwa::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
}

Status Dwa::step(const Observation& now, Command& command) {
  command = braking(now);
  tracker_.update(now);
  if (tracker_.empty()) return Status::ok;
  const CostmapView map(*costmap_->costmap(costmap_));
  FootprintCheck footprint(map, now.footprint, footprint_padding, now.pose);
  turning_ = turning_ && std::abs(toolkit::difference(now.pose.theta, turn_to_)) > turn_end_rad;
  if (at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    turning_ = false;
  } else if (turning_) {
    command = turn(now, footprint);
  } else {
    return choose(now, map, footprint, command);
  }
  annotate_arc(annotate_, now.pose, command.v_x, command.omega, tuning_.sim_time);
  return Status::ok;
}

// The dynamic window itself.
Status Dwa::choose(const Observation& now, const CostmapView& map, FootprintCheck& footprint, Command& command) {
  // what is kept for the whole time simulated must not overshoot the goal
  const double stop_m = toolkit::distance(toolkit::position(now.pose), tracker_.stop().position);
  window_.sample(now, use_dwa ? seconds(now.dt_ns) : *sim_time, use_dwa ? now.limits.v_max : stop_m / sim_time,
                 static_cast<std::size_t>(*vx_samples), static_cast<std::size_t>(*vth_samples));
  const double needed_m = now.footprint.inscribed_radius_m + footprint_padding;
  terrain_.read(map, map.highest_cost_at(needed_m), map.highest_cost_at(needed_m + easy_m));
  want_reach(now, map);
  lay_out_plan(map);
  spread_fronts(now, map);
  // as near as it gets to something that stands across the whole way: wait
  const double to_goal_m = toolkit::distance(toolkit::position(now.pose), goal_);
  if (goal_is_cut_ && to_goal_m < wait_within_m) return Status::ok;

  oscillation_.release(now.pose, oscillation_reset_dist, oscillation_reset_angle);
  if (has_stalled(now)) oscillation_.reset();
  ramp_ = {{now.velocity.v_x, now.velocity.omega}, now.limits.a_max, now.limits.alpha_max};
  // a path is not replanned about people: round something that stands on it, the goal critics lead alone
  const bool follow =
      std::all_of(plan_.begin(), plan_.end(), [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  const bool align = to_goal_m > forward_point_distance;
  const dwa::Scene scene = {now.pose,    now.limits.v_max, map,    terrain_, path_front_,  goal_front_,
                            nose_front_, front_length_m_,  follow, align,    oscillation_, use_dwa ? nullptr : &ramp_};
  const std::optional<dwa::Sample> choice = dwa::cheapest(window_, scene, tuning_, footprint);
  if (!choice) {
    set_error("every arc within reach runs into an obstacle");
    return Status::no_solution;
  }
  annotate(scene, *choice);
  if (choice->v == 0.0 && std::abs(now.velocity.v_x) < standing_m_s) {
    if (at_goal_.settles(tracker_.stop(), now)) {
      command = at_goal_.command(tracker_.stop(), now);
      return Status::ok;
    }
    if (begin_turn(scene, footprint)) {
      command = turn(now, footprint);
      return Status::ok;
    }
  }
  oscillation_.note(now.pose, choice->v, choice->omega);
  command.v_x = choice->v;
  command.omega = choice->omega;
  if (!use_dwa) {
    // the first step toward it
    const double period_s = seconds(now.dt_ns);
    const double v = toward(now.velocity.v_x, choice->v, now.limits.a_max * period_s);
    const double omega = toward(now.velocity.omega, choice->omega, now.limits.alpha_max * period_s);
    command.v_x = std::clamp(v, now.limits.v_min, now.limits.v_max);
    command.omega = std::clamp(omega, -now.limits.omega_max, now.limits.omega_max);
  }
  return Status::ok;
}

// Whether the robot has stood for a while. A direction that was forbidden because it was reversed may then be the only
// way on; upstream, move_base's recovery from oscillation clears such flags.
bool Dwa::has_stalled(const Observation& now) {
  const bool stands = std::abs(now.velocity.v_x) < standing_m_s && std::abs(now.velocity.omega) < standing_rad_s;
  standing_ns_ = stands ? standing_ns_ + now.dt_ns : 0;
  if (standing_ns_ < stall_ns) return false;
  standing_ns_ = 0;
  return true;
}

// Fronts are asked for where the robot is, where arcs and their noses end, and, for one that stands, all about it.
void Dwa::want_reach(const Observation& now, const CostmapView& map) {
  const std::int32_t here = terrain_.index_of(map, now.pose.x, now.pose.y);
  const std::int32_t margin = terrain_.is_free(here) ? 1 : dwa::escape_reach_cells + 1;
  const auto want = [&](Vec2 lower, Vec2 upper, double beyond_m) {
    terrain_.want(map.column_of(lower.x - beyond_m) - margin, map.column_of(upper.x + beyond_m) + margin,
                  map.row_of(lower.y - beyond_m) - margin, map.row_of(upper.y + beyond_m) + margin);
  };
  const Vec2 at = toolkit::position(now.pose);
  want(at, at, std::abs(now.velocity.v_x) < standing_m_s ? probe_m + forward_point_distance : 0.0);

  const double fastest = std::max(std::abs(window_.v.front()), std::abs(window_.v.back()));
  if (!use_dwa) return want(at, at, fastest * sim_time + forward_point_distance);
  Vec2 lower = {1e300, 1e300};
  Vec2 upper = {-1e300, -1e300};
  for (const double omega : window_.omega) {
    // an arc's end goes with its speed
    ArcState one = arc_state({0.0, 0.0, now.pose.theta});
    ArcStepper(1.0, omega, sim_time).step(one);
    for (const double v : {window_.v.front(), window_.v.back()}) {
      for (const double nose_m : {0.0, *forward_point_distance}) {
        const Vec2 point = at + v * Vec2{one.x, one.y} + nose_m * Vec2{one.cos_theta, one.sin_theta};
        lower = {std::min(lower.x, point.x), std::min(lower.y, point.y)};
        upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
      }
    }
  }
  want(lower, upper, 0.0);
}

// What was tried, and what was chosen.
void Dwa::annotate(const dwa::Scene& scene, const dwa::Sample& choice) const {
  if (!annotate_ || !annotate_->wanted(annotate_)) return;
  constexpr int steps = 17;
  std::array<dmrp_pose, steps + 1> poses;
  const auto leave = [&](const dwa::Sample& sample, std::uint32_t role) {
    dwa::Rollout rollout(sample, scene, tuning_.sim_time, steps);
    ArcState at = arc_state(scene.pose);
    for (dmrp_pose& pose : poses) {
      pose = {at.x, at.y, std::atan2(at.sin_theta, at.cos_theta)};
      rollout.step(at);
    }
    annotate_->trajectory(annotate_, role, poses.data(), steps + 1,
                          static_cast<std::int64_t>(tuning_.sim_time / steps * 1e9));
  };
  for (const double v : window_.v)
    for (const double omega : window_.omega) leave({v, omega}, DMRP_ANNOTATE_CANDIDATE);
  leave(choice, DMRP_ANNOTATE_PREDICTED);
}

// The path ahead in the window, in steps of half a cell.
void Dwa::lay_out_plan(const CostmapView& map) {
  plan_.clear();
  const double step_m = 0.5 * map.resolution_m();
  const double ahead_m = std::min<double>(max_global_plan_lookahead_dist, tracker_.remaining_m());
  const int steps = static_cast<int>(ahead_m / step_m);
  for (int i = 0; i <= steps + 1; ++i) {
    const Vec2 at = tracker_.point_at(tracker_.progress_m() + std::min(i * step_m, ahead_m));
    const std::int32_t index = terrain_.index_of(map, at.x, at.y);
    if (index < 0) break;  // out of the window
    plan_.push_back({at, index});
  }
}

// The nose comes to the path's end before the robot does: the path goes on there by its length, where that is free. Else
// the alignment critic would hold a robot back before its goal.
void Dwa::seed_beyond_end(const CostmapView& map) {
  if (tracker_.remaining_m() > max_global_plan_lookahead_dist) return;
  const Vec2 end = tracker_.point_at(tracker_.end_m());
  const Vec2 onward = toolkit::from_angle(tracker_.heading_at(tracker_.end_m(), 0.0));
  const double step_m = 0.5 * map.resolution_m();
  for (double beyond_m = step_m; beyond_m <= forward_point_distance; beyond_m += step_m) {
    const Vec2 at = end + beyond_m * onward;
    const std::int32_t index = terrain_.index_of(map, at.x, at.y);
    if (!terrain_.is_free(index)) return;
    path_front_.seed(index);
  }
}

void Dwa::spread_fronts(const Observation& now, const CostmapView& map) {
  const std::int32_t here = terrain_.index_of(map, now.pose.x, now.pose.y);
  const std::int32_t home = terrain_.nearest_free(here, dwa::escape_reach_cells);

  path_front_.begin(terrain_);
  for (const PlanPoint& point : plan_) path_front_.seed(point.index);
  seed_beyond_end(map);
  path_front_.spread();
  // cut off from all of the path: stay about here
  if (home >= 0 && !path_front_.reached(home)) {
    path_front_.seed(home);
    path_front_.spread();
  }

  goal_ = toolkit::position(now.pose);
  const std::int32_t goal = choose_goal(home);
  nose_front_.begin(terrain_);
  if (goal < 0) return;
  front_length_m_ = 0.0;
  const std::int32_t front = point_in_front(map, now.pose);
  nose_front_.seed(front < 0 ? goal : front);
  nose_front_.spread_by_effort(terrain_);
}

// The last point of the plan that the robot can get to; its own place where there is none. Leaves the front spread
// from it.
std::int32_t Dwa::choose_goal(std::int32_t home) {
  const auto spread_from = [this](std::int32_t index, bool everywhere = false) {
    goal_front_.begin(terrain_, everywhere);
    if (index < 0) return;
    goal_front_.seed(index);
    goal_front_.spread_by_effort(terrain_);
  };
  goal_is_cut_ = false;
  const auto last = std::find_if(plan_.rbegin(), plan_.rend(),
                                 [this](const PlanPoint& point) { return terrain_.is_free(point.index); });
  if (last != plan_.rend()) {
    goal_ = last->at;
    spread_from(last->index);
    if (home < 0 || goal_front_.reached(home)) return last->index;
  }
  // something stands across the whole way: as near as the path leads to it
  goal_is_cut_ = true;
  spread_from(home, true);
  const auto nearest = std::find_if(plan_.rbegin(), plan_.rend(),
                                    [this](const PlanPoint& point) { return goal_front_.reached(point.index); });
  if (nearest == plan_.rend()) return home;
  goal_ = nearest->at;
  spread_from(nearest->index);
  return nearest->index;
}

// A point beyond the goal by the nose's length, as far as that is free; the nose counts as no longer than that then.
std::int32_t Dwa::point_in_front(const CostmapView& map, const Pose& from) {
  const double step_m = 0.5 * map.resolution_m();
  Vec2 direction = toolkit::normalized(goal_ - toolkit::position(from));
  if (direction == Vec2{0.0, 0.0}) direction = toolkit::from_angle(from.theta);
  std::int32_t front = -1;
  const int steps = static_cast<int>(forward_point_distance / step_m);
  for (int i = 0; i <= steps; ++i) {
    const Vec2 point = goal_ + (i * step_m) * direction;
    const std::int32_t index = terrain_.index_of(map, point.x, point.y);
    if (!terrain_.is_free(index)) break;
    front = index;
    front_length_m_ = i * step_m;
  }
  return front;
}

// Where standing is best, the window's slow arcs may just not reach far enough to show a way on: looks all around for
// the heading whose straight way scores best, and whether that is aside enough to turn there first.
bool Dwa::begin_turn(const dwa::Scene& scene, FootprintCheck& footprint) {
  const dwa::Sample probe = {probe_m / tuning_.sim_time, 0.0};
  const dwa::OscillationGuard free_to_turn;
  double best = dwa::score({0.0, 0.0}, scene, tuning_, footprint, std::numeric_limits<double>::infinity());
  if (best == dwa::rejected) best = std::numeric_limits<double>::infinity();
  best -= turn_gain;
  double aside = 0.0;
  for (int i = 0; i < headings_tried; ++i) {
    const double angle = toolkit::wrap(i * 2.0 * toolkit::pi / headings_tried);
    const dwa::Scene turned = dwa::seen_along(scene, toolkit::wrap(scene.pose.theta + angle), free_to_turn);
    const double cost = dwa::score(probe, turned, tuning_, footprint, best);
    if (cost == dwa::rejected || !(cost < best)) continue;
    best = cost;
    aside = angle;
  }
  turning_ = std::abs(aside) > turn_begin_rad;
  turn_to_ = toolkit::wrap(scene.pose.theta + aside);
  return turning_;
}

Command Dwa::turn(const Observation& now, FootprintCheck& footprint) const {
  Command command = braking(now);
  const double omega = turning_rate(toolkit::difference(now.pose.theta, turn_to_), now);
  footprint.scale(1.0);
  const int steps = dwa::simulation_steps({0.0, omega}, tuning_);
  if (footprint.arc_cost(now.pose, 0.0, omega, tuning_.sim_time, steps) != in_collision) command.omega = omega;
  return command;
}

}  // namespace dmrp::controllers
