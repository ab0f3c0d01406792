// SPDX-License-Identifier: MIT
// replay_numbers.hpp: converts numbers of a replay to integers, and encodes series of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace dmrp::host {

// A number in SI units as millimetres, milliradians or mm/s.
inline std::int64_t thousandths(double value) {
  return std::llround(value * 1000.0);
}

inline std::int64_t milliseconds(std::int64_t ns) {
  return (ns + 500'000) / 1'000'000;
}

// A series as its first value and differences.
class Deltas {
 public:
  void add(std::int64_t value) {
    differences_.push_back(value - last_);
    last_ = value;
  }
  std::size_t size() const { return differences_.size(); }
  nlohmann::json json() && { return std::move(differences_); }

 private:
  std::vector<std::int64_t> differences_;
  std::int64_t last_ = 0;
};

// A series with few changes as [sample, value, sample, value, ...], one pair for each change.
class Runs {
 public:
  void add(std::size_t sample, std::int64_t value) {
    if (!runs_.empty() && runs_.back() == value) return;
    runs_.push_back(static_cast<std::int64_t>(sample));
    runs_.push_back(value);
  }
  nlohmann::json json() && { return std::move(runs_); }

 private:
  std::vector<std::int64_t> runs_;
};

}  // namespace dmrp::host
