// SPDX-License-Identifier: MIT
#include "controllers/teb/teb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <string>

#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers {

namespace {

// The padding of the footprint in collision checks: about the distance between a cell's centre and its edge.
constexpr double padding_m = 0.03;

// While no band is feasible, a standing robot turns toward the path at this distance ahead, if the angle is larger than
// the threshold.
constexpr double face_ahead_m = 0.8;
constexpr double turn_begin_rad = 0.5;

// Occupied cells within this distance of an agent's disc count as the agent's.
constexpr double agent_cells_m = 0.2;

// After this many consecutive cycles without a feasible band, the horizon shrinks less.
constexpr int shrink_less_after = 10;

// The mean velocity from the first pose to pose `poses`, bounded by the limits and by what the robot can reach within
// one control period.
Command first_command(const teb::TimedElasticBand& band, std::size_t poses, const Observation& now) {
  const std::size_t last = std::min(poses, band.size() - 1);
  double duration_s = 0.0;
  for (std::size_t i = 0; i < last; ++i) duration_s += band.dt[i];
  const Vec2 chord = band.position(last) - band.position(0);
  const double distance_m = toolkit::norm(chord);
  const double ahead = toolkit::dot(chord, toolkit::from_angle(band.theta[0]));
  const double v = std::copysign(distance_m, ahead) / duration_s;
  const double omega = toolkit::difference(band.theta[0], band.theta[last]) / duration_s;

  const Limits& limits = now.limits;
  const double period_s = seconds(now.dt_ns);
  if (is_car_like(limits)) {
    const double reached = toward(now.velocity.v_x, std::clamp(v, limits.v_min, limits.v_max), limits.a_max * period_s);
    return steered(std::clamp(reached, limits.v_min, limits.v_max), v == 0.0 ? 0.0 : omega / v, limits);
  }
  Command command;
  if (is_holonomic(limits)) {
    const Vec2 wanted = toolkit::rotate(chord, -band.theta[0]) / duration_s;
    const Vec2 bounded = {std::clamp(wanted.x, limits.v_min, limits.v_max),
                          std::clamp(wanted.y, -limits.v_y_max, limits.v_y_max)};
    const Vec2 reached = toward(Vec2{now.velocity.v_x, now.velocity.v_y}, bounded, limits.a_max * period_s);
    command.v_x = std::clamp(reached.x, limits.v_min, limits.v_max);
    command.v_y = std::clamp(reached.y, -limits.v_y_max, limits.v_y_max);
  } else {
    command.v_x = toward(now.velocity.v_x, std::clamp(v, limits.v_min, limits.v_max), limits.a_max * period_s);
    command.v_x = std::clamp(command.v_x, limits.v_min, limits.v_max);
  }
  command.omega =
      toward(now.velocity.omega, std::clamp(omega, -limits.omega_max, limits.omega_max), limits.alpha_max * period_s);
  command.omega = std::clamp(command.omega, -limits.omega_max, limits.omega_max);
  return command;
}

// The pose at a time, interpolated linearly between two poses; the last pose after the end.
Pose pose_at(const teb::TimedElasticBand& band, double time_s) {
  for (std::size_t i = 0; i < band.dt.size(); ++i) {
    if (time_s < band.dt[i]) {
      const double share = time_s / band.dt[i];
      const Vec2 at = toolkit::lerp(band.position(i), band.position(i + 1), share);
      return {at.x, at.y, toolkit::wrap(band.theta[i] + share * toolkit::difference(band.theta[i], band.theta[i + 1]))};
    }
    time_s -= band.dt[i];
  }
  return band.pose(band.size() - 1);
}

}  // namespace

