// SPDX-License-Identifier: MIT
// path_smoother.hpp: local path optimisation (section IV of the paper):
//
//   f = w_s sum |x_{i+1} - 2 x_i + x_{i-1}|^2 + w_o sum max(0, d_s - tau(x_i))^2
//
// with tau the Euclidean distance field, by Levenberg-Marquardt. With x and y of the points interleaved, the normal
// matrix couples a point with the two before and behind it: bandwidth 5 as rows of one triangle, 4 beside the diagonal.
#ifndef DMRP_CONTROLLERS_E3MOP_PATH_SMOOTHER_HPP
#define DMRP_CONTROLLERS_E3MOP_PATH_SMOOTHER_HPP

#include <cstddef>
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
  double needed_m = 0.0;  // nearer to obstacles than this is collision
};

inline constexpr std::size_t smoothing_bandwidth = 4;

// The objective over the points of a path whose first `fixed_begin` and last points stay. A problem of
// LevenbergMarquardt; its cost is f / 2.
class SmoothingProblem {
 public:
  // Keeps its own copy of the points. At least one more than `fixed_begin` + 1.
  void set(const std::vector<dmrp_vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
           const SmoothingSettings& settings);

  double cost() const;
  double linearise(BandedMatrix<smoothing_bandwidth>& hessian, std::vector<double>& gradient) const;
  double try_step(const std::vector<double>& step);
  void keep() { kept_ = points_; }
  void restore() { points_ = kept_; }

  std::vector<dmrp_vec2>& points() { return points_; }

 private:
  bool is_free(std::size_t i) const { return i >= fixed_begin_ && i + 1 < points_.size(); }

  std::vector<dmrp_vec2> points_;
  std::vector<dmrp_vec2> kept_;
  std::size_t fixed_begin_ = 1;
  const ClearanceField* field_ = nullptr;
  SmoothingSettings settings_;
};

struct SmoothingResult {
  int iterations = 0;
  double first_cost = 0.0;  // f / 2
  double cost = 0.0;        // after the optimisation, before points are put back
  int put_back = 0;         // points that keep their unsmoothed place, since the new one would be in collision
};

class PathSmoother {
 public:
  // Moves the points in place.
  SmoothingResult smooth(std::vector<dmrp_vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
                         const SmoothingSettings& settings);

 private:
  SmoothingProblem problem_;
  LevenbergMarquardt<smoothing_bandwidth> solver_;
};

}  // namespace dmrp::controllers::e3mop

#endif
