// SPDX-License-Identifier: MIT
// sums.hpp: sums and moments that stay accurate over many small terms. They depend on the order of the calls.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace dmrp::metrics {

// Neumaier's compensated sum: its error does not grow with the number of terms.
class CompensatedSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    lost_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

// Time-weighted mean and standard deviation of a quantity that has `value` for `duration_ns`. West's algorithm (1979):
// one pass, without the cancellation of a sum of squares.
class TimeMoments {
 public:
  void add(double value, std::int64_t duration_ns) {
    if (duration_ns <= 0) return;
    total_ns_ += duration_ns;
    const double weight = static_cast<double>(duration_ns);
    const double before = value - mean_;
    mean_ += before * (weight / static_cast<double>(total_ns_));
    squares_ += weight * before * (value - mean_);
  }

  // NaN if no time was added.
  double mean() const { return total_ns_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(); }
  double standard_deviation() const {
    if (total_ns_ == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::sqrt(std::fmax(0.0, squares_) / static_cast<double>(total_ns_));
  }

 private:
  std::int64_t total_ns_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

// The mean of the values that are not NaN; NaN if there are none.
inline double mean_of_defined(const std::vector<double>& values) {
  CompensatedSum sum;
  std::size_t count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum.add(value);
    ++count;
  }
  return count > 0 ? sum.value() / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace dmrp::metrics