Descriptor Teb::describe() {
  return describe_controller("dmrp.controller.teb", "TEB")
      .summary("optimises timed elastic bands, one for each way round the obstacles, and follows the cheapest")
      .source(
          "Roesmann, Hoffmann, Bertram: Integrated online trajectory planning and optimization in distinctive "
          "topologies, Robotics and Autonomous Systems 88 (2017); as ROS's teb_local_planner")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC |
                  1u << DMRP_KINEMATICS_ACKERMANN)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Teb::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  clusters_ = &extension<dmrp_obstacle_clusters>();
  begin(start);
  steering_.reset();
  obstacles_.clear();
  parameters_ = parameters();
  const double periods = parameters_.oscillation_filter_duration / seconds(start.world->control_period_ns);
  via_points_.reserve(64);
  oscillation_.reset(static_cast<std::size_t>(std::max(2.0, std::round(periods))));
  planner_.start(parameters_, start.seed);
  preferred_turn_ = teb::Turn::any;
  infeasible_in_a_row_ = 0;
  was_infeasible_ = false;
  return Status::ok;
}

Status Teb::control(const Observation& now, Command& command) {
  steering_.update(now);
  if (at_goal_.arrived(tracker_.stop(), now)) {
    planner_.clear();
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  watch_for_oscillation(now);
  const CostmapView map(*costmap_->costmap(costmap_, now.robot));
  const Status status = drive(now, map, command);
  oscillation_.record(command, now.limits);
  return status;
}

bool Teb::was_infeasible_lately(std::int64_t t_ns) const {
  return was_infeasible_ && seconds(t_ns - infeasible_ns_) < parameters_.shrink_horizon_min_duration;
}

// Half the look-ahead for a while after no band was feasible; three quarters if that does not help.
double Teb::look_ahead_m(std::int64_t t_ns) const {
  const double whole_m = parameters_.max_global_plan_lookahead_dist;
  if (!parameters_.shrink_horizon_backup || !was_infeasible_lately(t_ns)) return whole_m;
  return infeasible_in_a_row_ >= shrink_less_after ? 0.75 * whole_m : 0.5 * whole_m;
}

void Teb::watch_for_oscillation(const Observation& now) {
  if (!parameters_.oscillation_recovery) return;
  const bool is_recent = preferred_turn_ != teb::Turn::any &&
                         seconds(now.t_ns - oscillated_ns_) < parameters_.oscillation_recovery_min_duration;
  if (oscillation_.is_oscillating(parameters_.oscillation_v_eps, parameters_.oscillation_omega_eps)) {
    if (!is_recent) preferred_turn_ = now.applied.omega > 0.0 ? teb::Turn::left : teb::Turn::right;
    oscillated_ns_ = now.t_ns;
  } else if (!is_recent) {
    preferred_turn_ = teb::Turn::any;
  }
}

Status Teb::drive(const Observation& now, const CostmapView& map, Command& command) {
  FootprintCheck footprint(map, now.footprint, padding_m, now.pose);
  path_.look(tracker_, now, map, look_ahead_m(now.t_ns));
  obstacles_.gather(now, clusters_->clusters(clusters_, now.robot));
  planner_.plan(task(now));
  while (planner_.best() && !is_feasible(*planner_.best(), now, footprint)) planner_.drop_best();
  if (planner_.best()) {
    command = first_command(*planner_.best(), parameters_.control_look_ahead_poses, now);
    infeasible_in_a_row_ = 0;
    annotate(*planner_.best());
    return Status::ok;
  }
  planner_.clear();
  was_infeasible_ = true;
  infeasible_ns_ = now.t_ns;
  ++infeasible_in_a_row_;
  return wait(now, footprint, command);
}

teb::Task Teb::task(const Observation& now) {
  via_points_.clear();
  const std::vector<Vec2>& points = path_.points();
  if (parameters_.global_plan_viapoint_sep > 0.0) {
    const auto stride = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(parameters_.global_plan_viapoint_sep / PathAhead::spacing_m)));
    for (std::size_t i = stride; i + 1 < points.size(); i += stride) via_points_.push_back(points[i]);
  }
  teb::Task task;
  task.t_ns = now.t_ns;
  task.start = now.pose;
  // the band ends along the path's direction; a robot that is no car turns to the goal's heading in place
  task.goal = path_.goal();
  if (path_.has_heading() && points.size() > 1 && !is_car_like(now.limits))
    task.goal.theta = toolkit::bearing(points[points.size() - 2], points.back());
  task.path = &points;
  task.scene = {&now.limits,  &now.footprint,       &obstacles_.all(), &via_points_,
                now.velocity, path_.ends_at_stop(), preferred_turn_};
  return task;
}

