// SPDX-License-Identifier: MIT
#include "core/statistics/level_effects.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

namespace level_effects_test {

using namespace dmrp::core;

using Values = std::vector<std::vector<double>>;

// Levels that differ by their shifts alone, on observations that differ.
Values drawn(std::uint64_t seed, std::size_t observations, const std::vector<double>& shifts) {
  dmrp::toolkit::Stream stream(seed, "level_effects_test");
  Values values(shifts.size());
  for (std::size_t i = 0; i < observations; ++i) {
    const double hard = stream.uniform(0.0, 1.0);
    for (std::size_t l = 0; l < shifts.size(); ++l) values[l].push_back(shifts[l] + hard + stream.uniform(-0.2, 0.2));
  }
  return values;
}

TEST_CASE("an effect is a level's difference from the mean of the others", "[statistics]") {
  const Values values = {
      {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {2.0, 3.0, 4.0, 5.0, 6.0, 8.0}, {0.0, 1.0, 2.0, 3.0, 4.0, 4.0}};
  const auto effects = level_effects(values);
  REQUIRE(effects.size() == 3);
  CHECK(effects[0].mean == Approx(0.0));
  CHECK(effects[1].mean == Approx((28.0 - (21.0 + 14.0) / 2.0) / 6.0));
  CHECK(effects[1].mean + effects[2].mean + effects[0].mean == Approx(0.0).margin(1e-12));
  CHECK(effects[1].interval.low > 0.0);
  CHECK(effects[2].interval.high < 0.0);
}

TEST_CASE("p and interval say the same", "[statistics]") {
  std::size_t excluded = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (const LevelEffect& effect : level_effects(drawn(seed, 6 + seed % 12, {0.0, 0.0, 0.1}), seed)) {
      const bool excludes = effect.interval.low > 0.0 || effect.interval.high < 0.0;
      CHECK(excludes == (effect.p <= 0.05));
      excluded += excludes;
    }
  CHECK(excluded > 10);
}

TEST_CASE("levels that are alike have an effect in about one of twenty benchmarks", "[statistics]") {
  constexpr int benchmarks = 400;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= benchmarks; ++seed) {
    bool any = false;
    for (const LevelEffect& effect : level_effects(drawn(1000 + seed, 20, {0.0, 0.0, 0.0, 0.0}), seed))
      any = any || effect.p <= 0.05;
    found += any;
  }
  CHECK(found <= 0.08 * benchmarks);  // 0.05 and two and a half standard errors
}

TEST_CASE("too few observations show no effect, and undefined ones do not count", "[statistics]") {
  CHECK(level_effects({{1.0, 2.0, 3.0, 4.0, 5.0}, {0.0, 0.0, 0.0, 0.0, 0.0}}).empty());
  CHECK(level_effects({{1.0}}).empty());
  Values values = drawn(3, 6, {0.0, 1.0});
  values[1][2] = std::nan("");
  CHECK(level_effects(values).empty());
  CHECK(level_effects({std::vector<double>(8, 1.0), std::vector<double>(8, 1.0)})[0].p == 1.0);
}

}  // namespace level_effects_test
