// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cstring>
#include <dmrp/toolkit/random.hpp>

#include "core/trace/trace_reader.hpp"
#include "tests/unit/core/trace/trace_example.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"

namespace trace_test {

using dmrp::core::TraceBytes;
using dmrp::core::TraceError;
using dmrp::core::TraceReader;
using dmrp::test::example_trace;
using dmrp::test::ExamplePlan;
using dmrp::test::ExampleSample;
using dmrp::test::ExampleWorld;
using dmrp::test::TraceInMemory;

template <class Value>
bool same_bits(const Value& a, const Value& b) {
  return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

template <class Value>
bool same_arrays(const Value* a, const Value* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(Value)) == 0;
}

bool same_routes(const dmrp_route& a, const dmrp_route& b) {
  return a.robot == b.robot && a.flags == b.flags && a.path->flags == b.path->flags && a.path->count == b.path->count &&
         same_arrays(a.path->waypoints, b.path->waypoints, a.path->count);
}

// Goes through everything that a metric may read, so that a sanitizer sees what is wrong; adds it up.
double touch(TraceReader& trace) {
  double sum = 0.0;
  const dmrp_world& world = trace.world();
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    const dmrp_robot& robot = world.robots[i];
    sum += static_cast<double>(std::strlen(robot.name) + std::strlen(robot.type)) + robot.limits->v_max;
    for (std::uint32_t p = 0; p < robot.footprint->part_count; ++p)
      for (std::uint32_t v = 0; v < robot.footprint->parts[p].vertex_count; ++v)
        sum += robot.footprint->parts[p].vertices[v].x;
    for (std::uint32_t g = 0; g < robot.goal_count; ++g) sum += robot.goals[g].pose.x;
  }
  for (std::uint32_t i = 0; i < world.shape_count; ++i)
    for (std::uint32_t v = 0; v < world.shapes[i].vertex_count; ++v) sum += world.shapes[i].vertices[v].y;
  if (world.planning_grid && world.planning_grid->clearance)
    for (std::uint64_t c = 0; c < std::uint64_t{world.planning_grid->width} * world.planning_grid->height; ++c)
      sum += world.planning_grid->clearance[c];
  for (const auto& made : trace.plans())
    for (std::uint32_t p = 0; p < made.plan.path_count; ++p)
      for (std::uint32_t w = 0; w < made.plan.paths[p].count; ++w) sum += made.plan.paths[p].waypoints[w].x;
  while (const dmrp_sample* sample = trace.next_sample()) {
    for (std::uint32_t c = 0; c < sample->contact_count; ++c) {
      sum += sample->robots[sample->contacts[c].a].pose.x;
      if (sample->contacts[c].kind == DMRP_CONTACT_PERSON) sum += sample->people[sample->contacts[c].b].position.x;
    }
    if (sample->plan) sum += static_cast<double>(sample->plan->planning_ns);
    for (std::uint32_t e = 0; e < sample->event_count; ++e) sum += sample->robots[sample->events[e].robot].pose.y;
    for (std::uint32_t r = 0; r < sample->route_count; ++r)
      for (std::uint32_t w = 0; w < sample->routes[r].path->count; ++w) sum += sample->routes[r].path->waypoints[w].x;
  }
  for (const auto& trajectory : trace.trajectories())
    for (const dmrp_pose& pose : trajectory.poses) sum += pose.theta;
  for (const auto& scan : trace.scans()) sum += scan.ranges.empty() ? 0.0 : static_cast<double>(scan.ranges.back());
  for (const auto& note : trace.notes()) sum += static_cast<double>(note.text.size());
  if (trace.end())
    for (std::uint32_t i = 0; i < trace.end()->robot_count; ++i) sum += trace.end()->robots[i].state;
  return sum;
}

// 1 if the trace was read, 0 if it was refused; anything else is a failure of the test.
int read_or_refuse(const TraceBytes& bytes) {
  try {
    // a copy of exactly this size, so that a sanitizer notices a byte too many
    const TraceBytes exact(bytes.begin(), bytes.end());
    TraceReader trace(exact);
    touch(trace);
    return 1;
  } catch (const TraceError& error) {
    CHECK(error.offset() <= bytes.size());
    return 0;
  }
}

