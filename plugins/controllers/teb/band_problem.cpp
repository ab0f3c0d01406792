// SPDX-License-Identifier: MIT
#include "controllers/teb/band_problem.hpp"

#include <algorithm>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"

namespace dmrp::controllers::teb {

namespace {

constexpr double shortest_dt_s = 0.01;

// The preferred turning direction applies to this many intervals at the start.
constexpr std::size_t turned_intervals = 3;

// The least weight of driving forward if the limits forbid driving backward.
constexpr double forbidding_weight = 1000.0;

// The maximum number of intervals that the check between two poses divides their distance into.
constexpr int most_pieces = 20;

// The greatest weight of moving along arcs for a holonomic drive, as in upstream's example of one.
constexpr double holonomic_arc_weight = 1.0;

constexpr std::size_t first_of(std::size_t pose) {
  return 4 * pose;
}

}  // namespace

void BandProblem::reserve(std::size_t poses) {
  kept_.reserve(poses);
  poses_.reserve(poses);
  motions_.reserve(poses);
  aside_.reserve(poses);
  links_.reserve(8 * poses);
  via_links_.reserve(poses);
}

void BandProblem::begin(TimedElasticBand& band, const Scene& scene, const Parameters& parameters,
                        double obstacle_factor) {
  band_ = &band;
  scene_ = &scene;
  parameters_ = &parameters;
  obstacle_factor_ = obstacle_factor;
  linker_.link(band, scene.stops_at_goal, *scene.footprint, *scene.obstacles, parameters, links_);
  link_via_points(band, *scene.via_points, via_links_);
}

double BandProblem::linearise(BandedMatrix<band_width>& hessian, std::vector<double>& gradient) {
  const std::size_t variables = first_of(band_->size()) - 1;
  hessian.resize(variables);
  gradient.assign(variables, 0.0);
  const NormalEquations normal = {&hessian, &gradient};
  const double cost = evaluate<true>(normal, {});
  normal.hold(0);
  normal.hold(variables - 3);
  return 0.5 * cost;
}

double BandProblem::try_step(const std::vector<double>& step) {
  TimedElasticBand& band = *band_;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const double* const change = step.data() + first_of(i);
    band.x[i] = kept_.x[i] + change[0];
    band.y[i] = kept_.y[i] + change[1];
    band.theta[i] = toolkit::wrap(kept_.theta[i] + change[2]);
    if (i < band.dt.size()) band.dt[i] = std::max(kept_.dt[i] + change[3], shortest_dt_s);
  }
  return 0.5 * evaluate<false>({}, {});
}

double BandProblem::cost(const CostScales& scales) {
  return evaluate<false>({}, scales) + scales.obstacles * cost_of_jumps();
}

double BandProblem::cost_of_jumps() const {
  const double reach_m = scene_->footprint->inscribed_radius_m;
  double cost = 0.0;
  double time_s = 0.0;
  for (std::size_t i = 0; i < band_->dt.size(); time_s += band_->dt[i], ++i) {
    const Vec2 from = band_->position(i);
    const Vec2 to = band_->position(i + 1);
    const double squared_m = toolkit::squared_distance(from, to);
    if (squared_m <= 4.0 * reach_m * reach_m) continue;
    const int pieces = std::min(most_pieces, static_cast<int>(std::sqrt(squared_m) / reach_m));
    for (int k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      const Vec2 at = toolkit::lerp(from, to, share);
      for (const Obstacle& obstacle : *scene_->obstacles) {
        const double ahead_s = time_s + share * band_->dt[i];
        if (least_distance(*scene_->footprint, at, obstacle, ahead_s) > parameters_->min_obstacle_dist) continue;
        const double distance_m =
            separation(*scene_->footprint, {at.x, at.y, band_->theta[i]}, obstacle, ahead_s).distance_m;
        const double error = above(distance_m, parameters_->min_obstacle_dist, 0.0).error;
        cost += parameters_->weight_obstacle * error * error;
      }
    }
  }
  return cost;
}

template <bool with_derivatives>
double BandProblem::evaluate(const NormalEquations& normal, const CostScales& scales) {
  const TimedElasticBand& band = *band_;
  poses_.resize(band.size());
  motions_.resize(band.dt.size());
  for (std::size_t i = 0; i < band.size(); ++i)
    poses_[i] = {band.position(i), band.theta[i], toolkit::from_angle(band.theta[i])};
  if (is_holonomic(*scene_->limits)) {
    aside_.resize(band.dt.size());
    for (std::size_t i = 0; i < band.dt.size(); ++i)
      holonomic_motion_between<with_derivatives>(poses_[i], poses_[i + 1], band.dt[i], motions_[i], aside_[i]);
  } else {
    for (std::size_t i = 0; i < band.dt.size(); ++i)
      motion_between<with_derivatives>(poses_[i], poses_[i + 1], band.dt[i], motions_[i]);
  }

  WeightedSquares<with_derivatives> squares = {normal};
  add_intervals(squares, !scales.whole_duration);
  add_accelerations(squares);
  add_preferred_turn(squares);
  double cost = squares.sum;
  if (scales.whole_duration) cost += band.duration_s();
  squares.sum = 0.0;
  add_obstacles(squares);
  cost += scales.obstacles * squares.sum;
  squares.sum = 0.0;
  add_via_points(squares);
  return cost + scales.via_points * squares.sum;
}

