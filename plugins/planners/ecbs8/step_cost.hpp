// SPDX-License-Identifier: MIT
// step_cost.hpp: the costs of steps as integers, so that sums are exact and do not depend on their order.
#pragma once

#include <cmath>
#include <cstdint>

#include "planners/mapf/problem.hpp"

namespace dmrp::planners::ecbs8 {

using Graph = BasicGridGraph<8>;
using Problem = BasicProblem<8>;

// In units of 2^-29 of a straight step: sqrt(2) comes within 10^-11 of its value, and two sums of up to 100,000 steps
// compare as the true ones do.
using Cost = std::int64_t;

constexpr Cost straight_cost = Cost{1} << 29;
constexpr Cost diagonal_cost = 759250125;
constexpr Cost wait_cost = straight_cost;

// Greater than the cost of any path. Two of it can be added without overflow.
constexpr Cost unreachable = Cost{1} << 60;

constexpr Cost step_cost(Direction d) {
  return Graph::is_diagonal(d) ? diagonal_cost : straight_cost;
}

// In straight steps; exact for all costs below 2^24 of them.
inline double as_number(Cost cost) {
  return static_cast<double>(cost) / static_cast<double>(straight_cost);
}

// The factor by which a cost may exceed its lower bound, rounded down to a multiple of 2^-24. Limits are integers, and
// a sum of limits never exceeds the limit of the sum.
class Suboptimality {
 public:
  explicit Suboptimality(double factor) : factor_(static_cast<Cost>(std::floor(factor * (1 << fraction_bits)))) {}

  Cost limit(Cost lower_bound) const {
    const Cost low = lower_bound & ((Cost{1} << fraction_bits) - 1);
    return (lower_bound >> fraction_bits) * factor_ + (low * factor_ >> fraction_bits);
  }

 private:
  static constexpr int fraction_bits = 24;
  Cost factor_;
};

}  // namespace dmrp::planners::ecbs8