TEST_CASE("a trace gives the world back", "[trace]") {
  const TraceBytes bytes = example_trace(1);
  const TraceReader trace(bytes);
  const ExampleWorld example;
  const dmrp_world& world = trace.world();

  CHECK(world.struct_size == sizeof(dmrp_world));
  CHECK(world.person_count == 2);
  CHECK(same_bits(world.lower, example.world.lower));
  CHECK(same_bits(world.upper, example.world.upper));
  CHECK(world.step_ns == 20'000'000);
  CHECK(world.control_period_ns == 100'000'000);
  CHECK(world.time_limit_ns == 180'000'000'000);
  CHECK(world.call_budget_ns == 50'000'000);
  CHECK(world.person_radius_m == 0.35);

  REQUIRE(world.robot_count == 2);
  CHECK(std::string(world.robots[1].name) == "rö1");
  CHECK(world.robots[0].type == std::string());
  CHECK(world.robots[1].type == std::string("forklift"));
  CHECK(world.robots[1].kinematics == DMRP_KINEMATICS_ACKERMANN);
  CHECK(same_bits(world.robots[1].start, example.robots[1].start));
  CHECK(same_bits(*world.robots[0].limits, example.limits));
  CHECK(same_bits(*world.robots[1].limits, example.steering_limits));
  CHECK(world.robots[0].footprint->part_count == 0);
  CHECK(world.robots[0].footprint->parts == nullptr);
  CHECK(world.robots[0].footprint->radius_m == 0.25);
  const dmrp_footprint& arrow = *world.robots[1].footprint;
  CHECK(arrow.inscribed_radius_m == 0.15);
  REQUIRE(arrow.part_count == 2);
  REQUIRE(arrow.parts[0].vertex_count == 3);
  CHECK(same_arrays(arrow.parts[0].vertices, example.front.data(), 3));
  REQUIRE(arrow.parts[1].vertex_count == 4);
  CHECK(same_arrays(arrow.parts[1].vertices, example.back.data(), 4));
  REQUIRE(world.robots[0].goal_count == 1);
  CHECK(same_arrays(world.robots[0].goals, &example.goals[0], 1));
  REQUIRE(world.robots[1].goal_count == 2);
  CHECK(same_arrays(world.robots[1].goals, &example.goals[1], 2));

  REQUIRE(world.shape_count == 2);
  CHECK(std::string(world.shapes[0].name) == "planter");
  CHECK(world.shapes[0].kind == DMRP_SHAPE_CIRCLE);
  CHECK(world.shapes[0].radius_m == 0.4);
  CHECK(world.shapes[0].height_m == 0.9);
  CHECK(same_bits(world.shapes[0].center, example.shapes[0].center));
  REQUIRE(world.shapes[1].vertex_count == 4);
  CHECK(same_arrays(world.shapes[1].vertices, example.corners.data(), 4));
  REQUIRE(world.segment_count == 2);
  CHECK(same_arrays(world.segments, example.segments.data(), 2));

  REQUIRE(world.planning_grid);
  CHECK(world.planning_grid->width == 3);
  CHECK(world.planning_grid->height == 2);
  CHECK(world.planning_grid->resolution_m == 2.0);
  CHECK(same_bits(world.planning_grid->origin, example.planning.origin));
  CHECK(same_arrays(world.planning_grid->free, example.free.data(), 6));
  CHECK(same_arrays(world.planning_grid->edges, example.edges.data(), 6));
  CHECK(same_arrays(world.planning_grid->clearance, example.clearance.data(), 6));
}

TEST_CASE("a trace gives plans back, and the plan of each sample", "[trace]") {
  const TraceBytes bytes = example_trace(4);
  TraceReader trace(bytes);
  const ExamplePlan example(1);

  REQUIRE(trace.plans().size() == 3);
  const auto& made = trace.plans()[0];
  CHECK(made.conflicts == 3);
  CHECK(made.made_at_ns == 0);
  CHECK(made.plan.revision == 1);
  CHECK(made.plan.step_duration_ns == 1'800'000'000);
  CHECK(made.plan.planning_ns == 432'100);
  CHECK(made.plan.processor_ns == 321'000);
  CHECK(made.plan.status == DMRP_OK);
  REQUIRE(made.plan.path_count == 2);
  REQUIRE(made.plan.paths[0].count == 2);
  REQUIRE(made.plan.paths[1].count == 3);
  CHECK(made.plan.paths[0].flags == 0);
  CHECK(made.plan.paths[1].flags == DMRP_PATH_PARTIAL);
  CHECK(same_arrays(made.plan.paths[0].waypoints, example.first.data(), 2));
  CHECK(same_arrays(made.plan.paths[1].waypoints, example.second.data(), 3));
  REQUIRE(made.plan.statistic_count == 2);
  CHECK(std::string(made.plan.statistics[1].name) == "lower_bound");
  CHECK(made.plan.statistics[1].value == 0.1 + 0.2);
  CHECK(trace.plans()[1].plan.status == DMRP_TIMEOUT);
  CHECK(trace.plans()[2].made_at_ns == 20'000'000);

  CHECK(trace.first_plan() == &trace.plans()[0].plan);
  std::vector<const dmrp_plan*> in_force;
  while (const dmrp_sample* sample = trace.next_sample()) in_force.push_back(sample->plan);
  const dmrp_plan* first = &trace.plans()[0].plan;
  const dmrp_plan* second = &trace.plans()[2].plan;
  CHECK(in_force == std::vector<const dmrp_plan*>{first, first, second, second});
}

TEST_CASE("a trace gives samples back to the bit, repeatedly", "[trace]") {
  const std::int64_t count = 16;
  const TraceBytes bytes = example_trace(count);
  TraceReader trace(bytes);
  REQUIRE(trace.sample_count() == count);
  for (int pass = 0; pass < 2; ++pass, trace.rewind()) {
    for (std::int64_t k = 0; k < count; ++k) {
      const dmrp_sample* sample = trace.next_sample();
      REQUIRE(sample);
      const ExampleSample expected(k, nullptr);
      CHECK(sample->struct_size == sizeof(dmrp_sample));
      CHECK(sample->control_tick == (k % 5 == 0));
      CHECK(sample->t_ns == k * 20'000'000);
      CHECK(sample->dt_ns == (k == 0 ? 0 : 20'000'000));
      REQUIRE(sample->robot_count == 2);
      CHECK(same_arrays(sample->robots, expected.robots.data(), 2));
      REQUIRE(sample->person_count == 2);
      CHECK(same_arrays(sample->people, expected.people.data(), 2));
      REQUIRE(sample->contact_count == expected.sample.contact_count);
      CHECK(same_arrays(sample->contacts, expected.contacts.data(), sample->contact_count));
      REQUIRE(sample->call_count == expected.sample.call_count);
      CHECK(same_arrays(sample->calls, expected.calls.data(), sample->call_count));
      REQUIRE(sample->event_count == expected.sample.event_count);
      CHECK(same_arrays(sample->events, expected.events.data(), sample->event_count));
      REQUIRE(sample->route_count == expected.sample.route_count);
      for (std::uint32_t i = 0; i < sample->route_count; ++i) CHECK(same_routes(sample->routes[i], expected.routes[i]));
    }
    CHECK(trace.next_sample() == nullptr);
  }
}

TEST_CASE("of a route that continues, a trace has the new waypoints alone", "[trace]") {
  const ExampleWorld example;
  std::vector<dmrp_waypoint> course(500);
  for (std::size_t i = 0; i < course.size(); ++i) course[i].x = static_cast<double>(i);
  TraceInMemory encoder(example.world);
  std::vector<std::size_t> sizes;
  for (const std::uint32_t count : {499u, 500u, 400u, 500u}) {
    ExampleSample sample(1, nullptr);
    const dmrp_path path = {sizeof(path), count, sizeof(dmrp_waypoint), 0, course.data()};
    const dmrp_route route = {1, DMRP_PATH_CONTINUES, &path};
    sample.sample.routes = &route;
    sample.sample.route_count = 1;
    const std::size_t before = encoder.bytes().size();
    encoder->sample(sample.sample);
    sizes.push_back(encoder.bytes().size() - before);
  }
  CHECK(sizes[1] == sizes[0] - 498 * sizeof(dmrp_waypoint));
  CHECK(sizes[2] == sizes[0] - 499 * sizeof(dmrp_waypoint));
  CHECK(sizes[3] == sizes[0] - 399 * sizeof(dmrp_waypoint));
  TraceReader trace(encoder.bytes());
  for (const std::uint32_t count : {499u, 500u, 400u, 500u}) {
    const dmrp_sample* sample = trace.next_sample();
    REQUIRE(sample->route_count == 1);
    REQUIRE(sample->routes->path->count == count);
    CHECK(same_arrays(sample->routes->path->waypoints, course.data(), count));
  }
}

TEST_CASE("a trace keeps end, notes and trajectories", "[trace]") {
  const TraceBytes bytes = example_trace(4);
  const TraceReader trace(bytes);
  REQUIRE(trace.end());
  CHECK(trace.end()->ending == DMRP_ENDING_TIME_LIMIT);
  CHECK(trace.end()->t_ns == 80'000'000);
  REQUIRE(trace.end()->robot_count == 2);
  CHECK(trace.end()->robots[0].failure == DMRP_FAILURE_HELD_BEHIND);
  CHECK(trace.end()->robots[0].arrival_ns == -1);
  CHECK(trace.end()->robots[0].visits == 1);
  CHECK(trace.end()->robots[0].culprit == 1);
  CHECK(trace.end()->robots[1].state == DMRP_ROBOT_FINISHED);
  CHECK(trace.reason() == "time limit");
  REQUIRE(trace.notes().size() == 1);
  CHECK(trace.notes()[0].text == "replanned – ok");
  CHECK(trace.notes()[0].t_ns == 20'000'000);
  CHECK(trace.notes()[0].source.robot == 1);
  REQUIRE(trace.trajectories().size() == 1);
  CHECK(trace.trajectories()[0].t_ns == 20'000'000);
  CHECK(trace.trajectories()[0].step_ns == 100'000'000);
  REQUIRE(trace.trajectories()[0].poses.size() == 2);
  CHECK(trace.trajectories()[0].poses[1].theta == 0.5);
}

TEST_CASE("a trace keeps scans", "[trace]") {
  const TraceBytes bytes = example_trace(4);
  const TraceReader trace(bytes);
  REQUIRE(trace.scans().size() == 1);
  const dmrp::core::TraceScan& scan = trace.scans()[0];
  CHECK(scan.t_ns == 20'000'000);
  CHECK(scan.robot == 1);
  CHECK(scan.angle_min == -0.5);
  CHECK(scan.angle_increment == 0.5);
  CHECK(scan.range_max == 10.0);
  CHECK(std::vector<float>(scan.ranges.begin(), scan.ranges.end()) ==
        std::vector<float>{1.5F, std::numeric_limits<float>::infinity(), 0.25F});
}

TEST_CASE("the encoder reads arrays by their owner's stride", "[trace]") {
  struct Grown {
    dmrp_robot_sample robot;
    double younger_field;
  };
  const ExampleSample plain(7, nullptr);
  const std::array<Grown, 2> grown{{{plain.robots[0], 1.0}, {plain.robots[1], 2.0}}};
  dmrp_sample sample = plain.sample;
  sample.robots = &grown[0].robot;
  sample.robot_stride = sizeof(Grown);

  const ExampleWorld example;
  TraceInMemory from_grown(example.world);
  from_grown->sample(sample);
  TraceInMemory from_plain(example.world);
  from_plain->sample(plain.sample);
  CHECK(from_grown.bytes() == from_plain.bytes());
}

TEST_CASE("the sink gets the records that make up the trace", "[trace]") {
  TraceBytes joined;
  std::vector<std::int64_t> times;
  const TraceBytes bytes = example_trace(3, [&](std::int64_t t_ns, std::span<const std::uint8_t> record) {
    joined.insert(joined.end(), record.begin(), record.end());
    times.push_back(t_ns);
  });
  CHECK(joined == bytes);
  CHECK(std::is_sorted(times.begin(), times.end()));
  CHECK(times.size() == 11);  // world, plan, sample, 2 plans, note, sample, trajectory, scan, sample, end
}

TEST_CASE("the trace of an interrupted trial has no end", "[trace]") {
  const ExampleWorld example;
  const ExamplePlan plan(1);
  TraceInMemory encoder(example.world);
  CHECK(TraceReader(encoder.bytes()).first_plan() == nullptr);
  encoder->plan(plan.plan);
  encoder->sample(ExampleSample(0, &plan.plan).sample);
  TraceReader trace(encoder.bytes());
  CHECK(trace.end() == nullptr);
  CHECK(trace.sample_count() == 1);
}

TEST_CASE("a contradictory trace is refused", "[trace]") {
  const ExampleWorld example;
  const ExamplePlan plan(1);
  TraceInMemory encoder(example.world);

  SECTION("a sample with an unknown plan") {
    encoder->sample(ExampleSample(0, &plan.plan).sample);
  }
  SECTION("two plans of one revision") {
    encoder->plan(plan.plan);
    encoder->plan(plan.plan);
  }
  SECTION("a sample of fewer robots") {
    ExampleSample sample(0, nullptr);
    sample.sample.robot_count = 1;
    encoder->sample(sample.sample);
  }
  SECTION("a contact with an unknown person") {
    ExampleSample sample(0, nullptr);
    sample.contacts[1].b = 2;
    encoder->sample(sample.sample);
  }
  SECTION("an event of an unknown robot") {
    ExampleSample sample(0, nullptr);
    sample.events[1].robot = 2;
    encoder->sample(sample.sample);
  }
  SECTION("a call for an unknown robot") {
    ExampleSample sample(0, nullptr);
    sample.calls[0].robot = 2;
    encoder->sample(sample.sample);
  }
  SECTION("two routes of one robot") {
    ExampleSample sample(0, nullptr);
    sample.routes[1].robot = 0;
    encoder->sample(sample.sample);
  }
  SECTION("a plan of fewer paths") {
    dmrp_plan fewer = plan.plan;
    fewer.path_count = 1;
    encoder->plan(fewer);
  }
  SECTION("a record after the end") {
    encoder->end({sizeof(dmrp_trial_end), DMRP_ENDING_NO_PLAN, 0, std::array<dmrp_robot_end, 2>{}.data(), 2,
                  sizeof(dmrp_robot_end)});
    encoder->note({}, "too late");
  }
  CHECK_THROWS_AS(TraceReader(encoder.bytes()), TraceError);
}

TEST_CASE("a trace of an unknown format version is refused", "[trace]") {
  TraceBytes bytes = example_trace(1);
  for (const std::uint8_t version : {1, 3, 5}) {
    bytes[dmrp::core::trace_record_prefix_bytes] = version;
    CHECK_THROWS_WITH(TraceReader(bytes), "trace, byte 5: format version " + std::to_string(version) +
                                              "; this program reads version 4: run the experiment again");
  }
  bytes[dmrp::core::trace_record_prefix_bytes] = 0;
  CHECK_THROWS_AS(TraceReader(bytes), TraceError);
  CHECK_THROWS_AS(TraceReader(TraceBytes{}), TraceError);
}

TEST_CASE("a truncated trace is refused unless it ends between records", "[trace]") {
  std::vector<std::size_t> boundaries;
  std::size_t written = 0;
  const TraceBytes bytes = example_trace(
      3, [&](std::int64_t, std::span<const std::uint8_t> record) { boundaries.push_back(written += record.size()); });
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const bool whole = std::find(boundaries.begin(), boundaries.end(), length) != boundaries.end();
    const TraceBytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    if (read_or_refuse(cut) != int{whole}) FAIL("cut at byte " << length);
  }
}

TEST_CASE("a damaged trace is read or refused, never trusted", "[trace]") {
  const TraceBytes bytes = example_trace(4);
  dmrp::toolkit::Stream random(1, "trace.damage");
  int refused = 0;
  for (int round = 0; round < 20'000; ++round) {
    TraceBytes damaged = bytes;
    const std::uint64_t flips = 1 + random.below(3);
    for (std::uint64_t flip = 0; flip < flips; ++flip)
      damaged[random.below(damaged.size())] ^= static_cast<std::uint8_t>(1 + random.below(255));
    refused += 1 - read_or_refuse(damaged);
  }
  CHECK(refused > 500);     // lengths, counts, kinds
  CHECK(refused < 19'000);  // most bytes are those of numbers
}

}  // namespace trace_test