// Time, speed, kinematics and length.
template <bool with_derivatives>
void BandProblem::add_intervals(WeightedSquares<with_derivatives>& squares, bool count_time) const {
  const Parameters& parameters = *parameters_;
  const Limits& limits = *scene_->limits;
  const double margin = parameters.penalty_epsilon;
  const double forward_weight = limits.v_min < 0.0
                                    ? parameters.weight_kinematics_forward_drive
                                    : std::max(parameters.weight_kinematics_forward_drive, forbidding_weight);
  const bool holonomic = is_holonomic(limits);
  const double arc_weight =
      holonomic ? std::min(parameters.weight_kinematics_nh, holonomic_arc_weight) : parameters.weight_kinematics_nh;
  const double least_radius_m = is_car_like(limits) ? 1.0 / sharpest_curvature(limits) : 0.0;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const std::size_t first = first_of(i);
    const Motion& motion = motions_[i];
    if (count_time) squares.add(first + 3, Residual<1>{band_->dt[i], {1.0}}, parameters.weight_optimaltime);
    squares.add(first, within(motion.v, limits.v_min, limits.v_max, margin), motion.v_by, parameters.weight_max_vel_x);
    squares.add(first, within(motion.omega, -limits.omega_max, limits.omega_max, margin), motion.omega_by,
                parameters.weight_max_vel_theta);
    squares.add(first, non_holonomic(poses_[i], poses_[i + 1]), arc_weight);
    const Residual<pair_block> ahead = forward(poses_[i], poses_[i + 1]);
    squares.add(first, above(ahead.error, 0.0, 0.0), ahead.by, forward_weight);
    if (holonomic)
      squares.add(first, within(aside_[i].value, -limits.v_y_max, limits.v_y_max, margin), aside_[i].by,
                  parameters.weight_max_vel_y);
    if (least_radius_m > 0.0) {
      const Residual<pair_block> radius = turning_radius(poses_[i], poses_[i + 1]);
      squares.add(first, above(radius.error, least_radius_m, 0.0), radius.by,
                  parameters.weight_kinematics_turning_radius);
    }
    if (parameters.weight_shortest_path > 0.0)
      squares.add(first, length(poses_[i], poses_[i + 1]), parameters.weight_shortest_path);
  }
}

template <bool with_derivatives>
void BandProblem::add_accelerations(WeightedSquares<with_derivatives>& squares) const {
  const Parameters& parameters = *parameters_;
  const Limits& limits = *scene_->limits;
  const std::vector<double>& dt = band_->dt;
  const auto penalise = [&](std::size_t interval, const auto& v, const auto& omega) {
    const std::size_t first = first_of(interval);
    const double margin = parameters.penalty_epsilon;
    squares.add(first, within(v.error, -limits.a_max, limits.a_max, margin), v.by, parameters.weight_acc_lim_x);
    squares.add(first, within(omega.error, -limits.alpha_max, limits.alpha_max, margin), omega.by,
                parameters.weight_acc_lim_theta);
  };
  const Twist& start = scene_->start_velocity;
  const Motion& begin = motions_.front();
  penalise(0, end_acceleration(start.v_x, begin.v, begin.v_by, dt[0], 1.0),
           end_acceleration(start.omega, begin.omega, begin.omega_by, dt[0], 1.0));
  for (std::size_t i = 0; i + 1 < motions_.size(); ++i) {
    const Motion& a = motions_[i];
    const Motion& b = motions_[i + 1];
    penalise(i, acceleration(a.v, a.v_by, b.v, b.v_by, dt[i], dt[i + 1]),
             acceleration(a.omega, a.omega_by, b.omega, b.omega_by, dt[i], dt[i + 1]));
  }
  if (is_holonomic(limits)) add_sideways_accelerations(squares);
  if (!scene_->stops_at_goal) return;
  const Motion& end = motions_.back();
  penalise(motions_.size() - 1, end_acceleration(0.0, end.v, end.v_by, dt.back(), -1.0),
           end_acceleration(0.0, end.omega, end.omega_by, dt.back(), -1.0));
}

