// SPDX-License-Identifier: MIT
// levenberg_marquardt.hpp: least squares by damped Gauss-Newton steps on banded normal equations.
//
// Damping by Nielsen: Damping parameter in Marquardt's method, IMM-REP-1999-05; as g2o does it.
#ifndef DMRP_CONTROLLERS_MOTION_LEVENBERG_MARQUARDT_HPP
#define DMRP_CONTROLLERS_MOTION_LEVENBERG_MARQUARDT_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"

namespace dmrp::controllers {

struct LevenbergMarquardtSettings {
  int iterations = 5;            // at most; each ends in a step that lowers the cost, or ends the whole
  int trials = 10;               // of ever greater damping within an iteration
  double first_damping = 1e-5;   // times the largest entry of the diagonal
  double least_decrease = 0.0;   // ends where an iteration lowers the cost by a smaller share than this
  double least_gradient = 1e-9;  // ends where no entry of the gradient is larger
};

struct LevenbergMarquardtResult {
  int iterations = 0;
  double first_cost = 0.0;
  double cost = 0.0;      // never above first_cost
  bool is_finite = true;  // false: the cost or a step was no number; the estimate is the last sound one
};

// Keeps its buffers from one problem to the next.
//
// A Problem has
//   double linearise(BandedMatrix<B>& hessian, std::vector<double>& gradient)
//       at its estimate: H = J'J and g = J'r, to be resized and filled, and returns the cost r'r / 2
//   double try_step(const std::vector<double>& step)
//       goes to the estimate kept last plus the step, and returns the cost there
//   void keep()     keeps the estimate tried last
//   void restore()  goes back to the one kept
template <std::size_t Bandwidth>
class LevenbergMarquardt {
 public:
  // For problems of so many variables.
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
  // Raises the damping until a step lowers the cost; returns the cost then, the same cost where no step did.
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

  // Of the quadratic model: step' (damping step - gradient) / 2.
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

#endif
