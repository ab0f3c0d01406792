// SPDX-License-Identifier: MIT
// banded_ldlt.hpp: symmetric banded linear systems by the factorisation A = L D L'.
//
// Golub, Van Loan: Matrix Computations (4th edition), sections 4.1.2 and 4.3.5. Without pivoting: for positive definite
// and quasi-definite matrices (Vanderbei: Symmetric quasidefinite matrices, SIAM J. Optimization 5 (1995)); pivots of
// the latter may be negative. Time is O(size Bandwidth^2). Does not allocate once the buffers have grown.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dmrp::controllers {

// The lower triangle of a symmetric matrix whose entries are zero farther than Bandwidth from the diagonal.
template <std::size_t Bandwidth>
class BandedMatrix {
 public:
  static constexpr std::size_t bandwidth = Bandwidth;
  static constexpr std::size_t stride = Bandwidth + 1;

  void reserve(std::size_t size) { entries_.reserve(size * stride); }

  // Sets all entries to zero.
  void resize(std::size_t size) {
    size_ = size;
    entries_.assign(size * stride, 0.0);
  }

  std::size_t size() const { return size_; }

  // row - Bandwidth <= column <= row
  double& at(std::size_t row, std::size_t column) { return entries_[row * stride + Bandwidth + column - row]; }
  double at(std::size_t row, std::size_t column) const { return entries_[row * stride + Bandwidth + column - row]; }

  // The entry (i, j) or (j, i), whichever is stored.
  double& symmetric(std::size_t i, std::size_t j) { return i >= j ? at(i, j) : at(j, i); }

  // The Bandwidth + 1 entries of a row, the diagonal last. The first rows begin with unused zeros.
  double* row(std::size_t i) { return entries_.data() + i * stride; }
  const double* row(std::size_t i) const { return entries_.data() + i * stride; }

  // y = A x
  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    assert(x.size() == size_);
    y.assign(size_, 0.0);
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t first = i > Bandwidth ? i - Bandwidth : 0;
      for (std::size_t j = first; j < i; ++j) {
        y[i] += at(i, j) * x[j];
        y[j] += at(i, j) * x[i];
      }
      y[i] += at(i, i) * x[i];
    }
  }

 private:
  std::size_t size_ = 0;
  std::vector<double> entries_;
};

template <std::size_t Bandwidth>
class BandedLdlt {
 public:
  void reserve(std::size_t size) {
    factor_.reserve(size);
    inverse_pivots_.reserve(size);
  }

  // Factors A + shift I. False if a pivot is not finite or too small to divide by; solve() must not be called then.
  bool factor(const BandedMatrix<Bandwidth>& a, double shift = 0.0) {
    factor_ = a;
    negative_pivots_ = 0;
    const std::size_t size = a.size();
    inverse_pivots_.resize(size);
    std::array<double, Bandwidth> column;  // column k below the diagonal, before the division by the pivot
    for (std::size_t k = 0; k < size; ++k) {
      const double pivot = factor_.at(k, k) + shift;
      if (!(std::abs(pivot) > smallest_pivot) || !std::isfinite(pivot)) return false;
      if (pivot < 0.0) ++negative_pivots_;
      const double inverse = 1.0 / pivot;
      inverse_pivots_[k] = inverse;
      const std::size_t rows = std::min(Bandwidth, size - 1 - k);
      for (std::size_t r = 0; r < rows; ++r) column[r] = factor_.at(k + 1 + r, k);
      // updates the trailing rows: row i minus l(i, k) times the column, up to the diagonal
      for (std::size_t r = 0; r < rows; ++r) {
        if (column[r] == 0.0) continue;
        const double l = column[r] * inverse;
        factor_.at(k + 1 + r, k) = l;
        double* const row = &factor_.at(k + 1 + r, k + 1);
        for (std::size_t c = 0; c <= r; ++c) row[c] -= l * column[c];
      }
    }
    return true;
  }

  std::size_t size() const { return factor_.size(); }
  std::size_t negative_pivots() const { return negative_pivots_; }

  // Replaces the right-hand side of size() numbers by the solution.
  void solve(double* x) const {
    const std::size_t size = factor_.size();
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t first = i > Bandwidth ? i - Bandwidth : 0;
      double sum = x[i];
      for (std::size_t j = first; j < i; ++j) sum -= factor_.at(i, j) * x[j];
      x[i] = sum;
    }
    for (std::size_t i = 0; i < size; ++i) x[i] *= inverse_pivots_[i];
    for (std::size_t i = size; i-- > 1;) {
      const std::size_t first = i > Bandwidth ? i - Bandwidth : 0;
      for (std::size_t j = first; j < i; ++j) x[j] -= factor_.at(i, j) * x[i];
    }
  }
  void solve(std::vector<double>& x) const {
    assert(x.size() == size());
    solve(x.data());
  }

 private:
  static constexpr double smallest_pivot = 1e-300;

  BandedMatrix<Bandwidth> factor_;  // L below the diagonal
  std::vector<double> inverse_pivots_;
  std::size_t negative_pivots_ = 0;
};

}  // namespace dmrp::controllers
