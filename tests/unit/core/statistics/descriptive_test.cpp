// SPDX-License-Identifier: MIT
#include "core/statistics/descriptive.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

namespace descriptive_test {

using namespace dmrp::core;

std::vector<double> repeated(double value, std::size_t count) {
  return std::vector<double>(count, value);
}

TEST_CASE("mean, standard deviation and median", "[statistics]") {
  const std::array<double, 8> values{2, 4, 4, 4, 5, 5, 7, 9};
  CHECK(mean(values) == 5.0);
  CHECK(sample_sd(values) == Approx(std::sqrt(32.0 / 7.0)).epsilon(1e-15));
  CHECK(median(values) == 4.5);
  CHECK(median(std::array<double, 3>{9, 1, 2}) == 2.0);
}

TEST_CASE("too few values give NaN", "[statistics]") {
  const std::vector<double> none;
  const std::array<double, 1> one{3.0};
  CHECK(std::isnan(mean(none)));
  CHECK(std::isnan(median(none)));
  CHECK(std::isnan(sample_sd(one)));
  CHECK(mean(one) == 3.0);
}

TEST_CASE("quantiles lie linearly between the values", "[statistics]") {
  const std::array<double, 5> values{0, 10, 20, 30, 40};
  CHECK(quantile_of_sorted(values, 0.0) == 0.0);
  CHECK(quantile_of_sorted(values, 1.0) == 40.0);
  CHECK(quantile_of_sorted(values, 0.1) == Approx(4.0));
  CHECK(quantile_of_sorted(values, 0.625) == Approx(25.0));
}

TEST_CASE("the paper's mean", "[statistics]") {
  SECTION("excludes values farther than two standard deviations") {
    // 1, ..., 9 and 100: mean 14.5, deviation 30.22, so that 100 goes and 5 is the mean of the rest
    const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 100};
    const TrimmedMean trimmed = paper_mean(values);
    CHECK(trimmed.mean == 5.0);
    CHECK(trimmed.count == 9);
    CHECK_FALSE(trimmed.trimmed_all_nonzero);
  }
  SECTION("passes once only") {
    // 0 eight times, 10, 1000: mean 101, deviation 315.9: 1000 goes. A second pass (mean 1.11, deviation 3.33) would
    // take 10 as well
    std::vector<double> values = repeated(0.0, 8);
    values.insert(values.end(), {10.0, 1000.0});
    const TrimmedMean trimmed = paper_mean(values);
    CHECK(trimmed.count == 9);
    CHECK(trimmed.mean == Approx(10.0 / 9.0));
  }
  SECTION("excludes no value of fewer than five") {
    // of four values none is ever farther than 1.5 deviations; the rule holds anyway
    const std::vector<double> values{0, 0, 0, 100};
    CHECK(paper_mean(values).mean == 25.0);
    CHECK(paper_mean(values).count == 4);
  }
  SECTION("of five values keeps the far one: it is at 1.79 deviations") {
    const std::vector<double> values{0, 0, 0, 0, 100};
    CHECK(paper_mean(values).count == 5);
  }
  SECTION("reports that a rare event is trimmed: in 3 of 20 trials, but not in 4") {
    // k of n ones: the ones lie sqrt((n - 1)(n - k) / (n k)) deviations off: 2.32 for 3 of 20, 1.95 for 4
    std::vector<double> three = repeated(0.0, 17);
    three.resize(20, 1.0);
    CHECK(paper_mean(three).trimmed_all_nonzero);
    CHECK(paper_mean(three).mean == 0.0);
    CHECK(paper_mean(three).count == 17);
    std::vector<double> four = repeated(0.0, 16);
    four.resize(20, 1.0);
    CHECK_FALSE(paper_mean(four).trimmed_all_nonzero);
    CHECK(paper_mean(four).mean == 0.2);
  }
  SECTION("does not report it if all values are zero") {
    CHECK_FALSE(paper_mean(repeated(0.0, 20)).trimmed_all_nonzero);
  }
  SECTION("of nothing is NaN") {
    CHECK(std::isnan(paper_mean({}).mean));
    CHECK(paper_mean({}).count == 0);
  }
}

}  // namespace descriptive_test
