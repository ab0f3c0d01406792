// SPDX-License-Identifier: MIT
// levenberg_marquardt.hpp: nonlinear least squares by damped Gauss-Newton steps on banded normal equations.
//
// Damping by Nielsen: Damping parameter in Marquardt's method, IMM-REP-1999-05, as in g2o.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"

namespace dmrp::controllers {

struct LevenbergMarquardtSettings {
  int iterations = 5;            // maximum; an iteration that finds no step that lowers the cost ends the solution
  int trials = 10;               // maximum number of damping values per iteration
  double first_damping = 1e-5;   // relative to the largest diagonal entry
  double least_decrease = 0.0;   // stops when an iteration lowers the cost by a smaller fraction
  double least_gradient = 1e-9;  // stops when no entry of the gradient is larger
};

struct LevenbergMarquardtResult {
  int iterations = 0;
  double first_cost = 0.0;
  double cost = 0.0;      // at most first_cost
  bool is_finite = true;  // false: the cost was not finite; the estimate is the last finite one
};

// Reuses its buffers from one problem to the next.
//
// A Problem has
//   double linearise(BandedMatrix<B>& hessian, std::vector<double>& gradient)
//       resizes and fills H = J'J and g = J'r at the current estimate; returns the cost r'r / 2
//   double try_step(const std::vector<double>& step)
//       sets the estimate to the saved one plus the step; returns the cost there
//   void keep()     saves the current estimate
//   void restore()  returns to the saved estimate
template <std::size_t Bandwidth>
class LevenbergMarquardt {
 public:
  // Allocates for problems of `size` variables.
  void reserve(std::size_t size) {
    hessian_.reserve(size);
    ldlt_.reserve(size);
    gradient_.reserve(size);
    step_.reserve(size);
  }

  template <class Problem>
  LevenbergMarquardtResult minimise(Problem& problem, const LevenbergMarquardtSettings& settings) {
    LevenbergMarquardtResult result;
    double damping = 0.0;
    double growth = 2.0;
    problem.keep();
    for (; result.iterations < settings.iterations; ++result.iterations) {
      const double cost = problem.linearise(hessian_, gradient_);
      if (result.iterations == 0) {
        result.first_cost = result.cost = cost;
        damping = settings.first_damping * largest_diagonal();
      }
      if (!std::isfinite(cost)) return result.is_finite = false, result;
      if (largest_gradient() <= settings.least_gradient) break;
      const double lower = descend(problem, settings.trials, cost, damping, growth);
      if (!(lower < cost)) break;
      result.cost = lower;
      if (cost - lower <= settings.least_decrease * cost) {
        ++result.iterations;
        break;
      }
    }
    return result;
  }

 private:
  // Raises the damping until a step lowers the cost. Returns the lower cost, or `cost` if no step lowers it.
  template <class Problem>
  double descend(Problem& problem, int trials, double cost, double& damping, double& growth) {
    for (int trial = 0; trial < trials; ++trial) {
      if (ldlt_.factor(hessian_, damping) && ldlt_.negative_pivots() == 0) {
        step_ = gradient_;
        ldlt_.solve(step_);
        for (double& s : step_) s = -s;
        const double lower = problem.try_step(step_);
        const double ratio = (cost - lower) / expected_decrease(damping);
        if (std::isfinite(lower) && ratio > 0.0) {
          problem.keep();
          const double sharper = 2.0 * ratio - 1.0;
          damping *= std::clamp(1.0 - sharper * sharper * sharper, 1.0 / 3.0, 2.0 / 3.0);
          growth = 2.0;
          return lower;
        }
        problem.restore();
      }
      damping *= growth;
      growth *= 2.0;
      if (!std::isfinite(damping)) break;
    }
    return cost;
  }

  // The decrease that the quadratic model predicts: step' (damping step - gradient) / 2.
  double expected_decrease(double damping) const {
    double twice = 0.0;
    for (std::size_t i = 0; i < step_.size(); ++i) twice += step_[i] * (damping * step_[i] - gradient_[i]);
    return 0.5 * twice + 1e-300;
  }

  double largest_diagonal() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < hessian_.size(); ++i) largest = std::max(largest, hessian_.at(i, i));
    return largest;
  }
  double largest_gradient() const {
    double largest = 0.0;
    for (const double g : gradient_) largest = std::max(largest, std::abs(g));
    return largest;
  }

  BandedMatrix<Bandwidth> hessian_;
  BandedLdlt<Bandwidth> ldlt_;
  std::vector<double> gradient_;
  std::vector<double> step_;
};

}  // namespace dmrp::controllers
