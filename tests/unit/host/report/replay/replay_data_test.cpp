// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_data.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/report/replay/replay_world.hpp"
#include "tests/unit/core/trace/trace_example.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"

namespace replay_data_test {

using namespace dmrp;
using namespace dmrp::host;
using nlohmann::json;

std::vector<std::int64_t> summed(const json& differences) {
  std::vector<std::int64_t> values;
  std::int64_t sum = 0;
  for (const json& difference : differences) values.push_back(sum += difference.get<std::int64_t>());
  return values;
}

json replay_of(const core::TraceBytes& bytes, const TrialRecord& trial = {}) {
  core::TraceReader trace(bytes);
  return json::parse(replay_json(trace, trial));
}

TEST_CASE("a replay has ten samples a second and the last, to half a millimetre", "[report]") {
  const core::TraceBytes bytes = dmrp::test::example_trace(23);  // 50 Hz: 0 to 440 ms
  const json replay = replay_of(bytes);
  const std::vector<std::int64_t> times = summed(replay["times"]);
  CHECK(times == std::vector<std::int64_t>{0, 100, 200, 300, 400, 440});

  core::TraceReader trace(bytes);
  std::size_t kept = 0;
  while (const dmrp_sample* sample = trace.next_sample()) {
    if (kept == times.size() || sample->t_ns != times[kept] * 1'000'000) continue;
    for (std::uint32_t i = 0; i < sample->robot_count; ++i) {
      const json& robot = replay["robots"][i];
      CHECK(static_cast<double>(summed(robot["x"])[kept]) / 1000.0 == Approx(sample->robots[i].pose.x).margin(0.00051));
      CHECK(static_cast<double>(summed(robot["y"])[kept]) / 1000.0 == Approx(sample->robots[i].pose.y).margin(0.00051));
    }
    const json& first_person = replay["people"][0];
    CHECK(static_cast<double>(summed(first_person["y"])[kept]) / 1000.0 ==
          Approx(sample->people[0].position.y).margin(0.00051));
    ++kept;
  }
  CHECK(kept == times.size());
}

TEST_CASE("a replay has the current plan, the states, and the curves up to the end of a robot's task", "[report]") {
  const json replay = replay_of(dmrp::test::example_trace(20));  // the second plan is in force from sample 10, 200 ms
  CHECK(replay["plan"] == json{0, 0, 2, 2});                     // the second of three records gave no plan
  CHECK(replay["plans"].size() == 3);
  CHECK(replay["plans"][1]["paths"].empty());
  CHECK(summed(replay["plans"][0]["paths"][0]["x"]) == std::vector<std::int64_t>{500, 1500});
  CHECK(summed(replay["plans"][0]["paths"][1]["t"]) == std::vector<std::int64_t>{0, 1800, 3600});

  const json& first = replay["robots"][0];
  CHECK(first["state"] == json{0, DMRP_ROBOT_ACTIVE});
  CHECK(summed(first["speed"]) == std::vector<std::int64_t>{500, 500, 500, 500, 500});
  // at (k / 3, 0.1), off the path from (0.5, 0.5) to (1.5, 0.5); the last kept sample is k = 19
  const double off_both = std::hypot(19.0 / 3.0 - 1.5, 0.4);
  CHECK(summed(first["deviation"]) == std::vector<std::int64_t>{std::llround(1000 * std::hypot(0.5, 0.4)),
                                                                std::llround(1000 * std::hypot(5 / 3.0 - 1.5, 0.4)),
                                                                std::llround(1000 * std::hypot(10 / 3.0 - 1.5, 0.4)),
                                                                std::llround(1000 * std::hypot(5.0 - 1.5, 0.4)),
                                                                std::llround(1000 * off_both)});
  CHECK(first["failure"] == "held behind another robot");
  CHECK_FALSE(first.contains("arrival"));

  const json& second = replay["robots"][1];  // finished from the beginning
  CHECK(second["speed"].size() == 1);
  REQUIRE(second["parts"].size() == 2);
  CHECK(second["parts"][0].size() == 6);
  CHECK(second["parts"][1].size() == 8);
  CHECK(second["arrival"] == 0);
  CHECK(replay["end"]["reason"] == "time limit");
}

TEST_CASE("a replay has the routes that a robot was led around something, until it follows its plan again",
          "[report]") {
  const dmrp::test::ExampleWorld example;
  const dmrp::test::ExamplePlan plan(1);
  core::TraceBytes bytes;
  core::TraceEncoder trace(example.world, [&](std::int64_t, std::span<const std::uint8_t> record) {
    bytes.insert(bytes.end(), record.begin(), record.end());
  });
  trace.plan(plan.plan, 0);
  for (std::int64_t k = 0; k < 20; ++k) {
    dmrp::test::ExampleSample step(k, &plan.plan);
    step.routes[0].flags = 0;
    step.sample.route_count = k % 5 == 0 ? 1 : 0;
    dmrp_robot_event led = {DMRP_ROBOT_EVENT_ROUTE, 0, k * 20'000'000, 0, DMRP_NOBODY};
    step.sample.events = &led;
    step.sample.event_count = k == 5 ? 1 : 0;
    trace.sample(step.sample);
  }
  const json routes = replay_of(bytes)["robots"][0]["routes"];
  REQUIRE(routes.size() == 2);
  CHECK(routes[0]["from"] == 1);  // 100 ms
  CHECK(summed(routes[0]["x"]) == std::vector<std::int64_t>{0, 100, 200, 300, 400, 500, 600});
  CHECK(routes[1] == json{{"from", 2}});
  CHECK_FALSE(replay_of(bytes)["robots"][1].contains("routes"));
}

TEST_CASE("a robot failed by what the results say, not by its class at the end", "[report]") {
  TrialRecord trial;
  trial.events.resize(2);
  trial.events[0].text = "robot 10 failed: no plan";
  trial.events[1].text = "robot 0 failed: stood after hitting another robot";
  const json replay = replay_of(dmrp::test::example_trace(20), trial);
  CHECK(replay["robots"][0]["failure"] == "stood after hitting another robot");
  CHECK_FALSE(replay["robots"][0].contains("culprit"));
}

TEST_CASE("a robot says how it is driven, if not by two wheels", "[report]") {
  const core::TraceBytes bytes = dmrp::test::example_trace(1);
  const core::TraceReader trace(bytes);
  dmrp_robot robot = trace.world().robots[0];
  dmrp_limits limits = *robot.limits;
  limits.wheelbase_m = 0.62;
  robot.limits = &limits;
  robot.kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
  CHECK_FALSE(replay_robot(robot).contains("drive"));
  robot.kinematics = DMRP_KINEMATICS_HOLONOMIC;
  CHECK(replay_robot(robot)["drive"] == "holonomic");
  CHECK_FALSE(replay_robot(robot).contains("wheelbase"));
  robot.kinematics = DMRP_KINEMATICS_ACKERMANN;
  CHECK(replay_robot(robot)["drive"] == "ackermann");
  CHECK(replay_robot(robot)["wheelbase"] == 620);
}

TEST_CASE("without a plan the robots stand at their starts", "[report]") {
  const dmrp::test::ExampleWorld world;
  dmrp::test::TraceInMemory trace(world.world);
  const json replay = replay_of(trace.bytes());
  CHECK(replay["times"] == json::array({0}));
  CHECK(replay["plan"] == json{0, -1});
  CHECK(replay["people"].empty());
  CHECK(replay["robots"][1]["x"] == json::array({5500}));
  CHECK(replay["robots"][1]["theta"] == json::array({3100}));
  CHECK(replay["robots"][1]["state"] == json{0, DMRP_ROBOT_FAILED});
}

TEST_CASE("each person has a track from entering to leaving", "[report]") {
  const json replay = replay_of(dmrp::test::example_trace(11));  // samples at 0, 100 and 200 ms: k = 0, 5, 10
  const json& people = replay["people"];
  REQUIRE(people.size() == 4);  // one stays; the other place is somebody else's at each sample
  CHECK(people[0]["id"] == 41);
  CHECK(people[0]["group"] == 3);
  CHECK(people[0]["x"].size() == 3);
  CHECK(people[2]["id"] == 105);
  CHECK(people[2]["from"] == 1);
  CHECK(people[2]["x"].size() == 1);
}

TEST_CASE("headings are unwrapped", "[report]") {
  const dmrp::test::ExampleWorld world;
  dmrp::test::TraceInMemory trace(world.world);
  for (std::int64_t k = 0; k < 4; ++k) {
    dmrp::test::ExampleSample at(5 * k, nullptr);
    at.sample.contact_count = 0;
    at.robots[0].pose.theta = std::remainder(3.0 + 0.2 * static_cast<double>(k), 2.0 * std::acos(-1.0));
    trace->sample(at.sample);
  }
  const json replay = replay_of(trace.bytes());
  CHECK(summed(replay["robots"][0]["theta"]) == std::vector<std::int64_t>{3000, 3200, 3400, 3600});
  CHECK(replay["plan"] == json{0, -1});
  CHECK(summed(replay["robots"][0]["deviation"]) == std::vector<std::int64_t>{-1, -1, -1, -1});
  CHECK_FALSE(replay.contains("end"));
}

TEST_CASE("scans are in centimetres, with at most 180 beams", "[report]") {
  const dmrp::test::ExampleWorld world;
  dmrp::test::TraceInMemory trace(world.world);
  std::vector<float> ranges(360, std::numeric_limits<float>::infinity());
  for (std::int64_t k = 0; k <= 10; ++k) {  // every 20 ms; scans at 0 and at 200 ms, of the second robot
    dmrp::test::ExampleSample at(k, nullptr);
    at.sample.contact_count = 0;
    trace->sample(at.sample);
    if (k % 10 != 0) continue;
    ranges[0] = 1.0F + 0.1F * static_cast<float>(k);
    ranges[1] = 7.0F;  // between two of the kept beams
    ranges[4] = 2.5F;
    dmrp_scan scan{};
    scan.struct_size = sizeof(scan);
    scan.count = 360;
    scan.t_ns = k * 20'000'000;
    scan.angle_min = -1.5;
    scan.angle_increment = 0.01;
    scan.range_max = 10.0;
    scan.ranges = ranges.data();
    trace->scan(1, scan);
  }
  const json replay = replay_of(trace.bytes());
  CHECK_FALSE(replay["robots"][0].contains("scans"));
  const json& scans = replay["robots"][1]["scans"];
  CHECK(scans["first"] == -1'500'000);
  CHECK(scans["step"] == 20'000);
  CHECK(scans["beams"] == 180);
  CHECK(summed(scans["samples"]) == std::vector<std::int64_t>{0, 2});
  REQUIRE(scans["ranges"].size() == 360);
  CHECK(std::vector<std::int64_t>(scans["ranges"].begin(), scans["ranges"].begin() + 5) ==
        std::vector<std::int64_t>{100, -100, 250, -250, 0});
  CHECK(scans["ranges"][180] == 200);  // begins anew
}

TEST_CASE("contacts are events with fault and depth, besides metric events", "[report]") {
  TrialRecord trial;
  trial.id = 5;
  MetricEvent& event = trial.events.emplace_back();
  event.metric = "blocking";
  event.from_ns = 1'500'000'000;
  event.to_ns = 2'250'000'000;
  event.robots = {0, 1};
  event.text = "they block each other";
  const json replay = replay_of(dmrp::test::example_trace(4), trial);  // contacts in samples 0 and 3
  const json& contacts = replay["contacts"];
  REQUIRE(contacts.size() == 4);  // the first begins anew each time; the person is another one each time
  CHECK(contacts[0] == json{{"kind", "static"},
                            {"robot", 0},
                            {"other", 2},
                            {"from", 0},
                            {"to", 0},
                            {"at", {0, 500}},
                            {"depth", 1},
                            {"fault", "robot"},
                            {"speed", 350}});
  CHECK(contacts[1]["kind"] == "person");
  CHECK(contacts[1]["other"] == 100);
  CHECK(contacts[1]["fault"] == "other");
  CHECK_FALSE(contacts[1].contains("speed"));  // not known
  CHECK(contacts[3]["other"] == 103);
  CHECK(replay["events"] == json::array({{{"metric", "blocking"},
                                          {"from", 1500},
                                          {"to", 2250},
                                          {"robots", {0, 1}},
                                          {"text", "they block each other"}}}));
}

TEST_CASE("a lasting contact is one event", "[report]") {
  const dmrp::test::ExampleWorld world;
  dmrp::test::TraceInMemory trace(world.world);
  for (std::int64_t k = 0; k < 5; ++k) {
    dmrp::test::ExampleSample at(k, nullptr);
    at.contacts[0] = {DMRP_CONTACT_ROBOT,
                      k == 0 ? DMRP_CONTACT_BEGINS : 0U,
                      0,
                      1,
                      0.002 + 0.001 * static_cast<double>(k),
                      {1, 1},
                      0.4};
    at.sample.contact_count = 1;
    trace->sample(at.sample);
  }
  const json contacts = replay_of(trace.bytes())["contacts"];
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0]["to"] == 80);
  CHECK(contacts[0]["depth"] == 6);
  CHECK(contacts[0]["fault"] == "none");
}

}  // namespace replay_data_test
