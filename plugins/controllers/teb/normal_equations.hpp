// SPDX-License-Identifier: MIT
// normal_equations.hpp: sums weighted squares and, optionally, the normal equations of their linearisation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "controllers/motion/banded_ldlt.hpp"
#include "controllers/teb/residuals.hpp"

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

}  // namespace dmrp::controllers::teb
