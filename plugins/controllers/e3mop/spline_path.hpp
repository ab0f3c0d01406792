// SPDX-License-Identifier: MIT
// spline_path.hpp: a cubic spline through the points of a path, sampled with heading and curvature.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <optional>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"

namespace dmrp::controllers::e3mop {

struct PathPoint {
  Vec2 at = {0.0, 0.0};
  double theta = 0.0;
  double curvature = 0.0;  // 1/m, positive to the left
  double arc_m = 0.0;      // from the path's start
  double speed = 0.0;      // m/s, set by plan_speeds()
  double time_s = 0.0;     // set by plan_speeds(); infinite beyond the point where the robot stops
};

// Parametrised by chord length; twice continuously differentiable.
class SplinePath {
 public:
  // Interpolates at least two points, no two consecutive ones equal; samples it about `step_m` apart, including both
  // ends. The spline starts in the direction `start_theta` if given; otherwise the start is natural (curvature 0). The
  // end is always natural.
  void fit(const std::vector<Vec2>& points, std::optional<double> start_theta, double step_m,
           std::vector<PathPoint>& samples);

 private:
  void solve_second_derivatives(const std::vector<Vec2>& points, std::optional<double> start_theta);

  std::vector<double> knots_;  // chord lengths
  std::vector<Vec2> second_;   // second derivatives at the knots
  BandedMatrix<1> matrix_;
  BandedLdlt<1> ldlt_;
  std::vector<double> second_x_;
  std::vector<double> second_y_;
};

}  // namespace dmrp::controllers::e3mop
