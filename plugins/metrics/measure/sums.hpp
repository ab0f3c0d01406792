// SPDX-License-Identifier: MIT
// sums.hpp: sums over time: accurate over many small terms, or of integers, so that only the last division rounds.
// They depend on the order of the calls.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

// Rounds once, so that 0.3 s is the double nearest to 0.3.
inline double in_seconds(std::int64_t ns) {
  return static_cast<double>(ns) / 1e9;
}

// NaN if no time was measured.
inline double percent_of(std::int64_t part_ns, std::int64_t whole_ns) {
  return whole_ns > 0 ? 100.0 * static_cast<double>(part_ns) / static_cast<double>(whole_ns) : undefined;
}

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
  double mean() const { return total_ns_ > 0 ? mean_ : undefined; }
  double standard_deviation() const {
    return total_ns_ > 0 ? std::sqrt(std::fmax(0.0, squares_) / static_cast<double>(total_ns_)) : undefined;
  }

 private:
  std::int64_t total_ns_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

// The integral over time of a count, or of a condition: 1 while it holds. NaN if no time was added.
class TimeCount {
 public:
  void add(std::int64_t count, std::int64_t duration_ns) {
    counted_ns_ += count * duration_ns;
    whole_ns_ += duration_ns;
  }

  double seconds() const { return whole_ns_ > 0 ? in_seconds(counted_ns_) : undefined; }
  double mean() const {
    return whole_ns_ > 0 ? static_cast<double>(counted_ns_) / static_cast<double>(whole_ns_) : undefined;
  }
  double percent() const { return percent_of(counted_ns_, whole_ns_); }

 private:
  std::int64_t counted_ns_ = 0;
  std::int64_t whole_ns_ = 0;
};

// The length of a union of time spans, which must be added in the order of their beginnings.
class UnionLength {
 public:
  void add(std::int64_t from_ns, std::int64_t to_ns) {
    length_ns_ += std::max<std::int64_t>(0, to_ns - std::max(from_ns, covered_to_ns_));
    covered_to_ns_ = std::max(covered_to_ns_, to_ns);
  }
  std::int64_t value_ns() const { return length_ns_; }

 private:
  std::int64_t covered_to_ns_ = INT64_MIN;
  std::int64_t length_ns_ = 0;
};

}  // namespace dmrp::metrics
