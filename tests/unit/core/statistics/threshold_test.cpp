// SPDX-License-Identifier: MIT
// Thresholds of graded tests, against values worked out by hand.
#include "core/statistics/threshold.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>

namespace threshold_test {

using namespace dmrp::core;

// `successes` of `count` at a level.
LevelOutcomes outcomes(double level, int successes, int count) {
  LevelOutcomes out{level, {}};
  for (int i = 0; i < count; ++i) out.by_repetition.push_back(i < successes ? 1.0 : 0.0);
  return out;
}

Resampling repetitions(std::size_t count) {
  return {std::vector<std::uint32_t>(count), Scope::these_worlds, 400};
}

TEST_CASE("isotonic fit: violators are pooled by weight") {
  const std::vector<double> ones(6, 1.0);
  CHECK(isotonic_fit(std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, ones) == std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  // Barlow et al.: 3, 1 -> 2, 2; then 5, 4, 3 -> 4, 4, 4
  CHECK(isotonic_fit(std::vector{3.0, 1.0, 5.0, 4.0, 3.0, 7.0}, ones) == std::vector{2.0, 2.0, 4.0, 4.0, 4.0, 7.0});
  const auto weighted = isotonic_fit(std::vector{4.0, 1.0}, std::vector{2.0, 1.0});
  CHECK(weighted[0] == Approx(3.0));
  CHECK(weighted[1] == Approx(3.0));
}

TEST_CASE("isotonic fit: no other non-decreasing sequence is nearer") {
  dmrp::toolkit::Stream stream(3, "test.isotonic");
  for (int round = 0; round < 50; ++round) {
    std::vector<double> values(5), weights(5);
    for (std::size_t i = 0; i < 5; ++i) {
      values[i] = static_cast<double>(stream.below(5));
      weights[i] = 1.0 + static_cast<double>(stream.below(3));
    }
    const auto distance = [&](const std::vector<double>& fit) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 5; ++i) sum += weights[i] * (fit[i] - values[i]) * (fit[i] - values[i]);
      return sum;
    };
    const auto fit = isotonic_fit(values, weights);
    for (std::size_t i = 1; i < 5; ++i) CHECK(fit[i - 1] <= fit[i]);
    // all non-decreasing sequences of quarters of 0 to 4
    for (int a = 0; a <= 16; ++a)
      for (int b = a; b <= 16; ++b)
        for (int c = b; c <= 16; ++c)
          for (int d = c; d <= 16; ++d)
            for (int e = d; e <= 16; ++e)
              if (distance({a / 4.0, b / 4.0, c / 4.0, d / 4.0, e / 4.0}) < distance(fit) - 1e-9) FAIL("nearer");
  }
}

TEST_CASE("the threshold lies where the fit reaches one half") {
  // shares 0.1, 0.3, 0.8, 1: between 0.7 and 0.75, at 0.7 + 0.05 * (0.5 - 0.3) / (0.8 - 0.3) = 0.72
  const std::vector<LevelOutcomes> doors = {outcomes(0.65, 2, 20), outcomes(0.7, 6, 20), outcomes(0.75, 16, 20),
                                            outcomes(0.8, 20, 20)};
  const Threshold threshold = half_threshold(doors);
  CHECK(threshold.level == Approx(0.72));
  CHECK_FALSE(threshold.beyond_hardest);
  CHECK_FALSE(threshold.beyond_easiest);
  // levels that fall: harder when higher. 0.6, 0.2 are pooled to 0.4: 1.0 - 0.4 * (0.5 - 0.4) / (0.9 - 0.4) = 0.52
  const std::vector<LevelOutcomes> crowds = {outcomes(2.0, 12, 20), outcomes(1.0, 4, 20), outcomes(0.6, 18, 20)};
  CHECK(half_threshold(crowds).level == Approx(1.0 - 0.4 * 0.2));
  // exactly one half at a level
  CHECK(half_threshold(std::vector{outcomes(1, 0, 4), outcomes(2, 2, 4), outcomes(3, 4, 4)}).level == Approx(2.0));
}

TEST_CASE("a threshold beyond the levels is said to be so") {
  CHECK(half_threshold(std::vector{outcomes(0.65, 12, 20), outcomes(0.7, 20, 20)}).beyond_hardest);
  CHECK(half_threshold(std::vector{outcomes(0.65, 12, 20), outcomes(0.7, 20, 20)}).level == 0.65);
  const ThresholdEstimate never =
      estimate_threshold(std::vector{outcomes(0.65, 0, 20), outcomes(0.7, 0, 20)}, repetitions(20));
  CHECK(never.threshold.beyond_easiest);
  CHECK(never.low.beyond_easiest);
  CHECK(never.high.level == 0.7);
}

TEST_CASE("a steep threshold is a bracket") {
  const auto bracket = [](const std::vector<LevelOutcomes>& levels) {
    return estimate_threshold(levels, repetitions(20)).bracket;
  };
  const ThresholdBracket steep = bracket({outcomes(0.6, 0, 20), outcomes(0.7, 0, 20), outcomes(0.8, 20, 20)});
  CHECK(steep.last_failed == 0.7);
  CHECK(steep.first_passed == 0.8);
  CHECK(steep.is_steep);
  CHECK_FALSE(bracket({outcomes(0.6, 0, 20), outcomes(0.7, 1, 20), outcomes(0.8, 20, 20)}).is_steep);
  const ThresholdBracket passed = bracket({outcomes(0.6, 20, 20), outcomes(0.7, 20, 20)});
  CHECK_FALSE(passed.last_failed);
  CHECK(passed.first_passed == 0.6);
  CHECK_FALSE(passed.is_steep);
  CHECK_FALSE(bracket({outcomes(0.6, 0, 20)}).first_passed);
}

TEST_CASE("a level without trials says nothing") {
  LevelOutcomes missing{0.7, std::vector<double>(20, std::numeric_limits<double>::quiet_NaN())};
  const std::vector<LevelOutcomes> doors = {outcomes(0.6, 0, 20), missing, outcomes(0.8, 20, 20)};
  CHECK(half_threshold(doors).level == Approx(0.7));
}

TEST_CASE("the interval holds the threshold of the curve that trials are drawn from about 95 times of 100") {
  // success with probability level / 10 at levels 1 to 9: one half at 5
  int covered = 0;
  constexpr int rounds = 200;
  for (int round = 0; round < rounds; ++round) {
    dmrp::toolkit::Stream stream(static_cast<std::uint64_t>(round), "test.threshold");
    std::vector<LevelOutcomes> levels;
    for (int level = 1; level <= 9; ++level) {
      levels.push_back({static_cast<double>(level), {}});
      for (int i = 0; i < 40; ++i) levels.back().by_repetition.push_back(stream.chance(level / 10.0) ? 1.0 : 0.0);
    }
    const ThresholdEstimate estimate = estimate_threshold(levels, repetitions(40));
    covered += estimate.low.level <= 5.0 && estimate.high.level >= 5.0;
  }
  CHECK(covered >= rounds * 88 / 100);
  CHECK(covered <= rounds * 99 / 100);
}

}  // namespace threshold_test
