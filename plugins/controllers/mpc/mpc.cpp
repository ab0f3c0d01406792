// SPDX-License-Identifier: MIT
#include "controllers/mpc/mpc.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

namespace {

// Where the solver's barrier begins: far from a solution, near one, and at one whose surroundings changed a little.
constexpr double barrier_cold = 1e-1;
constexpr double barrier_warm = 1e-2;
constexpr double barrier_again = 1e-3;

// Ways over the costmap ask for so much beyond the inscribed radius, and prefer more.
constexpr double needed_beyond_m = 0.02;
constexpr double easy_beyond_m = 0.15;

// A predicted pose nearer to an obstacle than this is no way to go (unless the robot stands as near already).
constexpr double least_gap_m = 0.02;

// How far the dynamics may be off.
constexpr double most_infeasible = 0.05;

// Below this the robot counts as standing.
constexpr double standing_m_s = 0.05;

// So near to where the way is cut off, the robot waits.
constexpr double wait_within_m = 0.1;

// Steps shorter than both are waiting.
constexpr double idle_m = 0.01;
constexpr double idle_rad = 0.02;

// Room for this many obstacles before anything grows.
constexpr std::size_t usual_obstacles = 256;
constexpr std::size_t usual_bucket = 512;

}  // namespace

Descriptor Mpc::describe() {
  return Descriptor("dmrp.controller.mpc", "MPC", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("minimum-time trajectories by nonlinear model predictive control, solved by an interior point method")
      .source(
          "Rösmann, Makarow, Bertram: Online Motion Planning Based on Nonlinear Model Predictive Control with "
          "Non-Euclidean Rotation Groups, ECC 2021; as in ROS's mpc_local_planner")
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Mpc::start(const World&, std::uint64_t) {
  costmap_ = extension<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  clusters_ = extension<dmrp_obstacle_clusters>(DMRP_EXT_OBSTACLE_CLUSTERS);
  if (!costmap_ || !clusters_) {
    set_error("the host has no " DMRP_EXT_LOCAL_COSTMAP " or no " DMRP_EXT_OBSTACLE_CLUSTERS);
    return Status::error;
  }
  if (min_grid_size > max_grid_size) {
    set_error("min_grid_size is greater than max_grid_size");
    return Status::error;
  }
  if (min_dt > max_dt) {
    set_error("min_dt is greater than max_dt");
    return Status::error;
  }
  annotate_ = extension<dmrp_annotate>(DMRP_EXT_ANNOTATE);
  tracker_.clear();
  at_goal_.reset();
  has_trajectory_ = false;
  const auto states = static_cast<std::size_t>(std::max<std::int64_t>(max_grid_size, grid_size_ref));
  constexpr std::size_t bounds_a_state = 10;
  solver_.reserve(states, states * (bounds_a_state + mpc::most_obstacles_a_state + 2));
  association_.reserve(usual_obstacles);
  guide_.reserve(usual_bucket);
  problem_ = {};
  problem_.obstacles.resize(states);
  for (auto& list : problem_.obstacles) list.reserve(mpc::most_obstacles_a_state + 2);
  seen_.reserve(usual_obstacles);
  guess_.reserve(usual_obstacles);
  way_.reserve(usual_obstacles);
  trajectory_.reserve(states);
  waiting_.reserve(states);
  return Status::ok;
}

void Mpc::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
}

Status Mpc::step(const Observation& now, Command& command) {
  command = braking(now);
  tracker_.update(now);
  if (tracker_.empty()) return Status::ok;
  if (at_goal_.reached(tracker_.stop(), now)) {
    has_trajectory_ = false;
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  const CostmapView map(*costmap_->costmap(costmap_));
  FootprintCheck footprint(map, now.footprint, 0.0, now.pose);
  pose_problem(now, map);
  const bool is_standing = std::abs(now.velocity.v_x) < standing_m_s;
  if (!choose_goal(now, map, footprint)) {
    // as near as it gets to something that stands across the whole way: wait
    has_trajectory_ = false;
    if (is_standing && at_goal_.settles(tracker_.stop(), now)) command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  has_trajectory_ = plan(now, map, footprint);
  if (!has_trajectory_) {
    if (is_standing) return Status::ok;
    set_error("every trajectory found runs into an obstacle");
    return Status::no_solution;
  }
  if (is_standing) skip_waiting(now, footprint);
  const double period_s = seconds(now.dt_ns);
  const mpc::Control& control = trajectory_.controls[0];
  command.v_x =
      std::clamp(toward(now.velocity.v_x, control.v, now.limits.a_max * period_s), now.limits.v_min, now.limits.v_max);
  command.omega = std::clamp(toward(now.velocity.omega, control.omega, now.limits.alpha_max * period_s),
                             -now.limits.omega_max, now.limits.omega_max);
  annotate();
  return Status::ok;
}

void Mpc::pose_problem(const Observation& now, const CostmapView& map) {
  obstacles_.gather(now, clusters_->clusters(clusters_));
  seen_ = obstacles_.all();
  // what a lethal cell stands for may lie beyond its centre, and a cluster within some tolerance of that
  for (Obstacle& obstacle : seen_)
    if (!obstacle.is_agent) obstacle.radius_m += map.resolution_m();
  if (!enable_dynamic_obstacles)
    for (Obstacle& obstacle : seen_) obstacle.velocity = {0.0, 0.0};
  const Limits& limits = now.limits;
  problem_.start = {now.pose.x, now.pose.y, now.pose.theta};
  problem_.before = {std::clamp(now.applied.v_x, limits.v_min, limits.v_max),
                     std::clamp(now.applied.omega, -limits.omega_max, limits.omega_max)};
  problem_.v_min = limits.v_min;
  problem_.v_max = limits.v_max;
  problem_.omega_max = limits.omega_max;
  problem_.a_max = limits.a_max;
  problem_.alpha_max = limits.alpha_max;
  problem_.dt_min_s = min_dt;
  problem_.dt_max_s = max_dt;
  problem_.min_obstacle_dist_m = min_obstacle_dist;
  problem_.footprint = &now.footprint;
  guide_spread_ = false;
  iterations_now_ = 0;
}

// The end of the path ahead; where something stands on the path, the last point that there is a way to. False where
// that is where the robot stands.
bool Mpc::choose_goal(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  ahead_.look(tracker_, now, map, max_global_plan_lookahead_dist);
  const std::vector<Vec2>& points = ahead_.points();
  problem_.goal = {ahead_.goal().x, ahead_.goal().y, ahead_.goal().theta};
  problem_.ends_at_rest = ahead_.ends_at_stop();
  problem_.fixes_heading = !ahead_.ends_at_stop() || ahead_.has_heading();
  way_ = points;
  const bool is_free = std::all_of(points.begin(), points.end(), [&](Vec2 point) {
    return footprint.cost(arc_state({point.x, point.y, problem_.goal.theta})) != in_collision;
  });
  if (is_free) return true;

  spread_guide(now, map);
  std::size_t last = points.size() - 1;
  while (last > 0 && !guide_.reaches(map, points[last])) --last;
  const Vec2 robot = toolkit::position(now.pose);
  if (!guide_.reaches(map, points[last]) ||
      (last + 1 < points.size() && toolkit::distance(robot, points[last]) < wait_within_m))
    return false;
  if (last + 1 < points.size()) {
    problem_.goal.x = points[last].x;
    problem_.goal.y = points[last].y;
    problem_.ends_at_rest = true;
    problem_.fixes_heading = false;
  }
  guide_.way_to(map, points[last], way_);
  return true;
}

void Mpc::spread_guide(const Observation& now, const CostmapView& map) {
  if (guide_spread_) return;
  const double radius_m = now.footprint.inscribed_radius_m;
  guide_.spread(map, toolkit::position(now.pose), radius_m + needed_beyond_m, radius_m + easy_beyond_m);
  guide_spread_ = true;
}

// From what is left of the last trajectory; where that leads nowhere, from anew.
bool Mpc::plan(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  if (continue_last(now) && is_feasible(now, footprint)) return true;
  if (plan_along(now, footprint)) return true;
  return plan_by_guide(now, map, footprint);
}

bool Mpc::continue_last(const Observation& now) {
  if (!has_trajectory_ || !warm_start) return false;
  const mpc::State& end = trajectory_.states.back();
  if (std::hypot(problem_.goal.x - end.x, problem_.goal.y - end.y) > force_reinit_new_goal_dist) return false;
  if (problem_.fixes_heading &&
      std::abs(toolkit::difference(end.theta, problem_.goal.theta)) > force_reinit_new_goal_angular)
    return false;
  guess_.shifted(problem_, seconds(now.dt_ns), trajectory_);
  optimise(barrier_warm);
  return true;
}

bool Mpc::plan_along(const Observation& now, FootprintCheck& footprint) {
  guess_.along(problem_, way_, static_cast<std::size_t>(*grid_size_ref), trajectory_);
  optimise(barrier_cold);
  return is_feasible(now, footprint);
}

bool Mpc::plan_by_guide(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  if (guide_spread_) return false;  // that is the way tried already
  spread_guide(now, map);
  const Vec2 goal = {problem_.goal.x, problem_.goal.y};
  if (!guide_.reaches(map, goal)) return false;
  guide_.way_to(map, goal, way_);
  return plan_along(now, footprint);
}

void Mpc::optimise(double barrier_start) {
  mpc::SolverSettings settings;
  settings.iterations = static_cast<int>(*iterations);
  settings.tolerance = tol;
  settings.barrier_start = barrier_start;
  const mpc::AssociationRule rule = {force_inclusion_dist, cutoff_dist};
  for (std::int64_t i = 0; i < outer_ocp_iterations; ++i) {
    const std::size_t size = adapted_size();
    const bool is_resized = size != trajectory_.size();
    if (is_resized) guess_.resized(problem_, size, trajectory_);
    const bool differs = association_.associate(trajectory_, seen_, rule, problem_);
    if (i > 0 && !is_resized && !differs) break;
    report_ = solver_.solve(problem_, settings, trajectory_);
    iterations_now_ += report_.iterations;
    settings.barrier_start = barrier_again;
  }
}

std::size_t Mpc::adapted_size() const {
  const std::size_t size = trajectory_.size();
  const auto least = static_cast<std::size_t>(*min_grid_size);
  const auto most = static_cast<std::size_t>(*max_grid_size);
  if (trajectory_.dt_s > dt_ref * (1.0 + dt_hyst_ratio) && size < most) return size + 1;
  if (trajectory_.dt_s < dt_ref * (1.0 - dt_hyst_ratio) && size > least) return size - 1;
  return size;
}

bool Mpc::is_feasible(const Observation& now, FootprintCheck& footprint) const {
  if (!(report_.infeasibility < most_infeasible)) return false;
  double least_m = least_gap_m;
  for (const Obstacle& obstacle : seen_)
    least_m = std::min(least_m, separation(now.footprint, now.pose, obstacle, 0.0).distance_m - 0.005);
  const std::size_t states = trajectory_.size();
  const std::size_t checked =
      collision_check_no_poses < 0 ? states : std::min(states, static_cast<std::size_t>(*collision_check_no_poses) + 1);
  for (std::size_t k = 1; k < checked; ++k)
    if (!is_free(now, trajectory_.states[k], static_cast<double>(k) * trajectory_.dt_s, least_m, footprint))
      return false;
  return true;
}

// A trajectory may begin by standing: the time step is one for all, and a shorter one can be worse before it is better.
// Every period anew, that is standing for ever. What follows the wait is as good from now on, unless somebody has to be
// let past.
void Mpc::skip_waiting(const Observation& now, FootprintCheck& footprint) {
  const mpc::State& start = trajectory_.states.front();
  std::size_t waits = 0;
  while (waits + 2 < trajectory_.size()) {
    const mpc::State& next = trajectory_.states[waits + 1];
    if (std::hypot(next.x - start.x, next.y - start.y) > idle_m || std::abs(next.theta - start.theta) > idle_rad) break;
    ++waits;
  }
  if (waits == 0) return;
  waiting_ = trajectory_;
  trajectory_.states.erase(trajectory_.states.begin(), trajectory_.states.begin() + static_cast<std::ptrdiff_t>(waits));
  trajectory_.controls.erase(trajectory_.controls.begin(),
                             trajectory_.controls.begin() + static_cast<std::ptrdiff_t>(waits));
  if (!is_feasible(now, footprint)) std::swap(trajectory_, waiting_);
}

// Against obstacles where they will be, and on the costmap, but for where the agents are that it shows as of now.
bool Mpc::is_free(const Observation& now, const mpc::State& state, double ahead_s, double least_m,
                  FootprintCheck& footprint) const {
  const Pose pose = {state.x, state.y, state.theta};
  bool beside_agent = false;
  for (const Obstacle& obstacle : seen_) {
    if (least_distance(now.footprint, {state.x, state.y}, obstacle, ahead_s) < least_m &&
        separation(now.footprint, pose, obstacle, ahead_s).distance_m < least_m)
      return false;
    beside_agent =
        beside_agent || (obstacle.is_agent && least_distance(now.footprint, {state.x, state.y}, obstacle, 0.0) < 0.15);
  }
  return beside_agent || footprint.cost(arc_state(pose)) != in_collision;
}

void Mpc::annotate() const {
  if (!annotate_ || !annotate_->wanted(annotate_)) return;
  constexpr std::size_t most = 200;
  std::array<Pose, most> poses;
  const std::size_t count = std::min(most, trajectory_.size());
  for (std::size_t k = 0; k < count; ++k) {
    const mpc::State& state = trajectory_.states[k];
    poses[k] = {state.x, state.y, toolkit::wrap(state.theta)};
  }
  annotate_->trajectory(annotate_, DMRP_ANNOTATE_PREDICTED, poses.data(), static_cast<std::uint32_t>(count),
                        static_cast<std::int64_t>(trajectory_.dt_s * 1e9));
  std::array<char, 32> note;
  std::snprintf(note.data(), note.size(), "iterations %d", iterations_now_);
  annotate_->note(annotate_, note.data());
}

}  // namespace dmrp::controllers
