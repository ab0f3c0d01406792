// SPDX-License-Identifier: MIT
// band_problem.hpp: the residuals of a band as a least-squares problem with banded normal equations.
//
// The variables are ordered pose by pose (x, y, theta, dt), so that each residual depends on at most 11 consecutive
// variables and the normal matrix has 10 bands beside its diagonal. The first and the last pose are fixed.
#pragma once

#include <array>
#include <vector>

#include "controllers/teb/normal_equations.hpp"
#include "controllers/teb/obstacle_links.hpp"
#include "controllers/teb/residuals.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

// The input of the optimisation in one control cycle. Does not own what it refers to.
struct Scene {
  const Limits* limits = nullptr;
  const Footprint* footprint = nullptr;
  const std::vector<Obstacle>* obstacles = nullptr;
  const std::vector<Vec2>* via_points = nullptr;
  Twist start_velocity = {0.0, 0.0, 0.0};
  bool stops_at_goal = false;  // otherwise the velocity at the goal is free
  Turn preferred_turn = Turn::any;
};

// The weights of the parts of the cost when bands are compared.
struct CostScales {
  double obstacles = 1.0;
  double via_points = 1.0;
  bool whole_duration = false;  // use the duration instead of the sum of squared intervals
};

// A Problem for LevenbergMarquardt, which documents linearise(), try_step(), keep() and restore(). Changes the band
// given to begin().
class BandProblem {
 public:
  void reserve(std::size_t poses);

  // Sets the band until the next begin() and associates its current poses with obstacles and via-points.
  // `obstacle_factor` scales the weights of the obstacles.
  void begin(TimedElasticBand& band, const Scene& scene, const Parameters& parameters, double obstacle_factor);

  double linearise(BandedMatrix<band_width>& hessian, std::vector<double>& gradient);
  double try_step(const std::vector<double>& step);
  void keep() { kept_ = *band_; }
  void restore() { *band_ = kept_; }

  // The sum of weighted squares. If two consecutive poses are farther apart than the footprint's diameter, the
  // obstacles' part includes points between them, so that a band cannot lower its cost by jumping over an obstacle.
  double cost(const CostScales& scales = {});

 private:
  template <bool with_derivatives>
  double evaluate(const NormalEquations& normal, const CostScales& scales);
  template <bool with_derivatives>
  void add_intervals(WeightedSquares<with_derivatives>& squares, bool count_time) const;
  template <bool with_derivatives>
  void add_accelerations(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_sideways_accelerations(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_obstacles(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_closeness(WeightedSquares<with_derivatives>& squares, const ObstacleLink& link, double distance_m,
                     std::array<double, 3> by) const;
  template <bool with_derivatives>
  void bound_passings(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_passings(WeightedSquares<with_derivatives>& squares) const;
  double cost_of_jumps() const;
  template <bool with_derivatives>
  void add_via_points(WeightedSquares<with_derivatives>& squares) const;
  template <bool with_derivatives>
  void add_preferred_turn(WeightedSquares<with_derivatives>& squares) const;

  const Scene* scene_ = nullptr;
  const Parameters* parameters_ = nullptr;
  TimedElasticBand* band_ = nullptr;
  TimedElasticBand kept_;
  double obstacle_factor_ = 1.0;
  std::vector<DirectedPose> poses_;
  std::vector<Motion> motions_;
  std::vector<Velocity> aside_;  // of a holonomic drive, one a motion
  ObstacleLinker linker_;
  std::vector<ObstacleLink> links_;
  std::vector<PassingLink> passings_;
  std::vector<ViaPointLink> via_links_;
};

}  // namespace dmrp::controllers::teb
