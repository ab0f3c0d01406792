// SPDX-License-Identifier: MIT
#include "controllers/mppi/mppi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

namespace {

// Samples turn by less than this in a step: the series of the rollout are exact up to here.
constexpr double most_turn_rad = 1.0;

constexpr double spacing_m = static_cast<double>(mppi::path_spacing_m);

}  // namespace

Descriptor Mppi::describe() {
  return describe_controller("dmrp.controller.mppi", "MPPI")
      .summary("samples two thousand trajectories and drives their mean, weighted by what critics say of them")
      .source(
          "Williams, Drews, Goldfain, Rehg, Theodorou: Information theoretic model predictive control, IEEE "
          "Transactions on Robotics 34 (2018); critics as in ROS's nav2_mppi_controller")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Mppi::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  clusters_ = &extension<dmrp_obstacle_clusters>();
  if (!choose_critics()) return Status::error;
  const Robot& robot = start.world.robots()[static_cast<std::uint32_t>(start.robot)];
  if (robot.limits->omega_max * model_dt > most_turn_rad) {
    set_error("model_dt is too long for this robot: it turns by more than 1 rad in a step");
    return Status::error;
  }
  model_.steps = time_steps;
  model_.step_s = static_cast<float>(model_dt);
  model_.holonomic = robot.kinematics == DMRP_KINEMATICS_HOLONOMIC;
  model_.deviation = {static_cast<float>(vx_std), static_cast<float>(vy_std), static_cast<float>(wz_std)};
  read_limits(*robot.limits);
  model_.slowest_m_s = robot.limits->v_min == 0.0 && sample_forward ? 0.0f : mppi::Model{}.slowest_m_s;
  begin(start);
  noise_.start(start.seed, start.robot);
  cycle_ = 0;
  optimizer_.start(model_, {static_cast<float>(temperature), static_cast<float>(gamma)});
  batch_.resize(batch_size, model_);
  costs_.resize(static_cast<std::size_t>(batch_.samples()));
  return Status::ok;
}

bool Mppi::choose_critics() {
  for (mppi::Critic& critic : all_critics) critic.is_chosen = false;
  for (const std::string& name : *critics) {
    const auto at = std::find_if(all_critics.begin(), all_critics.end(),
                                 [&](const mppi::Critic& critic) { return critic.name == name; });
    if (at == all_critics.end()) {
      set_error("critics: there is no " + name);
      return false;
    }
    at->is_chosen = true;
  }
  return true;
}

void Mppi::read_limits(const dmrp::Limits& limits) {
  model_.limits = {static_cast<float>(limits.v_min),   static_cast<float>(limits.v_max),
                   static_cast<float>(limits.v_y_max), static_cast<float>(limits.omega_max),
                   static_cast<float>(limits.a_max),   static_cast<float>(limits.alpha_max)};
}

