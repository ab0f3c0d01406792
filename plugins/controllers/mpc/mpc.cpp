// SPDX-License-Identifier: MIT
#include "controllers/mpc/mpc.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/mpc/place_to_wait.hpp"

namespace dmrp::controllers {

namespace {

// The first barrier of a solution: for a start far from a solution, and for one near a solution.
constexpr double barrier_cold = 1e-1;
constexpr double barrier_warm = 1e-2;

// The guide prefers this clearance beyond the inscribed radius.
constexpr double easy_beyond_m = 0.15;

// The largest residual of the constraints at which a solution is used.
constexpr double most_infeasible = 0.05;

// The robot waits within this distance of the point where its way is cut off.
constexpr double wait_within_m = 0.1;

// A trajectory that ends farther from the goal misses it.
constexpr double missed_m = 0.1;

// Initial sizes of buffers.
constexpr std::size_t usual_obstacles = 256;
constexpr std::size_t usual_bucket = 512;

}  // namespace

Descriptor Mpc::describe() {
  return describe_controller("dmrp.controller.mpc", "MPC")
      .summary("minimum-time trajectories by nonlinear model predictive control, solved by an interior point method")
      .source(
          "Rösmann, Makarow, Bertram: Online Motion Planning Based on Nonlinear Model Predictive Control with "
          "Non-Euclidean Rotation Groups, ECC 2021; as in ROS's mpc_local_planner")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC |
                  1u << DMRP_KINEMATICS_ACKERMANN)
      .flags(DMRP_FLAG_BACKWARDS)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .needs(DMRP_EXT_OBSTACLE_CLUSTERS)
      .uses(DMRP_EXT_ANNOTATE);
}

Status Mpc::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  clusters_ = &extension<dmrp_obstacle_clusters>();
  if (min_grid_size > max_grid_size) {
    set_error("min_grid_size is greater than max_grid_size");
    return Status::error;
  }
  if (min_dt > max_dt) {
    set_error("min_dt is greater than max_dt");
    return Status::error;
  }
  begin(start);
  steering_.reset();
  const auto states = static_cast<std::size_t>(std::max<int>(max_grid_size, grid_size_ref));
  constexpr std::size_t bounds_per_state = 12;
  constexpr std::size_t obstacles_per_state = mpc::most_obstacles_per_state + 2;
  optimizer_.reserve(states, states * (bounds_per_state + obstacles_per_state), usual_obstacles);
  guide_.reserve(usual_bucket);
  problem_ = {};
  problem_.obstacles.resize(states);
  for (auto& list : problem_.obstacles) list.reserve(obstacles_per_state);
  obstacles_.reserve(usual_obstacles);
  route_.reserve(usual_obstacles);
  trajectory_.reserve(states);
  trajectory_.clear();
  turn_.reset();
  return Status::ok;
}

