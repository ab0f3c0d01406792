// SPDX-License-Identifier: MIT
// band_problem.hpp: the residuals of a band as a least-squares problem with banded normal equations.
//
// The variables are ordered pose by pose (x, y, theta, dt), so that each residual depends on at most 11 consecutive
// variables and the normal matrix has 10 bands beside its diagonal. The first and the last pose are fixed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"
#include "controllers/teb/obstacle_links.hpp"
#include "controllers/teb/residuals.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

inline constexpr std::size_t band_width = triple_block - 1;

struct NormalEquations {
  BandedMatrix<band_width>* hessian = nullptr;  // J'J
  std::vector<double>* gradient = nullptr;      // J'r

  // Adds a residual that depends on the variables from `first` on.
  template <std::size_t size>
  void add(std::size_t first, const std::array<double, size>& by, double error, double weight) const {
    double* const g = gradient->data() + first;
    for (std::size_t i = 0; i < size; ++i) {
      const double scaled = weight * by[i];
      g[i] += scaled * error;
      double* const row = hessian->row(first + i) + band_width - i;
      for (std::size_t k = 0; k <= i; ++k) row[k] += scaled * by[k];
    }
  }

  // Fixes the three variables from `first` on.
  void hold(std::size_t first) const {
    const std::size_t size = hessian->size();
    for (std::size_t i = first; i < first + 3; ++i) {
      std::fill_n(hessian->row(i), band_width, 0.0);
      for (std::size_t below = i + 1; below <= i + band_width && below < size; ++below) hessian->at(below, i) = 0.0;
      hessian->at(i, i) = 1.0;
      (*gradient)[i] = 0.0;
    }
  }
};

// Sums weighted squares and, optionally, the normal equations of their linearisation.
template <bool with_derivatives>
struct WeightedSquares {
  NormalEquations normal;
  double sum = 0.0;

  template <std::size_t size>
  void add(std::size_t first, const Residual<size>& residual, double weight) {
    sum += weight * residual.error * residual.error;
    if constexpr (with_derivatives) normal.add(first, residual.by, residual.error, weight);
  }

  // Adds a penalty on a quantity with the derivatives `by`.
  template <std::size_t size>
  void add(std::size_t first, Penalty penalty, const std::array<double, size>& by, double weight) {
    if (penalty.error == 0.0) return;
    sum += weight * penalty.error * penalty.error;
    // J is the slope times `by`
    if constexpr (with_derivatives)
      normal.add(first, by, penalty.error / penalty.slope, weight * penalty.slope * penalty.slope);
  }
};

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
  std::vector<ViaPointLink> via_links_;
};

}  // namespace dmrp::controllers::teb