Status Mppi::control(const Observation& now, Command& command) {
  // a path may pass its own end before it ends there
  const bool near_end = tracker_.remaining_m() <= std::max(tracker_.stop().tolerance_m, 0.5);
  if (near_end && at_goal_.reached(tracker_.stop(), now)) {
    optimizer_.reset();
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  look(now);
  if (!optimize(now)) {
    if (stands(now.velocity)) return Status::ok;
    set_error("every sampled trajectory runs into an obstacle");
    return Status::no_solution;
  }
  optimizer_.smooth();
  annotate(now);
  // steps driven until the next cycle
  const int driven = static_cast<int>(std::lround(seconds(now.dt_ns) / model_dt));
  command = first_command(now, std::clamp(driven, 1, model_.steps));
  optimizer_.shift(std::min(driven, model_.steps - 1));
  return Status::ok;
}

void Mppi::look(const Observation& now) {
  const dmrp_costmap* map = costmap_->costmap(costmap_, now.robot);
  moving_.clear();
  if (include_dynamic_obstacles && !now.agents.empty()) {
    obstacle_set_.gather(now, clusters_->clusters(clusters_, now.robot));
    const std::vector<Obstacle>& all = obstacle_set_.all();
    std::copy_if(all.begin(), all.end(), std::back_inserter(moving_), mppi::is_moving);
    if (!moving_.empty()) map = &still_costmap_.copy(*map, all);
  }
  field_.look(*map, now.footprint, footprint_padding, now.pose, moving_);
  look_at_path(now);
  const StopPoint& stop = tracker_.stop();
  const Vec2 to_goal = stop.position - toolkit::position(now.pose);
  scene_.theta = static_cast<float>(now.pose.theta);
  scene_.goal_x = static_cast<float>(to_goal.x);
  scene_.goal_y = static_cast<float>(to_goal.y);
  scene_.goal_theta = static_cast<float>(stop.heading);
  scene_.goal_distance_m = static_cast<float>(toolkit::norm(to_goal));
  scene_.goal_tolerance_m = static_cast<float>(stop.tolerance_m);
}

// The path ahead, up to prune_distance and to the border of the costmap's window.
void Mppi::look_at_path(const Observation& now) {
  scene_.path_x.clear();
  scene_.path_y.clear();
  scene_.path_theta.clear();
  scene_.path_free.clear();
  const Vec2 robot = toolkit::position(now.pose);
  const double length_m = std::min<double>(prune_distance, tracker_.remaining_m());
  const auto count = static_cast<int>(std::ceil(length_m / spacing_m));
  double heading = now.pose.theta;
  for (int i = 0; i <= count; ++i) {
    const double ahead_m = std::min(i * spacing_m, length_m);
    const double arc_m = tracker_.progress_m() + ahead_m;
    const Vec2 point = tracker_.point_at(arc_m);
    if (i > 0 && !field_.contains(point)) break;
    const double next_heading = tracker_.heading_at(arc_m, heading);
    const bool turns_back = std::abs(toolkit::difference(heading, next_heading)) > 0.5 * toolkit::pi;
    if (enforce_path_inversion && turns_back && ahead_m > inversion_xy_tolerance) break;
    heading = next_heading;
    scene_.path_x.push_back(static_cast<float>(point.x - robot.x));
    scene_.path_y.push_back(static_cast<float>(point.y - robot.y));
    scene_.path_theta.push_back(static_cast<float>(heading));
    scene_.path_free.push_back(!field_.is_blocked(point));
  }
}

bool Mppi::optimize(const Observation& now) {
  const mppi::Velocity velocity = {static_cast<float>(now.velocity.v_x), static_cast<float>(now.velocity.v_y),
                                   static_cast<float>(now.velocity.omega)};
  for (int attempt = 0; attempt <= retry_attempt_limit; ++attempt) {
    bool any_is_free = true;
    for (int i = 0; i < iteration_count; ++i) {
      if (regenerate_noises) ++cycle_;
      mppi::sample(model_, optimizer_.sequence(), noise_, cycle_, velocity, scene_.theta, batch_);
      any_is_free = score();
      optimizer_.update(batch_, costs_);
    }
    if (any_is_free) return true;
    optimizer_.reset();
  }
  return false;
}

bool Mppi::score() {
  std::fill(costs_.begin(), costs_.end(), 0.0f);
  scene_.furthest = mppi::furthest_reached(batch_, scene_);
  mppi::CriticData data = {model_, batch_, scene_, field_, costs_};
  for (const mppi::Critic& critic : all_critics)
    if (critic.is_chosen) critic.add(data);
  return !data.all_collide;
}

// The velocity at the end of this period, and no faster than the robot can stop at its stop point.
Command Mppi::first_command(const Observation& now, int steps) const {
  const double period_s = seconds(now.dt_ns);
  const dmrp::Limits& limits = now.limits;
  const mppi::Velocity& wanted = optimizer_.sequence()[static_cast<std::size_t>(steps - 1)];
  const double straight_m = toolkit::distance(toolkit::position(now.pose), tracker_.stop().position);
  const double in_time = stopping_speed(std::max(tracker_.remaining_m(), straight_m), limits.a_max, period_s);
  const double speed = std::hypot(static_cast<double>(wanted.v_x), static_cast<double>(wanted.v_y));
  const double share = speed > in_time ? in_time / speed : 1.0;  // slower on the same arc
  const double reach = limits.a_max * period_s;
  Command command;
  command.v_x =
      std::clamp(toward(now.velocity.v_x, share * static_cast<double>(wanted.v_x), reach), limits.v_min, limits.v_max);
  command.v_y = std::clamp(toward(now.velocity.v_y, share * static_cast<double>(wanted.v_y), reach), -limits.v_y_max,
                           limits.v_y_max);
  command.omega =
      std::clamp(toward(now.velocity.omega, share * static_cast<double>(wanted.omega), limits.alpha_max * period_s),
                 -limits.omega_max, limits.omega_max);
  return command;
}

// The trajectory of the mean.
void Mppi::annotate(const Observation& now) const {
  if (!annotations_.wanted()) return;
  std::array<Pose, 257> poses;
  std::size_t count = 0;
  Pose at = now.pose;
  poses[count++] = at;
  for (const mppi::Velocity& v : optimizer_.sequence()) {
    const Vec2 local = Vec2{static_cast<double>(v.v_x), static_cast<double>(v.v_y)} * *model_dt;
    const Vec2 next = toolkit::to_world(at, local);
    at = {next.x, next.y, toolkit::wrap(at.theta + static_cast<double>(v.omega) * model_dt)};
    poses[count++] = at;
  }
  annotations_.trajectory(DMRP_ANNOTATE_PREDICTED, {poses.data(), count}, model_dt);
}

}  // namespace dmrp::controllers