bool Teb::is_feasible(const teb::TimedElasticBand& band, const Observation& now, FootprintCheck& footprint) const {
  const std::size_t last = std::min(parameters_.feasibility_check_no_poses, band.size() - 1);
  double ahead_s = 0.0;
  for (std::size_t i = 0; i < last; ++i) {
    const double middle_s = ahead_s + 0.5 * band.dt[i];
    if (!is_free(pose_at(band, middle_s), middle_s, now, footprint)) return false;
    ahead_s += band.dt[i];
    if (!is_free(band.pose(i + 1), ahead_s, now, footprint)) return false;
  }
  return true;
}

// The costmap shows the agents at their current positions. If occupied cells belong to moving agents, checks against
// all obstacles at their predicted positions instead.
bool Teb::is_free(const Pose& pose, double ahead_s, const Observation& now, FootprintCheck& footprint) const {
  if (footprint.cost(directed(pose)) != in_collision) return true;
  if (!parameters_.include_dynamic_obstacles) return false;
  bool is_agents_cell = false;
  for (const Obstacle& obstacle : obstacles_.all()) {
    if (least_distance(now.footprint, toolkit::position(pose), obstacle, ahead_s) < padding_m &&
        separation(now.footprint, pose, obstacle, ahead_s).distance_m < padding_m)
      return false;
    is_agents_cell =
        is_agents_cell || (obstacle.velocity != Vec2{0.0, 0.0} &&
                           least_distance(now.footprint, toolkit::position(pose), obstacle, 0.0) < agent_cells_m);
  }
  return is_agents_cell;
}

// Without a feasible band, a moving robot brakes and reports that there is no solution. A standing robot waits and
// turns toward the path, to be ready once the path is free.
Status Teb::wait(const Observation& now, FootprintCheck& footprint, Command& command) {
  command = braking(now);
  if (speed_of(now.velocity) > standing_m_s) {
    set_error("no feasible band: braking");
    return Status::no_solution;
  }
  if (is_car_like(now.limits)) return Status::ok;
  const Vec2 ahead = tracker_.point_at_distance(toolkit::position(now.pose), face_ahead_m);
  const double angle = toolkit::difference(now.pose.theta, toolkit::bearing(toolkit::position(now.pose), ahead));
  const bool is_turning = std::abs(now.velocity.omega) > standing_rad_s;
  if (std::abs(angle) < (is_turning ? 0.2 : 1.0) * turn_begin_rad) return Status::ok;
  command = braking_turn(angle, now, footprint).value_or(command);
  return Status::ok;
}

void Teb::annotate(const teb::TimedElasticBand& best) const {
  if (!annotations_.wanted()) return;
  std::array<Pose, 32> poses;
  const auto add = [&](const teb::TimedElasticBand& band, std::uint32_t role) {
    const double step_s = band.duration_s() / static_cast<double>(poses.size() - 1);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = pose_at(band, static_cast<double>(i) * step_s);
    annotations_.trajectory(role, poses, step_s);
  };
  for (std::size_t i = 0; i < planner_.size(); ++i)
    if (&planner_.band(i) != &best) add(planner_.band(i), DMRP_ANNOTATE_CANDIDATE);
  add(best, DMRP_ANNOTATE_PREDICTED);
  annotations_.note(
      ("iterations " + std::to_string(planner_.iterations()) + ", bands " + std::to_string(planner_.size())).c_str());
}

}  // namespace dmrp::controllers
