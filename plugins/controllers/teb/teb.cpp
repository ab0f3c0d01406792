// SPDX-License-Identifier: MIT
#include "controllers/teb/teb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <string>

#include "controllers/teb/band_command.hpp"

namespace dmrp::controllers {

namespace {

// Kept free around the footprint where poses are checked: about what a cell's centre says less than its edge.
constexpr double padding_m = 0.03;

// Below this the robot counts as standing.
constexpr double standing_m_s = 0.05;
constexpr double standing_rad_s = 0.05;

// As near as this to where the way ends before somebody, the robot waits.
constexpr double wait_within_m = 0.1;

// How far before them the way ends.
constexpr double stand_back_m = 0.3;

// Turning in place while no band is feasible: toward the path so far ahead, from the first angle to the second.
constexpr double face_ahead_m = 0.8;
constexpr double turn_begin_rad = 0.5;

// Cells that an agent explains lie so near to its disc.
constexpr double agent_cells_m = 0.2;

// After so many cycles in a row without a feasible band the horizon shrinks less.
constexpr int shrink_less_after = 10;

}  // namespace

Descriptor Teb::describe() {
  return Descriptor("dmrp.controller.teb", "TEB", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("optimises timed elastic bands, one for each way round the obstacles, and follows the cheapest")
      .source(
          "Roesmann, Hoffmann, Bertram: Integrated online trajectory planning and optimization in distinctive "
          "topologies, Robotics and Autonomous Systems 88 (2017); as ROS's teb_local_planner")
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Teb::start(const World& world, std::uint64_t seed) {
  costmap_ = extension<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  clusters_ = extension<dmrp_obstacle_clusters>(DMRP_EXT_OBSTACLE_CLUSTERS);
  if (!costmap_ || !clusters_) {
    set_error("the host has no " DMRP_EXT_LOCAL_COSTMAP " or no " DMRP_EXT_OBSTACLE_CLUSTERS);
    return Status::error;
  }
  annotate_ = extension<dmrp_annotate>(DMRP_EXT_ANNOTATE);
  tracker_.clear();
  at_goal_.reset();
  obstacles_.clear();
  const double periods = oscillation_filter_duration / seconds(world->control_period_ns);
  via_points_.reserve(64);
  oscillation_.reset(static_cast<std::size_t>(std::max(2.0, std::round(periods))));
  planner_.start(band_tuning(), class_tuning(), {force_reinit_new_goal_dist, force_reinit_new_goal_angular}, seed);
  preferred_turn_ = teb::Turn::any;
  infeasible_in_a_row_ = 0;
  was_infeasible_ = false;
  is_closed_ = false;
  return Status::ok;
}

void Teb::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
}

Status Teb::step(const Observation& now, Command& command) {
  command = braking(now);
  tracker_.update(now);
  if (tracker_.empty()) return Status::ok;
  if (at_goal_.reached(tracker_.stop(), now)) {
    planner_.clear();
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  watch_for_oscillation(now);
  const CostmapView map(*costmap_->costmap(costmap_));
  const Status status = drive(now, map, command);
  oscillation_.note(command, now.limits);
  return status;
}

bool Teb::was_infeasible_lately(std::int64_t t_ns) const {
  return was_infeasible_ && seconds(t_ns - infeasible_ns_) < shrink_horizon_min_duration;
}

// Half as far for a while after no way was feasible; a little farther again where that does not help either.
double Teb::look_ahead_m(std::int64_t t_ns) const {
  const double whole_m = max_global_plan_lookahead_dist;
  if (!shrink_horizon_backup || !was_infeasible_lately(t_ns)) return whole_m;
  return infeasible_in_a_row_ >= shrink_less_after ? 0.75 * whole_m : 0.5 * whole_m;
}

void Teb::watch_for_oscillation(const Observation& now) {
  if (!oscillation_recovery) return;
  const bool is_recent =
      preferred_turn_ != teb::Turn::any && seconds(now.t_ns - oscillated_ns_) < oscillation_recovery_min_duration;
  if (oscillation_.is_oscillating(oscillation_v_eps, oscillation_omega_eps)) {
    if (!is_recent) preferred_turn_ = now.applied.omega > 0.0 ? teb::Turn::left : teb::Turn::right;
    oscillated_ns_ = now.t_ns;
  } else if (!is_recent) {
    preferred_turn_ = teb::Turn::any;
  }
}

Status Teb::drive(const Observation& now, const CostmapView& map, Command& command) {
  FootprintCheck footprint(map, now.footprint, padding_m, now.pose);
  const bool is_cut = look_along_path(now, map, footprint);
  obstacles_.gather(now, clusters_->clusters(clusters_));
  // as near as it gets to somebody who stands where the robot has to stop
  const Vec2 goal = toolkit::position(path_.goal());
  if (is_cut && toolkit::distance(toolkit::position(now.pose), goal) < wait_within_m) {
    planner_.clear();
    return wait(now, footprint, command);
  }

  planner_.plan(task(now, is_cut));
  while (planner_.best() && !is_feasible(*planner_.best(), now, footprint)) planner_.drop_best();
  if (planner_.best()) {
    command = teb::first_command(*planner_.best(), static_cast<std::size_t>(*control_look_ahead_poses), now);
    if (slow_down(command, now, footprint)) {
      infeasible_in_a_row_ = 0;
      annotate(*planner_.best());
      return Status::ok;
    }
  }
  planner_.clear();
  was_infeasible_ = true;
  infeasible_ns_ = now.t_ns;
  ++infeasible_in_a_row_;
  return wait(now, footprint, command);
}

// True where somebody stands where the way would end: it ends before them then, with room to turn and go round.
bool Teb::look_along_path(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  path_.look(tracker_, now, map, look_ahead_m(now.t_ns));
  const std::size_t whole = path_.points().size();
  path_.retreat(footprint);
  const std::size_t free = std::min(path_.points().size(), reachable_points(now, map, footprint));
  if (free == whole) return false;
  path_.look(tracker_, now, map, std::max(0.0, PathAhead::spacing_m * static_cast<double>(free - 1) - stand_back_m));
  return true;
}

// How many points of the path ahead, from the robot on, end where there is a way to. Looked at once no band was feasible,
// and for as long as the way is closed: else a robot before a wall across its way would turn to and fro for ever.
std::size_t Teb::reachable_points(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  const std::vector<Vec2>& points = path_.points();
  if (!is_closed_ && !was_infeasible_lately(now.t_ns)) return points.size();
  is_closed_ = false;
  const bool is_free = std::all_of(points.begin(), points.end(), [&](Vec2 point) {
    return footprint.cost(arc_state({point.x, point.y, path_.goal().theta})) != in_collision;
  });
  if (is_free) return points.size();
  const double needed_m = now.footprint.inscribed_radius_m + padding_m;
  guide_.spread(map, toolkit::position(now.pose), needed_m, needed_m);
  std::size_t count = points.size();
  while (count > 1 && !guide_.reaches(map, points[count - 1])) --count;
  is_closed_ = count < points.size();
  return count;
}

teb::Task Teb::task(const Observation& now, bool is_cut) {
  via_points_.clear();
  const std::vector<Vec2>& points = path_.points();
  if (global_plan_viapoint_sep > 0.0) {
    const auto stride = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(global_plan_viapoint_sep / PathAhead::spacing_m)));
    for (std::size_t i = stride; i + 1 < points.size(); i += stride) via_points_.push_back(points[i]);
  }
  teb::Task task;
  task.t_ns = now.t_ns;
  task.start = now.pose;
  // the last turn to the heading asked for is made in place, after arriving along the path
  task.goal = path_.goal();
  if (path_.has_heading() && points.size() > 1)
    task.goal.theta = toolkit::bearing(points[points.size() - 2], points.back());
  task.path = &points;
  task.scene = {&now.limits,    &now.footprint, &obstacles_.all(),
                &via_points_,   now.velocity,   is_cut || path_.ends_at_stop(),
                preferred_turn_};
  return task;
}

bool Teb::is_feasible(const teb::TimedElasticBand& band, const Observation& now, FootprintCheck& footprint) const {
  const std::size_t last = std::min(static_cast<std::size_t>(*feasibility_check_no_poses), band.size() - 1);
  double ahead_s = 0.0;
  for (std::size_t i = 0; i < last; ++i) {
    const double middle_s = ahead_s + 0.5 * band.dt[i];
    if (!is_free(teb::pose_at(band, middle_s), middle_s, now, footprint)) return false;
    ahead_s += band.dt[i];
    if (!is_free(band.pose(i + 1), ahead_s, now, footprint)) return false;
  }
  return true;
}

// On the costmap, agents stand where they are now. Where one of them is what is in the way, it counts where it will be.
bool Teb::is_free(const Pose& pose, double ahead_s, const Observation& now, FootprintCheck& footprint) const {
  if (footprint.cost(arc_state(pose)) != in_collision) return true;
  if (!include_dynamic_obstacles) return false;
  bool is_agents = false;
  for (const Obstacle& obstacle : obstacles_.all()) {
    if (least_distance(now.footprint, toolkit::position(pose), obstacle, ahead_s) < padding_m &&
        separation(now.footprint, pose, obstacle, ahead_s).distance_m < padding_m)
      return false;
    is_agents = is_agents || (obstacle.velocity != Vec2{0.0, 0.0} &&
                              least_distance(now.footprint, toolkit::position(pose), obstacle, 0.0) < agent_cells_m);
  }
  return is_agents;
}

// Whether the robot, having followed the command for one period, can come to rest before anything.
bool Teb::stops_in_time(const Command& command, const Observation& now, FootprintCheck& footprint) const {
  const double period_s = seconds(now.dt_ns);
  ArcState at = arc_state(now.pose);
  double v = command.v_x;
  double omega = command.omega;
  for (double ahead_s = period_s; ahead_s < 10.0; ahead_s += period_s) {
    ArcStepper(v, omega, period_s).step(at);
    if (!is_free({at.x, at.y, std::atan2(at.sin_theta, at.cos_theta)}, ahead_s, now, footprint)) return false;
    if (v == 0.0 && omega == 0.0) break;
    v = toward(0.0, v, std::max(0.0, std::abs(v) - now.limits.a_max * period_s));
    omega = toward(0.0, omega, std::max(0.0, std::abs(omega) - now.limits.alpha_max * period_s));
  }
  return true;
}

// Lowers the speed until the robot could stop in time. False where not even braking is enough.
bool Teb::slow_down(Command& command, const Observation& now, FootprintCheck& footprint) const {
  const double least = toward(now.velocity.v_x, 0.0, now.limits.a_max * seconds(now.dt_ns));
  const double wanted = command.v_x;
  for (const double share : {1.0, 0.5, 0.0}) {
    command.v_x = least + share * (wanted - least);
    if (stops_in_time(command, now, footprint)) return true;
  }
  return false;
}

// No way is feasible. A moving robot brakes, as the host does where there is no solution; a standing one waits, and
// turns to where the path leads, so that there is a way once that is free.
Status Teb::wait(const Observation& now, FootprintCheck& footprint, Command& command) {
  command = braking(now);
  if (std::abs(now.velocity.v_x) > standing_m_s) {
    set_error("no feasible band: braking");
    return Status::no_solution;
  }
  const Vec2 ahead = tracker_.point_at_distance(toolkit::position(now.pose), face_ahead_m);
  const double angle = toolkit::difference(now.pose.theta, toolkit::bearing(toolkit::position(now.pose), ahead));
  const bool is_turning = std::abs(now.velocity.omega) > standing_rad_s;
  if (std::abs(angle) < (is_turning ? 0.2 : 1.0) * turn_begin_rad) return Status::ok;
  Command turn = command;
  turn.omega = turning_rate(angle, now);
  if (footprint.arc_cost(now.pose, 0.0, turn.omega, 0.5, 5) != in_collision) command = turn;
  return Status::ok;
}

void Teb::annotate(const teb::TimedElasticBand& best) const {
  if (!annotate_ || !annotate_->wanted(annotate_)) return;
  std::array<dmrp_pose, 32> poses;
  const auto tell = [&](const teb::TimedElasticBand& band, std::uint32_t role) {
    const double step_s = band.duration_s() / static_cast<double>(poses.size() - 1);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = teb::pose_at(band, static_cast<double>(i) * step_s);
    annotate_->trajectory(annotate_, role, poses.data(), static_cast<std::uint32_t>(poses.size()),
                          static_cast<std::int64_t>(step_s * 1e9));
  };
  for (std::size_t i = 0; i < planner_.size(); ++i)
    if (&planner_.band(i) != &best) tell(planner_.band(i), DMRP_ANNOTATE_CANDIDATE);
  tell(best, DMRP_ANNOTATE_PREDICTED);
  annotate_->note(
      annotate_,
      ("iterations " + std::to_string(planner_.iterations()) + ", bands " + std::to_string(planner_.size())).c_str());
}

}  // namespace dmrp::controllers
