// SPDX-License-Identifier: MIT
// A guest can write anything into the memory of its answers: the judge believes what can be, and drops or refuses the rest.
#include <catch2/catch.hpp>
#include <cstring>
#include <dmrp/toolkit/random.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/guests/exchange/plan_message.hpp"
#include "host/guests/inside/annotations.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"
#include "tests/unit/host/trial/stage.hpp"

namespace answers_test {

using namespace dmrp;
using namespace dmrp::host;
using nlohmann::json;

const CallSite site = {"test.planner", "plan", 0, -1};

struct Planned {
  std::vector<dmrp_waypoint> waypoints = std::vector<dmrp_waypoint>(8);
  PlanInput input{nullptr, waypoints.data(), waypoints.size()};

  PlannerAnswer answer(const json& message) const { return planner_answer(message.dump(), input, 2, site); }
};

json plan_message(const json& counts) {
  return {
      {"status", 0},      {"planning_ns", 5},        {"processor_ns", 4}, {"text", ""}, {"statistics", json::array()},
      {"counts", counts}, {"partial", json::array()}};
}

TEST_CASE("a plan passes as it was given") {
  const Planned planned;
  PlannerAnswer given;
  given.status = 0;
  given.planning_ns = 123;
  given.statistics = {{"expanded", 1e300}};
  given.partial = {false, true};
  given.paths = {{{1.0, 2.0, 0.5, 0, 0, 0}, {2.0, 2.0, 0.5, 1000, 0, 0}}, {{3.0, 1.0, 0.0, 0, 0, 0}}};
  const PlannerAnswer got = planner_answer(plan_text(given, planned.input, site), planned.input, 2, site);
  CHECK(got.planning_ns == 123);
  CHECK(got.partial == given.partial);
  CHECK(got.statistics.at(0).value == 1e300);
  REQUIRE(got.paths.size() == 2);
  CHECK(std::memcmp(got.paths[0].data(), given.paths[0].data(), 2 * sizeof(dmrp_waypoint)) == 0);
  CHECK(got.paths[1].size() == 1);
}

TEST_CASE("a plan that cannot be is a fault of its planner") {
  const Planned planned;
  CHECK(planned.answer(plan_message({3, 5})).paths.size() == 2);
  CHECK(planned.answer(plan_message(json::array())).paths.empty());
  for (const json& counts : {json({3, 6}), json({1, 1, 1}), json({8}), json({-1, 1}), json({1e300, 1}), json("none")}) {
    INFO(counts.dump());
    CHECK_THROWS_AS(planned.answer(plan_message(counts)), PluginFault);
  }
  CHECK_THROWS_AS(planner_answer("{", planned.input, 2, site), PluginFault);
  json flags = plan_message({3, 5});
  flags["partial"] = {true};
  CHECK_THROWS_AS(planned.answer(flags), PluginFault);
  PlannerAnswer large;
  large.paths = {std::vector<dmrp_waypoint>(9), {}};
  CHECK_THROWS_AS(plan_text(large, planned.input, site), PluginFault);
}

TEST_CASE("annotations reach the trace, and bytes that are none do not harm") {
  const Experiment experiment = [] {
    Experiment made;
    made.scenarios = {{test::hall(2), "hall", ""}};
    return made;
  }();
  const VariantWorld variant(experiment, experiment.scenarios[0]);
  test::TraceInMemory trace(variant.view.world());
  const auto source = [](std::uint32_t instance, std::uint32_t robot) -> std::optional<core::AnnotationSource> {
    if (instance != 3 || robot > 1) return std::nullopt;
    return core::AnnotationSource{DMRP_KIND_LOCAL_CONTROLLER, robot};
  };
  AnnotationBuffer buffer{true};
  const Annotations own(buffer, 3);
  const Annotations other(buffer, 4);
  const dmrp_note note = {sizeof(note), 1, "turns\n"};
  own.extension()->note(own.extension(), &note);
  other.extension()->note(other.extension(), &note);
  const std::vector<dmrp_pose> poses = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const dmrp_trajectory ahead = {sizeof(ahead), DMRP_ANNOTATE_PREDICTED, 0, 2, poses.data(), 100};
  own.extension()->trajectory(own.extension(), &ahead);
  record_annotations(buffer.bytes, source, *trace);

  toolkit::Stream random(1, "annotations", 0);
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bytes = buffer.bytes;
    for (int change = 0; change < 8; ++change)
      bytes[random.next_u64() % bytes.size()] = static_cast<std::uint8_t>(random.next_u64());
    bytes.resize(random.next_u64() % (bytes.size() + 1));
    test::TraceInMemory spoilt(variant.view.world());
    record_annotations(bytes, source, *spoilt);
  }
  const core::TraceReader reader(trace.bytes());
  REQUIRE(reader.notes().size() == 1);
  CHECK(reader.notes()[0].text == "turns\\n");
  REQUIRE(reader.trajectories().size() == 1);
}

}  // namespace answers_test
