// SPDX-License-Identifier: MIT
// Runs in which it is known where a controller stands between the bounds.
#include "host/ranking/bounds.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace bounds_test {

using namespace dmrp::host;
using namespace dmrp::test;

// Ten robots, of which `safe` arrive safely, each after `s_per_m` for each metre; a task of the repetition's own.
MakeRobots robots_with(std::uint32_t safe, double s_per_m) {
  return [=](std::uint32_t repetition) {
    const double way = 10.0 + repetition;
    std::vector<RobotResult> robots;
    for (std::uint32_t i = 0; i < 10; ++i) robots.push_back({s_per_m * way, i < safe, way});
    return robots;
  };
}

struct Summarised {
  std::vector<MetricColumn> metrics = ranking_metrics();
  std::vector<CombinationSummary> summaries;

  explicit Summarised(const std::vector<TrialRecord>& trials, const Bounds& bounds = {"low", "high"}) {
    summaries = summarise(metrics, trials, {ranking_layout().counts_failures});
    add_places(bounds, ranking_layout(), trials, metrics, summaries);
  }

  const MetricSummary& of(const std::string& controller, const std::string& metric) const {
    for (const CombinationSummary& summary : summaries)
      for (std::size_t i = 0; i < metrics.size(); ++i)
        if (summary.combination.local_controller == controller && metrics[i].name == metric) return summary.metrics[i];
    throw std::runtime_error("no " + metric + " of " + controller);
  }
};

std::vector<BoundedValue> repeated(std::size_t count, const BoundedValue& value) {
  return std::vector<BoundedValue>(count, value);
}

TEST_CASE("a controller's place is its share of the way from the lower to the upper bound", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "low", 20, robots_with(2, 4.0));
  add_trials(trials, "middle", 20, robots_with(5, 3.5));
  add_trials(trials, "below", 20, robots_with(0, 5.0));
  add_trials(trials, "high", 20, robots_with(8, 2.0));
  const Summarised run(trials);
  CHECK(run.of("middle", "place_safe").mean == Approx(0.5));
  CHECK(run.of("middle", "place_safe").interval.low == Approx(0.5));
  CHECK(run.of("middle", "place_safe").interval.high == Approx(0.5));
  CHECK(run.of("middle", "place_safe").defined == 20);
  CHECK(run.of("middle", "place_time").mean == Approx(0.25));
  CHECK(run.of("below", "place_safe").mean == Approx(-1.0 / 3.0));
  CHECK(run.of("below", "place_time").mean == Approx(-0.5));
  for (const char* bound : {"low", "high"}) CHECK(std::isnan(run.of(bound, "place_safe").mean));
  // shown by tables, which name no columns of it
  CHECK(with_added_columns(ranking_layout(), run.metrics).columns.size() == 2);
}

TEST_CASE("a place is that of the means, not the mean of places, with an interval over tasks", "[ranking]") {
  // gains of 0.1 and 0.5 in turn, of which all and nothing is reached: 1/6 of the whole, not one half
  std::vector<BoundedValue> values;
  for (int i = 0; i < 20; ++i) values.push_back(i % 2 == 0 ? BoundedValue{0.2, 0.3, 0.3} : BoundedValue{0.2, 0.7, 0.2});
  const Place place = place_between(values, true);
  CHECK(place.place == Approx(1.0 / 6.0));
  CHECK(place.observations == 20);
  CHECK(place.interval.low > 0.05);
  CHECK(place.interval.low < 1.0 / 6.0);
  CHECK(place.interval.high > 1.0 / 6.0);
  CHECK(place.interval.high < 0.45);
}

TEST_CASE("there is no place where the upper bound is not told apart as the better", "[ranking]") {
  CHECK(place_between(repeated(20, {0.2, 0.6, 0.4}), true).place == Approx(0.5));
  CHECK(std::isnan(place_between(repeated(20, {0.6, 0.2, 0.4}), true).place));  // the wrong way round
  CHECK(place_between(repeated(20, {3.0, 2.0, 2.2}), false).place == Approx(0.8));
  CHECK(std::isnan(place_between(repeated(20, {2.0, 3.0, 2.2}), false).place));
  CHECK(std::isnan(place_between(repeated(20, {0.5, 0.5, 0.4}), true).place));  // equal
  CHECK(std::isnan(place_between(repeated(4, {0.2, 0.6, 0.4}), true).place));   // too few for p < 0.05
  CHECK(std::isnan(place_between({}, true).place));
  std::vector<BoundedValue> noisy;
  for (int i = 0; i < 20; ++i) noisy.push_back({0.5, i % 2 == 0 ? 0.7 : 0.35, 0.5});
  CHECK(std::isnan(place_between(noisy, true).place));
}

TEST_CASE("times are compared over robots that arrive with all three", "[ranking]") {
  // robot 1 is slow, and arrives with the lower bound and the third alone: it counts for neither
  const auto pair = [](double first, std::optional<double> second) {
    return [=](std::uint32_t i) {
      const double way = 10.0 + i;
      return std::vector<RobotResult>{{first * way, true, way},
                                      {second ? std::optional(*second * way) : std::nullopt, true, way}};
    };
  };
  std::vector<TrialRecord> trials;
  add_trials(trials, "low", 20, pair(4.0, 9.0));
  add_trials(trials, "third", 20, pair(3.0, 9.0));
  add_trials(trials, "high", 20, pair(2.0, std::nullopt));
  CHECK(Summarised(trials).of("third", "place_time").mean == Approx(0.5));
}

TEST_CASE("the bounds are those of the same planner, scenario and crowd", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "low", 20, robots_with(2, 4.0));
  add_trials(trials, "middle", 20, robots_with(5, 3.0));
  add_trials(trials, "high", 20, robots_with(8, 2.0));
  const std::size_t count = trials.size();
  for (std::size_t i = 0; i < count; ++i) {  // another planner, without an upper bound
    if (trials[i].local_controller == "high") continue;
    trials.push_back(trials[i]);
    trials.back().global_planner = "Q";
  }
  const Summarised run(trials);
  for (const CombinationSummary& summary : run.summaries) {
    if (summary.combination.local_controller != "middle") continue;
    if (summary.combination.global_planner == "P")
      CHECK(summary.metrics[run.metrics.size() - 2].mean == Approx(0.5));
    else
      CHECK(std::isnan(summary.metrics[run.metrics.size() - 2].mean));
  }
}

TEST_CASE("without two bounds there are no places", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "low", 20, robots_with(2, 4.0));
  add_trials(trials, "high", 20, robots_with(8, 2.0));
  CHECK(Summarised(trials, {"low", ""}).metrics.size() == ranking_metrics().size());
  CHECK(Summarised(trials, {"low", "high"}).metrics.size() == ranking_metrics().size() + 2);
}

TEST_CASE("the bounds of a run stand in its effective.toml", "[ranking]") {
  const Bounds bounds = bounds_of(R"([[local_controller]]
use   = "a.b"
label = "Stop \"and\" wait"
bound = "lower"
[local_controller.params]
bound = "upper"
[[local_controller]]
use   = "a.c"
label = "third"
[[local_controller]]
use   = "a.d"
label = "Seer"
bound = "upper"
)");
  CHECK(bounds.lower == "Stop \"and\" wait");
  CHECK(bounds.upper == "Seer");
  CHECK(bounds_of("").lower.empty());
}

}  // namespace bounds_test
