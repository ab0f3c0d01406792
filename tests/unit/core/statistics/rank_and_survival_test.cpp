// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <vector>

#include "core/statistics/kaplan_meier.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "core/statistics/ranks.hpp"

namespace rank_and_survival_test {

using namespace dmrp::core;

using Values = std::vector<std::vector<double>>;  // [entry][task]

RankCorrelation correlation(const Values& x, const Values& y) {
  const Resampling resampling(std::vector<std::uint32_t>(x.front().size()), Scope::these_worlds, 500);
  return task_rank_correlation(x, y, resampling);
}

// Freireich et al., Blood 21 (1963): weeks of remission under 6-MP and placebo, the data of most textbooks.
std::vector<TimeToEvent> freireich_6mp() {
  std::vector<TimeToEvent> cases;
  for (const double time : {6, 6, 6, 7, 10, 13, 16, 22, 23}) cases.push_back({time, true});
  for (const double time : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) cases.push_back({time, false});
  return cases;
}

TEST_CASE("midranks", "[statistics]") {
  CHECK(doubled_midranks(std::vector<double>{3, 1, 3, 2}) == std::vector<std::int64_t>{7, 2, 7, 4});
  CHECK(doubled_midranks(std::vector<double>{5, 5, 5}) == std::vector<std::int64_t>{4, 4, 4});
  CHECK(doubled_midranks(std::vector<double>{1.0, 1.05, 2.0}, 0.1) == std::vector<std::int64_t>{3, 3, 6});
  CHECK(doubled_midranks({}).empty());
}

TEST_CASE("Spearman's rank correlation agrees with its textbook examples", "[statistics]") {
  SECTION("Siegel, Nonparametric Statistics 1956: authoritarianism and striving for status, 0.82") {
    const std::vector<double> authoritarianism{2, 6, 5, 1, 10, 9, 8, 3, 4, 12, 7, 11};
    const std::vector<double> striving{3, 4, 2, 1, 8, 11, 10, 6, 7, 12, 5, 9};
    CHECK(correlation({authoritarianism}, {striving}).rho == Approx(1.0 - 6.0 * 52.0 / (12.0 * 143.0)).epsilon(1e-12));
  }
  SECTION("with ties as Siegel corrects for them: by the sum of squared differences of midranks") {
    const std::vector<double> striving{42, 46, 39, 37, 65, 88, 86, 56, 62, 92, 54, 81};
    const std::vector<double> yielding{0, 0, 1, 1, 3, 4, 5, 6, 7, 8, 8, 12};
    const double of_x = 12.0 * 143.0 / 12.0;                     // no ties
    const double of_y = 12.0 * 143.0 / 12.0 - 3.0 * 6.0 / 12.0;  // three pairs: (2^3 - 2) / 12 each
    const double squared_differences = 109.5;
    const RankCorrelation found = correlation({striving}, {yielding});
    CHECK(found.rho == Approx((of_x + of_y - squared_differences) / (2.0 * std::sqrt(of_x * of_y))).epsilon(1e-12));
    CHECK(found.ties_share == Approx(3.0 / 66.0));
  }
}

TEST_CASE("the p value of a rank correlation counts permutations of tasks", "[statistics]") {
  SECTION("of one entry: as the table of Kendall and Gibbons") {
    // n = 9: |rho| >= 0.700 at 5 %, 0.833 at 1 %; here 0.85
    const RankCorrelation found = correlation({{1, 2, 3, 4, 5, 6, 7, 8, 9}}, {{3, 1, 2, 6, 4, 5, 9, 7, 8}});
    CHECK(found.rho == Approx(1.0 - 6.0 * 18.0 / 720.0));
    CHECK(found.p < 0.01 + 0.004);
    CHECK(found.p > 0.001);
  }
  SECTION("one for all entries: the same values twice are no more evidence than once") {
    const std::vector<double> x{1, 2, 3, 4, 5, 6, 7, 8};
    const std::vector<double> y{2, 1, 4, 3, 8, 5, 7, 6};
    const RankCorrelation once = correlation({x}, {y});
    const RankCorrelation four_times = correlation({x, x, x, x}, {y, y, y, y});
    CHECK(four_times.n == 8);
    CHECK(four_times.rho == Approx(once.rho));
    CHECK(four_times.p == once.p);
    CHECK(four_times.interval.low == once.interval.low);
  }
  SECTION("differences between entries alone are no evidence") {
    const Values x{{1, 2, 3, 4, 5, 6}, {101, 102, 103, 104, 105, 106}};
    const Values y{{1, 2, 3, 4, 5, 6}, {106, 105, 104, 103, 102, 101}};
    CHECK(correlation(x, y).rho == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("a rank correlation's interval holds it, and is narrower with more tasks", "[statistics]") {
  dmrp::toolkit::Stream random(7, "rank_and_survival_test");
  const auto drawn = [&](std::size_t tasks) {
    Values x(1);
    Values y(1);
    for (std::size_t i = 0; i < tasks; ++i) {
      x[0].push_back(random.normal());
      y[0].push_back(x[0].back() + 0.5 * random.normal());
    }
    return correlation(x, y);
  };
  const RankCorrelation few = drawn(20);
  const RankCorrelation many = drawn(200);
  CHECK(few.interval.low < few.rho);
  CHECK(few.interval.high > few.rho);
  CHECK(many.interval.high - many.interval.low < 0.5 * (few.interval.high - few.interval.low));
}

TEST_CASE("an undefined rank correlation", "[statistics]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RankCorrelation five = correlation({{1, 2, 3, 4, 5, 6}}, {{1, 2, 3, 4, 5, nan}});
  CHECK(five.n == 5);
  CHECK(std::isnan(five.rho));
  CHECK(std::isnan(five.p));
  CHECK(std::isnan(correlation({{1, 2, 3, 4, 5, 6}}, {{4, 4, 4, 4, 4, 4}}).rho));
  // six tasks with a pair, five in each entry
  const RankCorrelation gaps =
      correlation({{1, 2, 3, 4, 5, nan}, {nan, 2, 3, 4, 5, 6}}, {{1, 2, 3, 4, 5, 6}, {1, 2, 3, 4, 5, 6}});
  CHECK(gaps.n == 6);
  CHECK(gaps.rho == Approx(1.0));
  CHECK(gaps.p < 0.05);
}

TEST_CASE("Kaplan and Meier's estimate of Freireich's remissions", "[statistics]") {
  const std::vector<SurvivalStep> steps = kaplan_meier(freireich_6mp());
  // Kleinbaum and Klein, Survival Analysis, table 2.2
  const std::vector<SurvivalStep> published{{6, 0.8571},  {7, 0.8067},  {10, 0.7529}, {13, 0.6902},
                                            {16, 0.6275}, {22, 0.5378}, {23, 0.4482}};
  REQUIRE(steps.size() == published.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CHECK(steps[i].time == published[i].time);
    CHECK(steps[i].share == Approx(published[i].share).margin(5e-5));
  }
  CHECK(kaplan_meier({}).empty());
}

}  // namespace rank_and_survival_test
