// SPDX-License-Identifier: MIT
// spline_path.hpp: a cubic spline through the points of a path, sampled by arc length with heading and curvature.
#ifndef DMRP_CONTROLLERS_E3MOP_SPLINE_PATH_HPP
#define DMRP_CONTROLLERS_E3MOP_SPLINE_PATH_HPP

#include <dmrp/values.h>

#include <optional>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"

namespace dmrp::controllers::e3mop {

struct PathPoint {
  dmrp_vec2 at = {0.0, 0.0};
  double theta = 0.0;
  double curvature = 0.0;  // 1/m, positive to the left
  double arc_m = 0.0;      // from the path's start
  double speed = 0.0;      // m/s; the velocity profile's
  double time_s = 0.0;     // likewise; infinite beyond where the profile stops
};

// Interpolates by chord length; twice continuously differentiable.
class SplinePath {
 public:
  // Through at least two points, no two neighbours equal, sampled about `step_m` apart, the ends included. The spline
  // starts in the direction `start_theta` where there is one and is natural (no curvature) at ends that have none.
  void fit(const std::vector<dmrp_vec2>& points, std::optional<double> start_theta, double step_m,
           std::vector<PathPoint>& samples);

 private:
  void solve_bends(const std::vector<dmrp_vec2>& points, std::optional<double> start_theta);

  std::vector<double> knots_;     // chord lengths
  std::vector<dmrp_vec2> bends_;  // second derivatives at the knots
  BandedMatrix<1> matrix_;
  BandedLdlt<1> ldlt_;
  std::vector<double> bends_x_;
  std::vector<double> bends_y_;
};

}  // namespace dmrp::controllers::e3mop

#endif