template <bool with_derivatives>
void BandProblem::add_sideways_accelerations(WeightedSquares<with_derivatives>& squares) const {
  const double a_max = scene_->limits->a_max;
  const std::vector<double>& dt = band_->dt;
  const auto penalise = [&](std::size_t interval, const auto& a) {
    squares.add(first_of(interval), within(a.error, -a_max, a_max, parameters_->penalty_epsilon), a.by,
                parameters_->weight_acc_lim_y);
  };
  const Velocity& begin = aside_.front();
  penalise(0, end_acceleration(scene_->start_velocity.v_y, begin.value, begin.by, dt[0], 1.0));
  for (std::size_t i = 0; i + 1 < aside_.size(); ++i)
    penalise(i, acceleration(aside_[i].value, aside_[i].by, aside_[i + 1].value, aside_[i + 1].by, dt[i], dt[i + 1]));
  if (!scene_->stops_at_goal) return;
  const Velocity& end = aside_.back();
  penalise(aside_.size() - 1, end_acceleration(0.0, end.value, end.by, dt.back(), -1.0));
}

template <bool with_derivatives>
void BandProblem::add_obstacles(WeightedSquares<with_derivatives>& squares) const {
  const Parameters& parameters = *parameters_;
  for (const ObstacleLink& link : links_) {
    const Obstacle& obstacle = (*scene_->obstacles)[link.obstacle];
    const double inflation_m = link.is_dynamic ? parameters.dynamic_obstacle_inflation_dist : parameters.inflation_dist;
    // from this distance on, an obstacle costs nothing
    const double free_m = std::max(inflation_m, parameters.min_obstacle_dist + parameters.penalty_epsilon);
    if (least_distance(*scene_->footprint, band_->position(link.pose), obstacle, link.ahead_s) >= free_m) continue;
    const Separation apart = separation(*scene_->footprint, band_->pose(link.pose), obstacle, link.ahead_s);
    const std::array<double, 3> by = {apart.gradient.x, apart.gradient.y, apart.gradient_theta};
    add_closeness(squares, link, apart.distance_m, by);
    if (inflation_m <= parameters.min_obstacle_dist) continue;
    squares.add(first_of(link.pose), above(apart.distance_m, inflation_m, 0.0), by,
                link.is_dynamic ? parameters.weight_dynamic_obstacle_inflation : parameters.weight_inflation);
  }
}

// The penalty below min_obstacle_dist; a smaller distance near a robot that is already closer, and near such a goal.
template <bool with_derivatives>
void BandProblem::add_closeness(WeightedSquares<with_derivatives>& squares, const ObstacleLink& link, double distance_m,
                                std::array<double, 3> by) const {
  const Parameters& parameters = *parameters_;
  double wanted_m = parameters.min_obstacle_dist + parameters.penalty_epsilon;
  Vec2 wanted_by = {0.0, 0.0};
  const auto ease = [&](double end_m, std::size_t end) {
    if (!(end_m < wanted_m)) return;
    const Vec2 from_end = band_->position(link.pose) - band_->position(end);
    const double from_end_m = toolkit::norm(from_end);
    const double eased_m = end_m + easing_slope * from_end_m;
    if (!(eased_m < wanted_m) || !(from_end_m > 0.0)) return;
    wanted_m = eased_m;
    wanted_by = (easing_slope / from_end_m) * from_end;
  };
  ease(link.start_m, 0);
  ease(link.goal_m, band_->size() - 1);
  by[0] -= wanted_by.x;
  by[1] -= wanted_by.y;
  const Penalty close = above(distance_m, wanted_m, 0.0);
  if (link.is_dynamic) {
    squares.add(first_of(link.pose), close, by, obstacle_factor_ * parameters.weight_dynamic_obstacle);
  } else {
    squares.add(first_of(link.pose), raised(close, parameters.obstacle_cost_exponent, parameters.min_obstacle_dist), by,
                obstacle_factor_ * parameters.weight_obstacle);
  }
}

template <bool with_derivatives>
void BandProblem::add_via_points(WeightedSquares<with_derivatives>& squares) const {
  for (const ViaPointLink& link : via_links_) {
    const Vec2 aside = band_->position(link.pose) - (*scene_->via_points)[link.point];
    // the square of the distance is the sum of these two
    squares.add(first_of(link.pose), Residual<1>{aside.x, {1.0}}, parameters_->weight_viapoint);
    squares.add(first_of(link.pose) + 1, Residual<1>{aside.y, {1.0}}, parameters_->weight_viapoint);
  }
}

template <bool with_derivatives>
void BandProblem::add_preferred_turn(WeightedSquares<with_derivatives>& squares) const {
  if (scene_->preferred_turn == Turn::any) return;
  const double direction = scene_->preferred_turn == Turn::left ? 1.0 : -1.0;
  for (std::size_t i = 0; i < std::min(turned_intervals, motions_.size()); ++i) {
    const double turned = direction * toolkit::difference(poses_[i].theta, poses_[i + 1].theta);
    const std::array<double, pair_block> by = {0.0, 0.0, -direction, 0.0, 0.0, 0.0, direction};
    squares.add(first_of(i), above(turned, 0.0, 0.0), by, parameters_->weight_prefer_rotdir);
  }
}

}  // namespace dmrp::controllers::teb