Status Mpc::control(const Observation& now, Command& command) {
  steering_.update(now);
  if (at_goal_.arrived(tracker_.stop(), now)) {
    trajectory_.clear();
    turn_.reset();
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  const CostmapView map(*costmap_->costmap(costmap_, now.robot));
  FootprintCheck footprint(map, now.footprint, 0.0, now.pose);
  if (turn_.goes_on(now, footprint, command)) return Status::ok;
  const std::vector<Obstacle>& obstacles = gather_obstacles(now, map);
  const bool is_standing = speed_of(now.velocity) < standing_m_s;
  const std::optional<Target> target = choose_target(now, map, footprint);
  if (!target) {
    // an obstacle cuts off the way and the robot is as close to it as it can come: wait
    trajectory_.clear();
    if (is_standing && at_goal_.settles(tracker_.stop(), now)) command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  if (is_standing && turn_.begin_if_slow(route_, now) && turn_.goes_on(now, footprint, command)) return Status::ok;
  pose_problem(now, map, *target);
  const std::optional<int> solver_iterations = plan({{now, obstacles, footprint}, map}, *target);
  if (!solver_iterations) {
    trajectory_.clear();
    if (is_standing) {
      // a trajectory that still has to turn comes closer to what it stands at first
      if (make_room && !is_car_like(now.limits) && stands_at_wall(now)) turn_.begin(route_, now);
      return Status::ok;
    }
    set_error("every trajectory found runs into an obstacle");
    return Status::no_solution;
  }
  leave_out_wait({now, obstacles, footprint});
  command = first_command(now);
  annotate(*solver_iterations);
  return Status::ok;
}

// Past a corner, the states before and behind it may keep their distance, and none between them: then a trajectory waits
// for a step before it jumps, in every cycle anew. A first step that stays in place is left out if the rest is free at once.
void Mpc::leave_out_wait(const mpc::Surroundings& around) {
  const Limits& limits = around.now.limits;
  if (is_car_like(limits)) return;
  const double arm_m = is_holonomic(limits) ? 1.0 : around.now.footprint.radius_m;
  const auto waits = [&](const mpc::Control& control) {
    return std::max(std::abs(control.v), arm_m * std::abs(control.omega)) < standing_m_s;
  };
  std::size_t first = 0;
  while (first + 1 < trajectory_.controls.size() && waits(trajectory_.controls[first])) ++first;
  if (first == 0 || waits(trajectory_.controls[first])) return;
  mpc::Trajectory rest = trajectory_;
  rest.drop_front(first);
  if (mpc::is_collision_free(rest, collision_check_no_poses, around)) trajectory_ = rest;
}

Command Mpc::first_command(const Observation& now) const {
  const double period_s = seconds(now.dt_ns);
  const Limits& limits = now.limits;
  const mpc::Control& control = trajectory_.controls[0];
  if (is_holonomic(limits)) {
    const Vec2 v =
        toward(Vec2{now.velocity.v_x, now.velocity.v_y}, Vec2{control.v, control.omega}, limits.a_max * period_s);
    return {std::clamp(v.x, limits.v_min, limits.v_max), std::clamp(v.y, -limits.v_y_max, limits.v_y_max), 0.0};
  }
  const double v_x =
      std::clamp(toward(now.velocity.v_x, control.v, limits.a_max * period_s), limits.v_min, limits.v_max);
  if (is_car_like(limits)) return steered(v_x, curvature_at(control.omega, limits), limits);
  Command command;
  command.v_x = v_x;
  command.omega = std::clamp(toward(now.velocity.omega, control.omega, limits.alpha_max * period_s), -limits.omega_max,
                             limits.omega_max);
  return command;
}

const std::vector<Obstacle>& Mpc::gather_obstacles(const Observation& now, const CostmapView& map) {
  obstacle_set_.gather(now, clusters_->clusters(clusters_, now.robot));
  obstacles_ = obstacle_set_.all();
  for (Obstacle& obstacle : obstacles_) {
    // an obstacle may extend beyond the centres of its lethal cells, and a cluster is simplified with a tolerance
    if (!obstacle.is_agent) obstacle.radius_m += map.resolution_m();
    if (!enable_dynamic_obstacles) obstacle.velocity = {0.0, 0.0};
  }
  return obstacles_;
}

// A car-like robot that has cut a corner could not reach a goal close beside it, so its goal is at the look-ahead
// distance as the crow flies. Nor could it turn aside right before an obstacle, so its goal is beyond one on its path.
void Mpc::look_ahead(const Observation& now, const CostmapView& map, FootprintCheck& footprint) {
  constexpr double step_m = 0.3;
  const double whole_m = max_global_plan_lookahead_dist;
  ahead_.look(tracker_, now, map, whole_m);
  if (!is_car_like(now.limits)) return;
  for (double along_m = whole_m + step_m; along_m <= 2.0 * whole_m && !ahead_.ends_at_stop(); along_m += step_m) {
    if (toolkit::distance(toolkit::position(now.pose), toolkit::position(ahead_.goal())) >= whole_m &&
        footprint.cost(directed(ahead_.goal())) != in_collision)
      return;
    ahead_.look(tracker_, now, map, along_m);
  }
}

// The end of the path ahead; if the path is blocked, its last point that can be reached. Nothing if the robot already
// stands there. Sets route_.
std::optional<Mpc::Target> Mpc::choose_target(const Observation& now, const CostmapView& map,
                                              FootprintCheck& footprint) {
  look_ahead(now, map, footprint);
  const std::vector<Vec2>& points = ahead_.points();
  Target target;
  target.goal = ahead_.goal();
  target.ends_at_rest = ahead_.ends_at_stop();
  target.fixes_heading = !ahead_.ends_at_stop() || ahead_.has_heading();
  if (is_holonomic(now.limits)) {
    target.goal.theta = now.pose.theta;
    target.fixes_heading = false;
  }
  route_ = points;
  const auto is_free = [&](Vec2 point) { return footprint.cost(directed(point, target.goal.theta)) != in_collision; };
  if (std::all_of(points.begin(), points.end(), is_free)) return target;

  spread_guide(now, map, points.back());
  target.is_guided = true;
  const auto can_stop_at = [&](Vec2 point) {
    return guide_.reaches(map, point) &&
           (!is_car_like(now.limits) || has_room(now, {point.x, point.y, target.goal.theta}));
  };
  std::size_t last = points.size() - 1;
  while (last > 0 && !can_stop_at(points[last])) --last;
  const bool is_cut = last + 1 < points.size();
  const bool makes_room = is_cut && make_room && !is_car_like(now.limits) && !mpc::leads_past(guide_, map, points);
  const Vec2 end = makes_room ? mpc::place_to_wait(guide_, map, points, last) : points[last];
  if (!guide_.reaches(map, end) || (is_cut && toolkit::distance(toolkit::position(now.pose), end) < wait_within_m))
    return {};
  if (is_cut) {
    target.goal.x = end.x;
    target.goal.y = end.y;
    target.ends_at_rest = true;
    target.fixes_heading = false;
  }
  guide_.path_to(map, end, route_);
  return target;
}

// The guide may lead past another robot where no trajectory keeps the distance from it: then this robot waits before the
// first point that the other one takes. Nothing if it stands there already.
std::optional<Mpc::Target> Mpc::place_before_obstacle(const Cycle& cycle, Target target) const {
  const Observation& now = cycle.around.now;
  FootprintCheck& footprint = cycle.around.footprint;
  if (!make_room || is_car_like(now.limits)) return {};
  const std::vector<Vec2>& points = ahead_.points();
  const auto occupied = std::find_if(points.begin(), points.end(), [&](Vec2 point) {
    return footprint.cost(directed(point, target.goal.theta)) == in_collision;
  });
  if (occupied == points.begin() || occupied == points.end()) return {};
  const auto last = static_cast<std::size_t>(occupied - points.begin()) - 1;
  const Vec2 place = mpc::place_to_wait(guide_, cycle.map, points, last);
  if (toolkit::distance(toolkit::position(now.pose), place) < wait_within_m) return {};
  target.goal.x = place.x;
  target.goal.y = place.y;
  target.ends_at_rest = true;
  target.fixes_heading = false;
  return target;
}

// The guide knows of a disc only. A car-like robot, which cannot turn in place, stops only where its outline keeps the
// distance that the problem demands: with less, the trajectory that brakes there may have no solution.
bool Mpc::has_room(const Observation& now, const Pose& at) const {
  return std::all_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& obstacle) {
    return separation(now.footprint, at, obstacle, 0.0).distance_m >= min_obstacle_dist;
  });
}

