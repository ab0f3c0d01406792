// SPDX-License-Identifier: MIT
#include "controllers/e3mop/path_smoother.hpp"

#include <algorithm>

namespace dmrp::controllers::e3mop {

void SmoothingProblem::set(const std::vector<Vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
                           const SmoothingSettings& settings) {
  points_ = points;
  kept_ = points;
  fixed_begin_ = fixed_begin;
  field_ = &field;
  settings_ = settings;
}

double SmoothingProblem::cost() const {
  double smoothness = 0.0;
  double obstacles = 0.0;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    smoothness += toolkit::squared_norm(points_[i + 1] - 2.0 * points_[i] + points_[i - 1]);
    if (!is_free(i)) continue;
    const double lack_m = std::max(0.0, settings_.safe_distance_m - field_->at(points_[i]).distance_m);
    obstacles += lack_m * lack_m;
  }
  return 0.5 * (settings_.weight_smoothness * smoothness + settings_.weight_obstacle * obstacles);
}

double SmoothingProblem::linearise(BandedMatrix<smoothing_bandwidth>& hessian, std::vector<double>& gradient) const {
  constexpr double stencil[3] = {1.0, -2.0, 1.0};
  const std::size_t free_count = points_.size() - 1 - fixed_begin_;
  hessian.resize(2 * free_count);
  gradient.assign(2 * free_count, 0.0);
  double smoothness = 0.0;
  double obstacles = 0.0;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const Vec2 bend = points_[i + 1] - 2.0 * points_[i] + points_[i - 1];
    smoothness += toolkit::squared_norm(bend);
    for (std::size_t a = 0; a < 3; ++a) {
      if (!is_free(i + a - 1)) continue;
      const std::size_t row = 2 * (i + a - 1 - fixed_begin_);
      gradient[row] += settings_.weight_smoothness * stencil[a] * bend.x;
      gradient[row + 1] += settings_.weight_smoothness * stencil[a] * bend.y;
      for (std::size_t b = 0; b <= a; ++b) {
        if (!is_free(i + b - 1)) continue;
        const std::size_t column = 2 * (i + b - 1 - fixed_begin_);
        const double product = settings_.weight_smoothness * stencil[a] * stencil[b];
        hessian.at(row, column) += product;
        hessian.at(row + 1, column + 1) += product;
      }
    }
    if (!is_free(i)) continue;
    const Clearance clearance = field_->at(points_[i]);
    const double lack_m = settings_.safe_distance_m - clearance.distance_m;
    if (lack_m <= 0.0) continue;
    obstacles += lack_m * lack_m;
    const std::size_t row = 2 * (i - fixed_begin_);
    const Vec2 slope = clearance.gradient;
    gradient[row] -= settings_.weight_obstacle * lack_m * slope.x;
    gradient[row + 1] -= settings_.weight_obstacle * lack_m * slope.y;
    hessian.at(row, row) += settings_.weight_obstacle * slope.x * slope.x;
    hessian.at(row + 1, row) += settings_.weight_obstacle * slope.x * slope.y;
    hessian.at(row + 1, row + 1) += settings_.weight_obstacle * slope.y * slope.y;
  }
  return 0.5 * (settings_.weight_smoothness * smoothness + settings_.weight_obstacle * obstacles);
}

double SmoothingProblem::try_step(const std::vector<double>& step) {
  for (std::size_t i = fixed_begin_; i + 1 < points_.size(); ++i) {
    const std::size_t row = 2 * (i - fixed_begin_);
    points_[i] = kept_[i] + Vec2{step[row], step[row + 1]};
  }
  return cost();
}

SmoothingResult PathSmoother::smooth(std::vector<Vec2>& points, std::size_t fixed_begin, const ClearanceField& field,
                                     const SmoothingSettings& settings) {
  SmoothingResult result;
  if (points.size() < fixed_begin + 2) return result;
  problem_.set(points, fixed_begin, field, settings);
  LevenbergMarquardtSettings solver;
  solver.iterations = settings.iterations;
  solver.least_decrease = 1e-3;
  const LevenbergMarquardtResult solved = solver_.minimise(problem_, solver);
  result.iterations = solved.iterations;
  result.first_cost = solved.first_cost;
  result.cost = solved.cost;
  for (std::size_t i = fixed_begin; i + 1 < points.size(); ++i) {
    if (field.at(problem_.points()[i]).distance_m < settings.needed_m)
      ++result.put_back;
    else
      points[i] = problem_.points()[i];
  }
  return result;
}

}  // namespace dmrp::controllers::e3mop
