// SPDX-License-Identifier: MIT
#include "controllers/e3mop/spline_path.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::e3mop {

void SplinePath::solve_second_derivatives(const std::vector<Vec2>& points, std::optional<double> start_theta) {
  const std::size_t count = points.size();
  knots_.resize(count);
  knots_[0] = 0.0;
  for (std::size_t i = 1; i < count; ++i) knots_[i] = knots_[i - 1] + toolkit::distance(points[i - 1], points[i]);
  matrix_.resize(count);
  second_x_.assign(count, 0.0);
  second_y_.assign(count, 0.0);
  const auto slope = [&](std::size_t i) { return (points[i + 1] - points[i]) / (knots_[i + 1] - knots_[i]); };
  const auto set = [this](std::size_t i, Vec2 value) {
    second_x_[i] = value.x;
    second_y_[i] = value.y;
  };
  // h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i - slope_{i-1})
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = knots_[i] - knots_[i - 1];
    const double after = knots_[i + 1] - knots_[i];
    matrix_.at(i, i) = 2.0 * (before + after);
    if (i > 1) matrix_.at(i, i - 1) = before;
    set(i, 6.0 * (slope(i) - slope(i - 1)));
  }
  matrix_.at(0, 0) = 1.0;
  matrix_.at(count - 1, count - 1) = 1.0;
  if (start_theta) {
    const double after = knots_[1];
    matrix_.at(0, 0) = 2.0 * after;
    if (count > 2) matrix_.at(1, 0) = after;
    set(0, 6.0 * (slope(0) - toolkit::from_angle(*start_theta)));
  }
  ldlt_.factor(matrix_);
  ldlt_.solve(second_x_);
  ldlt_.solve(second_y_);
  second_.resize(count);
  for (std::size_t i = 0; i < count; ++i) second_[i] = {second_x_[i], second_y_[i]};
}

void SplinePath::fit(const std::vector<Vec2>& points, std::optional<double> start_theta, double step_m,
                     std::vector<PathPoint>& samples) {
  solve_second_derivatives(points, start_theta);
  samples.clear();
  const auto count = std::max(1, static_cast<int>(std::lround(knots_.back() / step_m)));
  std::size_t piece = 0;
  for (int k = 0; k <= count; ++k) {
    const double t = knots_.back() * k / count;
    while (piece + 2 < points.size() && knots_[piece + 1] <= t) ++piece;
    const double h = knots_[piece + 1] - knots_[piece];
    const double b = (t - knots_[piece]) / h;
    const double a = 1.0 - b;
    const Vec2 m0 = second_[piece];
    const Vec2 m1 = second_[piece + 1];
    PathPoint sample;
    sample.at =
        a * points[piece] + b * points[piece + 1] + (h * h / 6.0) * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
    const Vec2 first =
        (points[piece + 1] - points[piece]) / h + (h / 6.0) * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
    const Vec2 second = a * m0 + b * m1;
    const double rate = std::max(1e-6, toolkit::norm(first));
    sample.theta = std::atan2(first.y, first.x);
    sample.curvature = toolkit::cross(first, second) / (rate * rate * rate);
    if (!samples.empty()) sample.arc_m = samples.back().arc_m + toolkit::distance(samples.back().at, sample.at);
    samples.push_back(sample);
  }
}

}  // namespace dmrp::controllers::e3mop