// Whether it is nearer to an obstacle that is no agent than trajectories keep.
bool Mpc::stands_at_wall(const Observation& now) const {
  return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& obstacle) {
    return !obstacle.is_agent && separation(now.footprint, now.pose, obstacle, 0.0).distance_m < min_obstacle_dist;
  });
}

// The guide keeps the clearance that the feasibility check demands beside a wall: one cell more than the footprint. If
// that leaves no way to the point, it leads through narrower gaps, as between people.
void Mpc::spread_guide(const Observation& now, const CostmapView& map, Vec2 to) {
  const double radius_m = now.footprint.inscribed_radius_m;
  for (const double beyond_m : {map.resolution_m(), mpc::least_gap_m}) {
    guide_.spread(map, toolkit::position(now.pose), radius_m + beyond_m, radius_m + easy_beyond_m);
    if (guide_.reaches(map, to)) return;
  }
}

void Mpc::pose_problem(const Observation& now, const CostmapView& map, const Target& target) {
  const Limits& limits = now.limits;
  problem_.start = now.pose;
  problem_.before = {std::clamp(now.applied.v_x, limits.v_min, limits.v_max),
                     std::clamp(now.applied.omega, -limits.omega_max, limits.omega_max)};
  problem_.goal = target.goal;
  problem_.ends_at_rest = target.ends_at_rest;
  problem_.fixes_heading = target.fixes_heading;
  problem_.v_min = limits.v_min;
  problem_.v_max = limits.v_max;
  problem_.omega_max = limits.omega_max;
  problem_.a_max = limits.a_max;
  problem_.alpha_max = limits.alpha_max;
  if (is_car_like(limits)) {
    problem_.before.omega = steering_.angle_rad();
    problem_.omega_max = limits.steering_max;
    problem_.alpha_max = limits.steering_rate_max;
    problem_.turning_max = limits.omega_max;
  }
  problem_.wheelbase_m = limits.wheelbase_m;
  problem_.keeps_heading = is_holonomic(limits);
  if (problem_.keeps_heading) {
    problem_.before.omega = std::clamp(now.applied.v_y, -limits.v_y_max, limits.v_y_max);
    problem_.omega_max = limits.v_y_max;
    problem_.alpha_max = limits.a_max;
  }
  problem_.dt_min_s = min_dt;
  problem_.dt_max_s = max_dt;
  problem_.min_obstacle_dist_m = min_obstacle_dist;
  problem_.static_share = ease_in_gaps ? share_in_gaps(now, map, toolkit::position(target.goal)) : 1.0;
  problem_.footprint = &now.footprint;
}

