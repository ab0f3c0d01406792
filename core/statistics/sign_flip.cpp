// SPDX-License-Identifier: MIT
#include "core/statistics/sign_flip.hpp"

#include <bit>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t most_exact_differences = 20;  // other than zero
constexpr std::uint64_t draws = 10'000;
constexpr double equal_within = 1e-9;  // of the sum of absolute differences

// The last sign is fixed: flipping all signs gives a mean equally far from zero. Gray's code flips one sign per step.
double exact_share(std::span<const double> differences, double least) {
  double sum = 0.0;
  for (const double difference : differences) sum += difference;
  std::vector<double> twice;  // the decrease of the sum when a sign flips
  for (const double difference : differences) twice.push_back(2.0 * difference);
  const std::uint64_t ways = std::uint64_t{1} << (differences.size() - 1);
  std::uint64_t as_far = 0;
  for (std::uint64_t way = 1;; ++way) {
    if (std::abs(sum) >= least) ++as_far;
    if (way == ways) break;
    double& flipped = twice[static_cast<std::size_t>(std::countr_zero(way))];
    sum -= flipped;
    flipped = -flipped;
  }
  return static_cast<double>(as_far) / static_cast<double>(ways);
}

double drawn_share(std::span<const double> differences, double least, std::uint64_t seed) {
  toolkit::Stream random(seed, "statistics.sign_flip");
  std::uint64_t as_far = 1;
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    double sum = 0.0;
    std::uint64_t signs = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      if (i % 64 == 0) signs = random.next_u64();
      sum += (signs & 1) != 0 ? differences[i] : -differences[i];
      signs >>= 1;
    }
    if (std::abs(sum) >= least) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(draws + 1);
}

}  // namespace

SignFlipTest sign_flip_test(std::span<const double> differences, std::uint64_t seed) {
  if (differences.empty()) return {undefined, undefined, true};
  std::vector<double> other_than_zero;
  double sum = 0.0;
  double size = 0.0;
  for (const double difference : differences) {
    if (difference != 0.0) other_than_zero.push_back(difference);
    sum += difference;
    size += std::abs(difference);
  }
  const double average = mean(differences);
  if (other_than_zero.empty()) return {average, 1.0, true};
  const double least = std::abs(sum) - equal_within * size;
  if (other_than_zero.size() > most_exact_differences)
    return {average, drawn_share(other_than_zero, least, seed), false};
  return {average, exact_share(other_than_zero, least), true};
}

}  // namespace dmrp::core
