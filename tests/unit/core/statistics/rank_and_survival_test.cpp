// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <numeric>
#include <vector>

#include "core/statistics/kaplan_meier.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "core/statistics/ranks.hpp"

using namespace dmrp::core;

namespace {

std::vector<std::uint64_t> each_its_own(std::size_t count) {
  std::vector<std::uint64_t> clusters(count);
  std::iota(clusters.begin(), clusters.end(), std::uint64_t{0});
  return clusters;
}

// Freireich et al., Blood 21 (1963): weeks of remission under 6-MP and placebo, the data of most textbooks.
std::vector<TimeToEvent> freireich_6mp() {
  std::vector<TimeToEvent> cases;
  for (const double time : {6, 6, 6, 7, 10, 13, 16, 22, 23}) cases.push_back({time, true, cases.size()});
  for (const double time : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) cases.push_back({time, false, cases.size()});
  return cases;
}

}  // namespace

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
    CHECK(rank_correlation(authoritarianism, striving, each_its_own(12)).rho ==
          Approx(1.0 - 6.0 * 52.0 / (12.0 * 143.0)).epsilon(1e-12));
  }
  SECTION("with ties as Siegel corrects for them: by the sum of squared differences of midranks") {
    const std::vector<double> striving{42, 46, 39, 37, 65, 88, 86, 56, 62, 92, 54, 81};
    const std::vector<double> yielding{0, 0, 1, 1, 3, 4, 5, 6, 7, 8, 8, 12};
    const double of_x = 12.0 * 143.0 / 12.0;                     // no ties
    const double of_y = 12.0 * 143.0 / 12.0 - 3.0 * 6.0 / 12.0;  // three pairs: (2^3 - 2) / 12 each
    const double squared_differences = 109.5;
    CHECK(rank_correlation(striving, yielding, each_its_own(12)).rho ==
          Approx((of_x + of_y - squared_differences) / (2.0 * std::sqrt(of_x * of_y))).epsilon(1e-12));
  }
}

TEST_CASE("the p value of a rank correlation counts permutations", "[statistics]") {
  SECTION("all permutations of a few values") {
    const std::vector<double> x{1, 2, 3, 4};
    // of 24 orders only the rising and the falling one have |rho| = 1
    CHECK(rank_correlation(x, x, each_its_own(4)).p == Approx(2.0 / 24.0));
    CHECK(rank_correlation(x, x, each_its_own(4)).exact);
    // 1, 2, 4, 3: rho 0.8; as far: 4 + 4 with |rho| >= 0.8 (one swap of neighbours, or none)
    CHECK(rank_correlation(x, std::vector<double>{1, 2, 4, 3}, each_its_own(4)).p == Approx(8.0 / 24.0));
  }
  SECTION("drawn permutations approximate all") {
    // n = 9 in Kendall and Gibbons' table: |rho| >= 0.700 at 5 %, 0.833 at 1 %
    const std::vector<double> x{1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::vector<double> y{3, 1, 2, 6, 4, 5, 9, 7, 8};  // sum of squared differences 18: rho 0.85
    const RankCorrelation found = rank_correlation(x, y, each_its_own(9));
    CHECK_FALSE(found.exact);
    CHECK(found.rho == Approx(1.0 - 6.0 * 18.0 / 720.0));
    CHECK(found.p < 0.01 + 0.004);
    CHECK(found.p > 0.001);
    CHECK(rank_correlation(x, y, each_its_own(9)).p == found.p);
    CHECK(rank_correlation(x, y, each_its_own(9), std::vector<std::uint32_t>(9, 4)).p == found.p);
  }
  SECTION("within blocks, whose differences alone are no evidence") {
    const std::vector<double> x{1, 2, 3, 11, 12, 13};
    const std::vector<double> y{3, 1, 2, 13, 11, 12};
    const std::vector<std::uint32_t> block{0, 0, 0, 1, 1, 1};
    const RankCorrelation found = rank_correlation(x, y, each_its_own(6), block);
    // products of a block's centered ranks: -1 here, of at most 2; of its six orders 2, 1, 1, -1, -1, -2. Of the 36 sums
    // of two, 18 are at least as far from 0 as -2
    CHECK(found.rho == Approx(-0.5));
    CHECK_FALSE(found.exact);
    CHECK(found.p == Approx(0.5).margin(0.03));
    CHECK(rank_correlation(x, y, each_its_own(6)).rho == Approx(1.0 - 6.0 * 12.0 / 210.0));
    CHECK(rank_correlation(x, y, each_its_own(6)).p < 0.2);
    // no block has two
    CHECK(std::isnan(rank_correlation(x, y, each_its_own(6), std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}).rho));
  }
  SECTION("pairs of different blocks are neither ordered nor tied") {
    const std::vector<double> x{1, 2, 3, 1, 2, 3};
    const std::vector<double> y{1, 2, 3, 30, 10, 20};
    const RankCorrelation found = rank_correlation(x, y, std::vector<std::uint64_t>{1, 2, 3, 1, 2, 3},
                                                   std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1});
    CHECK(found.rho == Approx((8.0 - 4.0) / 16.0));
    CHECK(found.ties_share == 0.0);
    CHECK(found.interval.low <= found.rho);
    CHECK(found.interval.high >= found.rho);
  }
}