// The share of min_obstacle_dist that the way to the goal has room for. In a gap too narrow for all of it, each state
// pays for what is missing, so that a trajectory through the gap costs more than one that ends before it.
double Mpc::share_in_gaps(const Observation& now, const CostmapView& map, Vec2 goal) {
  const double needed_m = now.footprint.inscribed_radius_m + map.resolution_m();
  const std::uint8_t highest = map.highest_cost_at(needed_m + min_obstacle_dist);
  if (std::all_of(route_.begin(), route_.end(), [&](Vec2 point) { return map.cost(point) <= highest; })) return 1.0;
  for (const double share : {1.0, 0.5, 0.25, 0.0})
    if (guide_.connects(map, toolkit::position(now.pose), goal, needed_m + share * min_obstacle_dist)) return share;
  return 1.0;
}

mpc::OptimizerSettings Mpc::optimizer_settings() const {
  mpc::OptimizerSettings settings;
  settings.outer_iterations = outer_ocp_iterations;
  settings.grid = {dt_ref, dt_hyst_ratio, static_cast<std::size_t>(*min_grid_size),
                   static_cast<std::size_t>(*max_grid_size)};
  settings.association = {force_inclusion_dist, cutoff_dist};
  settings.solver.iterations = iterations;
  settings.solver.tolerance = tol;
  return settings;
}

