// SPDX-License-Identifier: MIT
// STO, IBTR and LDF over their thresholds: every point of a curve equals the scalar for this threshold.
#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace threshold_curves_test {

using namespace dmrp::test;
using dmrp::toolkit::Stream;

// Three robots at random positions in a small room that sometimes crawl and arrive one after the other.
SyntheticTrial wandering(std::uint64_t index) {
  Stream stream(1, "metrics.curves", index);
  SyntheticTrial trial(3);
  std::vector<Points> paths(3);
  for (Points& path : paths)
    for (int step = 0; step < 8; ++step)
      path.push_back({static_cast<double>(stream.below(4)), static_cast<double>(stream.below(4))});
  trial.plan(paths);
  for (int i = 0; i <= 100; ++i) {
    std::vector<dmrp_robot_sample> robots;
    for (int robot = 0; robot < 3; ++robot)
      robots.push_back(at(stream.uniform(0, 4), stream.uniform(0, 4),
                          stream.chance(0.5) ? stream.uniform(0, 0.3) : stream.uniform(0.3, 0.8),
                          i < 60 + 20 * robot ? DMRP_ROBOT_ACTIVE : DMRP_ROBOT_FINISHED));
    trial.sample(0.1 * i, robots);
  }
  trial.end(10.0);
  return trial;
}

struct Curve {
  const char* metric;
  const char* value;
  const char* curve;
  const char* thresholds;
  const char* threshold;
};

constexpr Curve curves[] = {
    {"dmrp.metric.sto", "sto", "sto_by_distance", "distances_m", "distance_m"},
    {"dmrp.metric.ibtr", "ibtr", "ibtr_by_distance", "distances_m", "distance_m"},
    {"dmrp.metric.ibtr", "ibtr", "ibtr_by_speed_fraction", "speed_fractions", "speed_fraction"},
    {"dmrp.metric.ldf", "ldf", "ldf_by_distance", "distances_m", "distance_m"},
};

TEST_CASE("every point of a threshold curve equals the scalar with this threshold, to the bit") {
  int different = 0;
  for (std::uint64_t index = 0; index < 5; ++index) {
    const SyntheticTrial trial = wandering(index);
    for (const Curve& curve : curves) {
      INFO(curve.curve);
      const Measurement m = measure(curve.metric, trial, {{curve.thresholds, std::vector<double>{1.5, 0.4, 0.9}}});
      const std::map<double, double>& points = m.curves.at(curve.curve);
      REQUIRE(points.size() == 3);
      for (const auto& [threshold, value] : points)
        CHECK(value == measure(curve.metric, trial, {{curve.threshold, threshold}}).system(curve.value));
      if (curve.value != std::string("ldf")) CHECK(points.at(0.4) <= points.at(1.5));
      different += points.at(0.4) != points.at(1.5);
    }
  }
  CHECK(different > 10);
}

TEST_CASE("a repeated threshold has one point") {
  const SyntheticTrial trial = wandering(0);
  for (const Curve& curve : curves)
    CHECK(measure(curve.metric, trial, {{curve.thresholds, std::vector<double>{1.0, 0.5, 1.0}}})
              .curves.at(curve.curve)
              .size() == 2);
}

TEST_CASE("a curve without thresholds is one undefined value") {
  const SyntheticTrial trial = wandering(0);
  for (const Curve& curve : curves) {
    const Measurement m = measure(curve.metric, trial, {{curve.thresholds, std::vector<double>{}}});
    CHECK(m.curves.count(curve.curve) == 0);
    CHECK(std::isnan(m.system(curve.curve)));
  }
}

TEST_CASE("the default thresholds include those of the paper and of its released code") {
  const SyntheticTrial trial = wandering(0);
  const auto has = [&](const char* metric, const char* curve, double threshold) {
    return measure(metric, trial).curves.at(curve).count(threshold) == 1;
  };
  CHECK(has("dmrp.metric.sto", "sto_by_distance", 0.5));
  CHECK(has("dmrp.metric.ibtr", "ibtr_by_distance", 2.0));
  CHECK(has("dmrp.metric.ibtr", "ibtr_by_distance", 2.5));
  CHECK(has("dmrp.metric.ibtr", "ibtr_by_speed_fraction", 0.2));
  CHECK(has("dmrp.metric.ibtr", "ibtr_by_speed_fraction", 0.5));
  CHECK(has("dmrp.metric.ldf", "ldf_by_distance", 2.0));
  CHECK(has("dmrp.metric.ldf", "ldf_by_distance", 1.0));
}

}  // namespace threshold_curves_test