TEST_CASE("a rank correlation's interval", "[statistics]") {
  dmrp::toolkit::Stream random(7, "rank_and_survival_test");
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t i = 0; i < 80; ++i) {
    x.push_back(random.normal());
    y.push_back(x.back() + 0.5 * random.normal());
    seeds.push_back(i / 4);
  }
  const RankCorrelation found = rank_correlation(x, y, seeds);
  CHECK(found.interval.low < found.rho);
  CHECK(found.interval.high > found.rho);
  CHECK(found.interval.low > 0.7);
  CHECK(found.ties_share == 0.0);

  SECTION("does not shrink if every observation occurs four times in its seed") {
    std::vector<double> x_fourfold;
    std::vector<double> y_fourfold;
    std::vector<std::uint64_t> seed_fourfold;
    std::vector<double> x_once(x.begin(), x.begin() + 20);
    std::vector<double> y_once(y.begin(), y.begin() + 20);
    for (std::uint64_t i = 0; i < 80; ++i) {
      x_fourfold.push_back(x_once[i / 4]);
      y_fourfold.push_back(y_once[i / 4]);
      seed_fourfold.push_back(i / 4);
    }
    const RankCorrelation once = rank_correlation(x_once, y_once, each_its_own(20));
    const RankCorrelation fourfold = rank_correlation(x_fourfold, y_fourfold, seed_fourfold);
    CHECK(fourfold.rho == Approx(once.rho));
    CHECK(fourfold.interval.low == Approx(once.interval.low));
    CHECK(fourfold.interval.high == Approx(once.interval.high));
    CHECK(fourfold.ties_share == Approx(20.0 * 6.0 / (80.0 * 79.0 / 2.0)));
  }
}

TEST_CASE("an undefined rank correlation", "[statistics]") {
  CHECK(std::isnan(rank_correlation({}, {}, {}).rho));
  CHECK(rank_correlation({}, {}, {}).n == 0);
  const RankCorrelation constant =
      rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{4, 4, 4}, each_its_own(3));
  CHECK(std::isnan(constant.rho));
  CHECK(std::isnan(constant.p));
  CHECK(constant.ties_share == 1.0);
  const RankCorrelation one_seed =
      rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{4, 5, 6}, std::vector<std::uint64_t>{9, 9, 9});
  CHECK(one_seed.rho == Approx(1.0));
  CHECK(std::isnan(one_seed.interval.low));
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
}

TEST_CASE("the restricted mean", "[statistics]") {
  SECTION("of Freireich's remissions to 35 weeks: the area under the steps, by hand") {
    const double area = 6.0 + 1.0 * 18.0 / 21.0 + 3.0 * 0.8067226890756303 + 3.0 * 0.7529411764705882 +
                        3.0 * 0.6901960784313725 + 6.0 * 0.6274509803921569 + 1.0 * 0.5378151260504203 +
                        12.0 * 0.4481792717086836;
    CHECK(restricted_mean(freireich_6mp(), 35.0) == Approx(area).epsilon(1e-12));
    CHECK(restricted_mean(freireich_6mp(), 35.0) == Approx(23.287).margin(5e-4));  // survfit's rmean
  }
  SECTION("of times without censoring is their mean: placebo, 8.667 weeks") {
    std::vector<TimeToEvent> placebo;
    for (const double time : {1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23})
      placebo.push_back({time, true, placebo.size()});
    CHECK(restricted_mean(placebo, 23.0) == Approx(182.0 / 21.0));
    CHECK(restricted_mean(placebo, 8.0) == Approx((1 + 1 + 2 + 2 + 3 + 4 + 4 + 5 + 5 + 12 * 8) / 21.0));
  }
  SECTION("counts a robot that never arrives until the horizon") {
    const std::vector<TimeToEvent> robots{{40.0, true, 0}, {60.0, true, 0}, {180.0, false, 1}, {180.0, false, 1}};
    CHECK(restricted_mean(robots, 180.0) == Approx((40.0 + 60.0 + 180.0 + 180.0) / 4.0));
    const Interval interval = restricted_mean_interval(robots, 180.0);
    CHECK(interval.low == Approx(50.0));    // both draws the first seed: one in four
    CHECK(interval.high == Approx(180.0));  // both the second
  }
  SECTION("without cases") {
    CHECK(std::isnan(restricted_mean({}, 10.0)));
    CHECK(kaplan_meier({}).empty());
    CHECK(std::isnan(restricted_mean_interval(std::vector<TimeToEvent>{{1.0, true, 3}}, 10.0).low));
  }
}
