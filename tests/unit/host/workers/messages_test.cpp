// SPDX-License-Identifier: MIT
#include "host/workers/messages.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace messages_test {

using namespace dmrp::host;
using nlohmann::json;

template <class T>
T through_text(const T& value) {
  return json::parse(json(value).dump()).template get<T>();
}

TEST_CASE("messages keep all their fields") {
  const Job job = through_text(Job{1ull << 40, "traces/trial_000007.mcap", "trial_000007.scratch", "one", "plan.csv"});
  CHECK(job.trial == 1ull << 40);
  CHECK(job.trace_file == "traces/trial_000007.mcap");
  CHECK(job.scratch_file == "trial_000007.scratch");
  CHECK(job.plan == "one");
  CHECK(job.new_plan == "plan.csv");

  const TrialDone done =
      through_text(TrialDone{trial_outcome::failed, {{"org.x", "reads a \"clock\""}}, 0.1 + 0.2, "abc"});
  CHECK(done.outcome == "failed");
  CHECK(done.timing == std::vector<TimingReason>{{"org.x", "reads a \"clock\""}});
  CHECK(done.sim_time_s == 0.1 + 0.2);

  const FaultRecord fault = through_text(FaultRecord{"crash", "org.x", "step", -1, 3, 11, "a \"b\"\n", "dmrp-host x"});
  CHECK(fault.kind == "crash");
  CHECK(fault.plugin == "org.x");
  CHECK(fault.function == "step");
  CHECK(fault.step == -1);
  CHECK(fault.robot == 3);
  CHECK(fault.signal == 11);
  CHECK(fault.detail == "a \"b\"\n");
  CHECK(fault.rerun == "dmrp-host x");
}

TEST_CASE("metric values keep their bits, and what is undefined stays so") {
  const double odd[] = {0.0,    -0.0, 0.1, 1.0 / 3.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308,
                        -1e-17, 1e22};
  MetricResult sent;
  sent.index = 4;
  for (const double value : odd) sent.values.push_back({"length", DMRP_SUBJECT_ROBOT, 7, value, value});
  sent.values.push_back({"length", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, std::nullopt});
  sent.events.push_back({"sto",
                         10,
                         9'000'000'000'000'000'001,
                         {0, 3},
                         {0xFFFF'FFFF'FFFF'FFFFu},
                         "near",
                         DMRP_SEVERITY_WARNING,
                         dmrp_vec2{0.1 + 0.2, -1.0 / 3.0}});
  sent.events.push_back({"sto", 10, 20, {}, {}, "", DMRP_SEVERITY_INFO, {}});
  const MetricResult got = through_text(sent);
  CHECK(got.index == 4);
  REQUIRE(got.values.size() == sent.values.size());
  for (std::size_t i = 0; i < std::size(odd); ++i) {
    REQUIRE(got.values[i].value);
    REQUIRE(got.values[i].coordinate);
    CHECK(std::memcmp(&*got.values[i].value, &odd[i], sizeof(double)) == 0);
    CHECK(std::memcmp(&*got.values[i].coordinate, &odd[i], sizeof(double)) == 0);
    CHECK(got.values[i].subject == 7);
    CHECK(got.values[i].subject_kind == DMRP_SUBJECT_ROBOT);
  }
  CHECK_FALSE(got.values.back().subject);
  CHECK_FALSE(got.values.back().coordinate);
  CHECK_FALSE(got.values.back().value);
  REQUIRE(got.events.size() == 2);
  CHECK(got.events[0].to_ns == 9'000'000'000'000'000'001);
  CHECK(got.events[0].robots == std::vector<std::uint32_t>{0, 3});
  CHECK(got.events[0].people == std::vector<std::uint64_t>{0xFFFF'FFFF'FFFF'FFFFu});
  CHECK(got.events[0].text == "near");
  CHECK(got.events[0].severity == DMRP_SEVERITY_WARNING);
  REQUIRE(got.events[0].place);
  CHECK(got.events[0].place->x == 0.1 + 0.2);
  CHECK(got.events[0].place->y == -1.0 / 3.0);
  CHECK_FALSE(got.events[1].place);
}

TEST_CASE("a result is sent in pieces, none of them large") {
  MetricResult result;
  result.index = 3;
  for (int i = 0; i < 1000; ++i) result.values.push_back({"length", DMRP_SUBJECT_PEDESTRIAN, i, {}, 0.5 * i});
  for (int i = 0; i < 10'000; ++i) result.events.push_back({"sto", i, i, {0}, {}, "near", DMRP_SEVERITY_INFO, {}});
  MetricResult got;
  int pieces = 0;
  send_in_pieces(result, [&](const MetricResult& piece) {
    CHECK(piece.index == 3);
    CHECK(json(piece).dump().size() < 600'000);
    got.values.insert(got.values.end(), piece.values.begin(), piece.values.end());
    got.events.insert(got.events.end(), piece.events.begin(), piece.events.end());
    ++pieces;
  });
  CHECK(json(got).at("values") == json(result).at("values"));
  CHECK(json(got).at("events") == json(result).at("events"));
  CHECK(pieces > 3);

  pieces = 0;
  send_in_pieces({3, {}, {}}, [&](const MetricResult& piece) {
    CHECK(piece.values.empty());
    ++pieces;
  });
  CHECK(pieces == 1);
}

TEST_CASE("routes of people arrive to the bit") {
  dmrp::core::FlowRoutes routes;
  routes.legs = {{{{0.1, -1.0 / 3.0}, {1e-17, 12345.678901234567}}, {}}, {}};
  const dmrp::core::FlowRoutes arrived = routes_in(nlohmann::json::parse(json_of(routes).dump()));
  REQUIRE(arrived.legs.size() == 2);
  CHECK(arrived.legs[0] == routes.legs[0]);
  CHECK(arrived.legs[1].empty());
}

}  // namespace messages_test
