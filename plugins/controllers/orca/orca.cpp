// SPDX-License-Identifier: MIT
#include "controllers/orca/orca.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"
#include "reciprocal/velocity_obstacle.hpp"

namespace dmrp::controllers {

namespace {

using reciprocal::half_plane;
using reciprocal::HalfPlane;

// Of a change that two robots owe each other, each makes half. People and robots that stand need not give way.
constexpr double robots_share = 0.5;
constexpr double whole_share = 1.0;

// The tracking error takes no more than this share of the gap to whatever is nearest, as in NH-ORCA, and always leaves
// so much that the robot can turn and drive off.
constexpr double share_of_gap = 0.5;
constexpr double least_error_m = 0.01;

Vec2 velocity_of(const Observation& now) {
  return toolkit::rotate({now.velocity.v_x, now.velocity.v_y}, now.pose.theta);
}

}  // namespace

Descriptor OrcaController::describe() {
  return describe_controller("dmrp.controller.orca", "ORCA")
      .summary("drives the collision-free velocity nearest to the path's, provided that robots share the evading")
      .source(
          "van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011); "
          "differential drives: Alonso-Mora et al.: Optimal reciprocal collision avoidance for multiple non-holonomic "
          "robots, DARS 2010 (Springer 2013)")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status OrcaController::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  clusters_ = &extension<dmrp_obstacle_clusters>();
  const Robot& robot = start.world.robots()[static_cast<std::uint32_t>(start.robot)];
  holonomic_ = robot.kinematics == DMRP_KINEMATICS_HOLONOMIC;
  begin(start);
  return Status::ok;
}

Status OrcaController::control(const Observation& now, Command& command) {
  // a path may pass its own end before it ends there
  const bool near_end = tracker_.remaining_m() <= std::max<double>(tracker_.stop().tolerance_m, lookahead_dist);
  if (near_end && at_goal_.reached(tracker_.stop(), now)) {
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  find_near(now);
  const double margin_m = holonomic_ ? 0.0 : error_m();
  planes_.clear();
  add_walls(now, margin_m);
  add_drive(now, margin_m);
  const std::size_t hard_count = planes_.size();
  add_agents(now, margin_m);
  const double fastest = holonomic_ ? std::hypot(now.limits.v_max, now.limits.v_y_max) : now.limits.v_max;
  const Vec2 wanted = preferred(now);
  const Vec2 velocity = program_.solve(planes_, hard_count, fastest, wanted);
  command = holonomic_ ? translate(now, velocity) : follow(now, velocity, wanted);
  annotations_.arc(now.pose, command, time_horizon_obst);
  return Status::ok;
}

// Sorts what is near into obstacles and agents.
void OrcaController::find_near(const Observation& now) {
  obstacles_.gather(now, clusters_->clusters(clusters_, now.robot), 0.0);
  const double cell_m = costmap_->costmap(costmap_, now.robot)->resolution_m;
  const double wall_reach_m = now.limits.v_max * time_horizon_obst;
  Footprint disc = now.footprint;
  disc.part_count = 0;
  const Pose at = {now.pose.x, now.pose.y, 0.0};
  walls_.clear();
  agents_.clear();
  for (const Obstacle& obstacle : obstacles_.all()) {
    const double gap_m = separation(disc, at, obstacle, 0.0).distance_m;
    // an obstacle may extend beyond the centres of its lethal cells
    if (obstacle.is_agent && gap_m < neighbor_distance)
      agents_.push_back({gap_m, &obstacle});
    else if (!obstacle.is_agent && gap_m - cell_m < wall_reach_m)
      walls_.push_back({gap_m - cell_m, &obstacle});
  }
  // stable: those equally near keep the order of the observation
  const auto nearer = [](const Near& a, const Near& b) { return a.gap_m < b.gap_m; };
  std::stable_sort(walls_.begin(), walls_.end(), nearer);
  std::stable_sort(agents_.begin(), agents_.end(), nearer);
  if (agents_.size() > static_cast<std::size_t>(*max_neighbors))
    agents_.resize(static_cast<std::size_t>(*max_neighbors));
}

double OrcaController::error_m() const {
  double gap_m = tracking_error / share_of_gap;
  if (!walls_.empty()) gap_m = std::min(gap_m, walls_.front().gap_m);
  if (!agents_.empty()) gap_m = std::min(gap_m, agents_.front().gap_m);
  return std::max(share_of_gap * gap_m, least_error_m);
}

// Static obstacles permit the half-plane nearest to the zero velocity: a convex obstacle lies behind the tangent at its
// closest point, so the robot may approach it by its gap within the horizon.
void OrcaController::add_walls(const Observation& now, double margin_m) {
  Footprint disc = now.footprint;
  disc.part_count = 0;
  for (const Near& wall : walls_) {
    const Vec2 away = separation(disc, {now.pose.x, now.pose.y, 0.0}, *wall.obstacle, 0.0).gradient;
    const double approach = std::max(wall.gap_m - margin_m, 0.0) / time_horizon_obst;
    planes_.push_back(half_plane(-approach * away, away));
  }
}

// What the drive permits.
void OrcaController::add_drive(const Observation& now, double margin_m) {
  if (!holonomic_) {
    orca::append_allowed(follower(now), margin_m, now.pose.theta, planes_);
    return;
  }
  const Vec2 ahead = toolkit::from_angle(now.pose.theta);
  const Vec2 left = toolkit::perpendicular(ahead);
  planes_.push_back(half_plane(now.limits.v_max * ahead, -ahead));
  planes_.push_back(half_plane(now.limits.v_min * ahead, ahead));
  planes_.push_back(half_plane(now.limits.v_y_max * left, -left));
  planes_.push_back(half_plane(-now.limits.v_y_max * left, left));
}

void OrcaController::add_agents(const Observation& now, double margin_m) {
  const Vec2 velocity = velocity_of(now);
  for (const Near& near : agents_) {
    const Obstacle& agent = *near.obstacle;
    const Vec2 apart = agent.center - toolkit::position(now.pose);
    if (apart == Vec2{0.0, 0.0}) continue;
    const bool shares = agent.is_robot && agent.velocity != Vec2{0.0, 0.0};
    const reciprocal::Encounter encounter = {apart, velocity - agent.velocity,
                                             now.footprint.radius_m + agent.radius_m + margin_m};
    planes_.push_back(reciprocal::give_way(reciprocal::escape(encounter, time_horizon, seconds(now.dt_ns)), velocity,
                                           shares ? robots_share : whole_share));
  }
}

// Along the path, and no faster than the robot can stop at its end. A differential drive is to face its way before it
// gets there: faster, it would orbit the end.
Vec2 OrcaController::preferred(const Observation& now) const {
  const Vec2 robot = toolkit::position(now.pose);
  const Vec2 way = tracker_.point_at_distance(robot, lookahead_dist) - robot;
  const double remaining_m = std::max(tracker_.remaining_m(), toolkit::distance(robot, tracker_.stop().position));
  double speed = std::min<double>(now.limits.v_max, stopping_speed(remaining_m, now.limits.a_max, seconds(now.dt_ns)));
  if (!holonomic_ && way != Vec2{0.0, 0.0}) {
    const double angle = toolkit::difference(now.pose.theta, std::atan2(way.y, way.x));
    if (angle != 0.0) speed = std::min(speed, remaining_m * orca::arc_rate(follower(now), angle) / angle);
  }
  return speed * toolkit::normalized(way);
}

orca::Follower OrcaController::follower(const Observation& now) const {
  return {now.limits.v_max, now.limits.omega_max, now.limits.alpha_max, alignment_time};
}

// Straight behind, rounding would choose the side to turn to, another one at each tick: it is that of what is wanted.
Command OrcaController::follow(const Observation& now, Vec2 velocity, Vec2 wanted) const {
  constexpr double behind_rad = 1e-3;
  const double period_s = seconds(now.dt_ns);
  const double speed = toolkit::norm(velocity);
  if (speed < 1e-6) return braking(now);
  double angle = toolkit::difference(now.pose.theta, std::atan2(velocity.y, velocity.x));
  if (std::abs(angle) > toolkit::pi - behind_rad)
    angle = std::copysign(angle, toolkit::difference(now.pose.theta, std::atan2(wanted.y, wanted.x)));
  Command command;
  command.v_x = std::clamp(toward(now.velocity.v_x, orca::arc_speed(speed, angle), now.limits.a_max * period_s), 0.0,
                           now.limits.v_max);
  command.omega = turning_rate(angle, now);
  return command;
}

Command OrcaController::translate(const Observation& now, Vec2 velocity) const {
  const Vec2 wanted = toolkit::rotate(velocity, -now.pose.theta);
  const double reach = now.limits.a_max * seconds(now.dt_ns);
  Command command;
  command.v_x = std::clamp(toward(now.velocity.v_x, wanted.x, reach), now.limits.v_min, now.limits.v_max);
  command.v_y = std::clamp(toward(now.velocity.v_y, wanted.y, reach), -now.limits.v_y_max, now.limits.v_y_max);
  const double angle = toolkit::norm(wanted) > 0.05 ? std::atan2(wanted.y, wanted.x) : 0.0;
  command.omega = turning_rate(angle, now);
  return command;
}

}  // namespace dmrp::controllers