// Optimises what is left of the last trajectory; if the result is not feasible, a trajectory along route_, then one
// along the guide, which ends before what the guide leads past if it led there at once. Returns the number of solver iterations, or nothing if no result is feasible.
std::optional<int> Mpc::plan(const Cycle& cycle, const Target& target) {
  const Observation& now = cycle.around.now;
  const mpc::OptimizerSettings settings = optimizer_settings();
  int solver_iterations = 0;
  const auto is_solved = [&](double barrier_start) {
    const mpc::OptimizerReport report =
        optimizer_.optimise(settings, barrier_start, cycle.around.obstacles, problem_, trajectory_);
    solver_iterations += report.iterations;
    const bool is_usable = report.infeasibility < most_infeasible || (is_car_like(now.limits) && rolls_out_nearer());
    return is_usable && mpc::is_collision_free(trajectory_, collision_check_no_poses, cycle.around);
  };
  const auto is_solved_along_route = [&] {
    optimizer_.guess().along(problem_, route_, static_cast<std::size_t>(*grid_size_ref), trajectory_);
    return is_solved(barrier_cold);
  };

  if (can_continue()) {
    optimizer_.guess().shifted(problem_, seconds(now.dt_ns), trajectory_);
    if (is_solved(barrier_warm) && !stands_short(now)) return solver_iterations;
  }
  if (is_solved_along_route()) return solver_iterations;
  Vec2 goal = toolkit::position(target.goal);
  if (target.is_guided) {  // route_ was the guide's already
    const std::optional<Target> place = place_before_obstacle(cycle, target);
    if (!place) return {};
    pose_problem(now, cycle.map, *place);
    goal = toolkit::position(place->goal);
  } else {
    spread_guide(now, cycle.map, goal);
  }
  if (!guide_.reaches(cycle.map, goal)) return {};
  guide_.path_to(cycle.map, goal, route_);
  return is_solved_along_route() ? std::optional(solver_iterations) : std::nullopt;
}

// Beside the corners of an obstacle, the solver may not converge for a long robot. A car-like one, which cannot turn in
// place instead, then follows the controls that were found. Replaces the states by those that the controls lead to.
// Returns whether they lead nearer to the goal.
bool Mpc::rolls_out_nearer() {
  for (std::size_t k = 0; k + 1 < trajectory_.size(); ++k) {
    mpc::State& next = trajectory_.states[k + 1];
    const std::array<double, 3> defect = problem_.transition(problem_.stage(trajectory_, k), next).defect;
    next = {next.x + defect[0], next.y + defect[1], next.theta + defect[2]};
  }
  const Vec2 goal = toolkit::position(problem_.goal);
  return toolkit::distance(toolkit::position(trajectory_.states.back()), goal) <
         toolkit::distance(toolkit::position(problem_.start), goal);
}

// Whether the last trajectory leads near the new goal.
bool Mpc::can_continue() const {
  if (trajectory_.empty() || !warm_start) return false;
  const mpc::State& end = trajectory_.states.back();
  const mpc::State& goal = problem_.goal;
  if (std::hypot(goal.x - end.x, goal.y - end.y) > force_reinit_new_goal_dist) return false;
  return !problem_.fixes_heading ||
         std::abs(toolkit::difference(end.theta, goal.theta)) <= force_reinit_new_goal_angular;
}

// The terminal state is elastic, so beside its goal a robot may stand for ever in a local minimum that misses it. In
// upstream, this trajectory is infeasible, and the controller starts anew.
bool Mpc::stands_short(const Observation& now) const {
  const mpc::State& end = trajectory_.states.back();
  return speed_of(now.velocity) < standing_m_s &&
         std::hypot(problem_.goal.x - end.x, problem_.goal.y - end.y) > missed_m;
}

void Mpc::annotate(int solver_iterations) const {
  if (!annotations_.wanted()) return;
  constexpr std::size_t most = 200;
  std::array<Pose, most> poses;
  const std::size_t count = std::min(most, trajectory_.size());
  for (std::size_t k = 0; k < count; ++k) {
    poses[k] = trajectory_.states[k];
    poses[k].theta = toolkit::wrap(poses[k].theta);
  }
  annotations_.trajectory(DMRP_ANNOTATE_PREDICTED, {poses.data(), count}, trajectory_.dt_s);
  std::array<char, 32> note;
  std::snprintf(note.data(), note.size(), "iterations %d", solver_iterations);
  annotations_.note(note.data());
}

}  // namespace dmrp::controllers
