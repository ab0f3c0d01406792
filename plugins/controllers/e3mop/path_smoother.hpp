// SPDX-License-Identifier: MIT
// path_smoother.hpp: local path optimisation (section IV of the paper):
//
//   f = w_s sum |x_{i+1} - 2 x_i + x_{i-1}|^2 + w_o sum max(0, d_s - tau(x_i))^2
//
// with the Euclidean distance field tau, by Levenberg-Marquardt. With interleaved x and y, the normal matrix couples
// each point with the two before and after it: one triangle has 5 bands, the diagonal and 4 beside it.
#pragma once

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "controllers/e3mop/clearance_field.hpp"
#include "controllers/motion/levenberg_marquardt.hpp"

namespace dmrp::controllers::e3mop {

struct SmoothingSettings {
  double weight_smoothness = 1.0;  // w_s, 1/m^2
  double weight_obstacle = 10.0;   // w_o, 1/m^2
  double safe_distance_m = 0.5;    // d_s
  int iterations = 100;
  double needed_m = 0.0;  // the least clearance; points closer to obstacles collide
};

inline constexpr std::size_t smoothing_bandwidth = 4;

// The objective over the points of a path; the first `fixed_begin` points and the last one stay fixed. A problem for
// LevenbergMarquardt with the cost f / 2.
class SmoothingProblem {
 public:
  // Copies the points, at least `fixed_begin` + 2 of them.
  void set(const std::vector<Vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
           const SmoothingSettings& settings);

  double cost() const;
  double linearise(BandedMatrix<smoothing_bandwidth>& hessian, std::vector<double>& gradient) const;
  double try_step(const std::vector<double>& step);
  void keep() { kept_ = points_; }
  void restore() { points_ = kept_; }

  std::vector<Vec2>& points() { return points_; }

 private:
  bool is_free(std::size_t i) const { return i >= fixed_begin_ && i + 1 < points_.size(); }

  std::vector<Vec2> points_;
  std::vector<Vec2> kept_;
  std::size_t fixed_begin_ = 1;
  const ClearanceField* field_ = nullptr;
  SmoothingSettings settings_;
};

struct SmoothingResult {
  int iterations = 0;
  double first_cost = 0.0;  // f / 2
  double cost = 0.0;        // after the optimisation, before points are reset
  int put_back = 0;         // points reset to their original position, because the new one collides
};

class PathSmoother {
 public:
  // Moves the points in place.
  SmoothingResult smooth(std::vector<Vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
                         const SmoothingSettings& settings);

 private:
  SmoothingProblem problem_;
  LevenbergMarquardt<smoothing_bandwidth> solver_;
};

}  // namespace dmrp::controllers::e3mop
