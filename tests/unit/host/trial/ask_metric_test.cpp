// SPDX-License-Identifier: MIT
// The judge believes of a metric's guest only what the metric can have given.
#include "host/trial/ask_metric.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/results/result_bytes.hpp"
#include "host/results/result_json.hpp"

namespace ask_metric_test {

using namespace dmrp::host;
using nlohmann::json;

constexpr std::uint32_t robots = 2;

PluginInfo length_metric() {
  PluginInfo info;
  info.id = "test.length";
  MetricValueSpec spec;
  spec.name = "length";
  spec.subjects = 1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_ROBOT;
  info.values = {spec};
  return info;
}

const MetricValue good = {"length", DMRP_SUBJECT_SYSTEM, {}, {}, 1.0};

bool is_refused(const MetricResult& result) {
  const PluginInfo metric = length_metric();
  try {
    return believed(result, metric, robots, 0).values.size() != result.values.size();
  } catch (const UnbelievableMessage&) {
    return true;
  }
}

TEST_CASE("a metric has longer in a larger trial") {
  const auto budget_s = [](std::uint32_t count, double sim_time_s) {
    return static_cast<double>(metric_budget_ns(2.0, {{}, nullptr, count, 1, sim_time_s})) * 1e-9;
  };
  CHECK(budget_s(0, 60.0) == Approx(2.0));
  CHECK(budget_s(4, 60.0) == Approx(2.0 * 1.44));
  CHECK(budget_s(1000, 0.0) == Approx(2.0 * 51.0));
  CHECK(budget_s(1000, 60.0) == Approx(2.0 * 111.0));
}

TEST_CASE("a metric gives only what it declares, and that once") {
  CHECK_FALSE(is_refused({0, {good, {"length", DMRP_SUBJECT_ROBOT, 1, {}, 1.0}}, {}}));
  MetricValue bad = good;
  SECTION("another metric's value") {
    bad.metric = "speed";
  }
  SECTION("a robot that is not there") {
    bad = {"length", DMRP_SUBJECT_ROBOT, 2, {}, 1.0};
  }
  SECTION("a subject that it does not declare") {
    bad = {"length", DMRP_SUBJECT_PEDESTRIAN, 0, {}, 1.0};
  }
  SECTION("a robot without a number") {
    bad = {"length", DMRP_SUBJECT_ROBOT, {}, {}, 1.0};
  }
  SECTION("an unknown subject") {
    bad.subject_kind = 40;
  }
  SECTION("a coordinate without a curve") {
    bad.coordinate = 0.5;
  }
  SECTION("twice") {}
  CHECK(is_refused({0, {good, bad}, {}}));
}

TEST_CASE("an event of a metric is about robots that there are, and a time") {
  const auto breach = [](const MetricEvent& event) { return is_refused({0, {good}, {event}}); };
  CHECK_FALSE(breach({"length", 0, 1, {0, 1}, {}, "near", 0, {}}));
  CHECK(breach({"length", 0, 1, {2}, {}, "near", 0, {}}));
  CHECK(breach({"length", 2, 1, {0}, {}, "near", 0, {}}));
}

TEST_CASE("a result has an end") {
  const MetricEvent long_event = {"length", 0, 1, {0}, {}, std::string(1 << 20, 'x'), 0, {}};
  MetricResult result = {0, {good}, {}};
  result.events.assign(most_result_bytes / (1 << 20) + 1, long_event);
  CHECK(is_refused(result));
}

TEST_CASE("numbers that an integer cannot hold are not taken for others") {
  const json metric = MetricResult{0, {good}, {{"length", 0, 1, {0}, {7}, "", 0, {}}}};
  for (const char* place : {"/index", "/values/0/1", "/values/0/2", "/events/0/1", "/events/0/2", "/events/0/3/0",
                            "/events/0/4/0", "/events/0/6"}) {
    INFO(place);
    json wrong = metric;
    wrong[json::json_pointer(place)] = 1e300;
    CHECK_THROWS_AS(wrong.get<MetricResult>(), UnbelievableMessage);
  }
  constexpr std::uint64_t beyond = std::uint64_t{1} << 32;  // 0 in 32 bits
  for (const json& number : {json(beyond), json(0.5), json(-1), json("0")}) {
    INFO(number.dump());
    json wrong = metric;
    wrong["index"] = number;
    CHECK_THROWS_AS(wrong.get<MetricResult>(), UnbelievableMessage);
  }
}

}  // namespace ask_metric_test
