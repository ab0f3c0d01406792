// SPDX-License-Identifier: MIT
// replay_numbers.hpp: numbers of a replay: integers, and the two ways in which many of them are written.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace dmrp::host {

// Millimetres, milliradians, mm/s of a number in SI units.
inline std::int64_t thousandths(double value) {
  return std::llround(value * 1000.0);
}

inline std::int64_t milliseconds(std::int64_t ns) {
  return (ns + 500'000) / 1'000'000;
}

// A series that changes little from sample to sample: the first value, then differences.
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

// A series that seldom changes: [sample, value, sample, value, ...], a pair where a new value begins.
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
