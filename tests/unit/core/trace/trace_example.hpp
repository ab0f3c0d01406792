// SPDX-License-Identifier: MIT
// A small trial with something of everything that a trace holds, and what two of them have in common.
#pragma once

#include <dmrp/descriptor.h>
#include <dmrp/robot_event.h>
#include <dmrp/sample.h>
#include <dmrp/status.h>
#include <dmrp/trial_end.h>
#include <dmrp/world.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::test {

// Two robots (a disc and an arrow of two parts, one with a tour), a circle and a polygon, a grid. Never moved or copied: the
// world points into it.
struct ExampleWorld {
  dmrp_limits limits{sizeof(dmrp_limits), 0, 0.0, 0.8, 0.0, 1.0, 1.0, 1.5, 0.0, 0.0, 0.0};
  dmrp_limits steering_limits{sizeof(dmrp_limits), 0, -0.1, 0.9, 0.0, 1.0, 1.1, 1.6, 0.32, 0.5, 0.7};
  std::array<dmrp_vec2, 3> front{{{0.3, 0.0}, {-0.2, 0.25}, {-0.2, -0.25}}};
  std::array<dmrp_vec2, 4> back{{{-0.2, -0.1}, {-0.2, 0.1}, {-0.4, 0.1}, {-0.4, -0.1}}};
  std::array<dmrp_polygon, 2> parts{{{front.data(), 3, 0}, {back.data(), 4, 0}}};
  dmrp_footprint disc{sizeof(dmrp_footprint), 0, 0.25, 0.25, nullptr, 0, 0};
  dmrp_footprint arrow{sizeof(dmrp_footprint), 2, 0.42, 0.15, parts.data(), sizeof(dmrp_polygon), 0};
  std::array<dmrp_goal, 3> goals{{{{5.5, 1.5, std::nan("")}, 0.2, 0.2, 0.1, 500'000'000},
                                  {{1.5, 5.5, 0.5}, 0.2, 0.3, 0.1, 500'000'000},
                                  {{2.5, 2.5, -3.0}, 0.25, 0.2, 0.1, 0}}};
  std::array<dmrp_robot, 2> robots{
      {{"r0", "", DMRP_KINEMATICS_DIFFERENTIAL, 1, &goals[0], sizeof(dmrp_goal), 0, &limits, &disc, {0.5, 0.5, 0.0}},
       {"rö1",
        "forklift",
        DMRP_KINEMATICS_ACKERMANN,
        2,
        &goals[1],
        sizeof(dmrp_goal),
        0,
        &steering_limits,
        &arrow,
        {5.5, 5.5, 3.1}}}};
  std::array<dmrp_vec2, 4> corners{{{2, 3}, {4, 3}, {4, 4}, {2, 4}}};
  std::array<dmrp_shape, 2> shapes{{{"planter", DMRP_SHAPE_CIRCLE, 0, {3, 1}, 0.4, nullptr, 0.9},
                                    {"shelf", DMRP_SHAPE_POLYGON, 4, {0, 0}, 0, corners.data(), 2.0}}};
  std::array<dmrp_segment, 2> segments{{{{0, 0}, {6, 0}}, {{6, 0}, {6, 6}}}};
  std::array<std::uint8_t, 6> free{1, 0, 1, 1, 1, 0};
  std::array<std::uint8_t, 6> edges{0x01, 0, 0xff, 7, 9, 0};
  std::array<float, 6> clearance{0.5F, 0.0F, 1.25F, 0.1F, 3.0F, std::numeric_limits<float>::infinity()};
  dmrp_grid planning{sizeof(dmrp_grid), 3, 2, 0, 2.0, {0.0, 1.0}, free.data(), edges.data(), clearance.data()};
  dmrp_world world{};

  ExampleWorld() {
    world.struct_size = sizeof(dmrp_world);
    world.person_count = 2;
    world.person_radius_m = 0.35;
    world.lower = {0, 0};
    world.upper = {6, 6};
    world.step_ns = 20'000'000;
    world.control_period_ns = 100'000'000;
    world.time_limit_ns = 180'000'000'000;
    world.call_budget_ns = 50'000'000;
    world.robots = robots.data();
    world.robot_count = 2;
    world.robot_stride = sizeof(dmrp_robot);
    world.shapes = shapes.data();
    world.shape_count = 2;
    world.shape_stride = sizeof(dmrp_shape);
    world.segments = segments.data();
    world.segment_count = 2;
    world.planning_grid = &planning;
  }
  ExampleWorld(const ExampleWorld&) = delete;
  ExampleWorld& operator=(const ExampleWorld&) = delete;
};

struct ExamplePlan {
  std::vector<dmrp_waypoint> first;
  std::vector<dmrp_waypoint> second;
  std::array<dmrp_path, 2> paths{};
  std::array<dmrp_statistic, 2> statistics{{{"cost", 12.0}, {"lower_bound", 0.1 + 0.2}}};
  dmrp_plan plan{};

  explicit ExamplePlan(std::uint64_t revision)
      : first{{0.5, 0.5, std::nan(""), 0, 0, 0}, {1.5, 0.5, 0.25, 1'800'000'000, 0, 0}},
        second{{5.5, 5.5, 0.0, 0, 0, 0}, {5.5, 5.5, 0.0, 1'800'000'000, 0, 0}, {4.5, 5.5, 0.0, 3'600'000'000, 1, 0}} {
    paths[0] = {sizeof(dmrp_path), 2, sizeof(dmrp_waypoint), 0, first.data()};
    paths[1] = {sizeof(dmrp_path), 3, sizeof(dmrp_waypoint), DMRP_PATH_PARTIAL, second.data()};
    plan = {sizeof(dmrp_plan),
            2,
            paths.data(),
            sizeof(dmrp_path),
            2,
            statistics.data(),
            sizeof(dmrp_statistic),
            DMRP_OK,
            revision,
            0,
            1'800'000'000,
            432'100,
            321'000};
  }
  ExamplePlan(const ExamplePlan&) = delete;
  ExamplePlan& operator=(const ExamplePlan&) = delete;
};

// The state at step `k`: awkward numbers that depend on k.
struct ExampleSample {
  std::array<dmrp_robot_sample, 2> robots{};
  std::array<dmrp_person, 2> people{};
  std::array<dmrp_contact, 2> contacts{};
  std::array<dmrp_call, 3> calls{};
  std::array<dmrp_robot_event, 3> events{};
  std::vector<dmrp_waypoint> course;
  std::array<dmrp_path, 2> paths{};
  std::array<dmrp_route, 2> routes{};
  dmrp_sample sample{};

  ExampleSample(std::int64_t k, const dmrp_plan* plan) {
    const double x = static_cast<double>(k) / 3.0;
    robots[0] = {
        {x, 0.1, -0.0}, {0.5, 0.0, x}, {0.6, 0.0, -x}, DMRP_ROBOT_ACTIVE, 0, x, 0.0, {2.0, 0.0, -x}, DMRP_WARNING, 0};
    robots[1] = {{-x, 1e-310, 3.0},
                 {0, 0, 0},
                 {0, 0, 0},
                 DMRP_ROBOT_FINISHED,
                 1,
                 2.0,
                 -0.3,
                 {std::nan(""), std::nan(""), std::nan("")},
                 DMRP_NO_SOLUTION,
                 0};
    people[0] = {41, 3, 7, {1.0, x}, {0.1, 1.1}, 0.3, 1.25, {9.0, x}, {8.0, -1.0}, {10.0, 1.0}, DMRP_REACTION_CURIOUS,
                 0};
    people[1] = {
        static_cast<std::uint64_t>(100 + k), 0, 8, {2.0, x}, {0.1, -1.1}, 0.3, 0.7, {x, 4.0}, {0.0, 3.0}, {5.0, 5.0},
        DMRP_REACTION_UNSPECIFIED,           0};
    contacts[0] = {DMRP_CONTACT_STATIC, DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A, 0, 2, 0.0011, {0.0, 0.5}, 0.35};
    contacts[1] = {DMRP_CONTACT_PERSON, DMRP_CONTACT_FAULT_B, 1, 1, 0.02, {2.0, x}, std::nan("")};
    calls[0] = {DMRP_CALL_CONTROL, 0, DMRP_OK, 0, 81'000 + k};
    calls[1] = {DMRP_CALL_CONTROL, 1, DMRP_NO_SOLUTION, 0, 11'000};
    calls[2] = {DMRP_CALL_PEOPLE, DMRP_ALL_ROBOTS, DMRP_OK, 0, 3'000};
    events[0] = {DMRP_ROBOT_EVENT_CLASS, 0, k * 20'000'000, DMRP_CLASS_HELD, 1};
    events[1] = {DMRP_ROBOT_EVENT_CLIPPED, 1, k * 20'000'000 - 10, 0, DMRP_NOBODY};
    events[2] = {77, 1, k * 20'000'000, 0xffffffff, 0};  // of a kind that is not known
    add_routes(k);
    sample.struct_size = sizeof(dmrp_sample);
    sample.control_tick = k % 5 == 0;
    sample.t_ns = k * 20'000'000;
    sample.dt_ns = k == 0 ? 0 : 20'000'000;
    sample.plan = plan;
    sample.robots = robots.data();
    sample.robot_count = 2;
    sample.robot_stride = sizeof(dmrp_robot_sample);
    sample.people = people.data();
    sample.person_count = 2;
    sample.person_stride = sizeof(dmrp_person);
    sample.contacts = contacts.data();
    sample.contact_count = k % 3 == 0 ? 2 : 0;
    sample.contact_stride = sizeof(dmrp_contact);
    sample.calls = calls.data();
    sample.call_count = k % 5 == 0 ? 3 : 1;
    sample.call_stride = sizeof(dmrp_call);
    sample.events = events.data();
    sample.event_count = k % 4 == 0 ? 3 : 0;
    sample.event_stride = sizeof(dmrp_robot_event);
  }
  ExampleSample(const ExampleSample&) = delete;
  ExampleSample& operator=(const ExampleSample&) = delete;

  // The first robot's path grows, and begins anew in every eighth sample, where it is partial; the second robot has a
  // path now and then.
  void add_routes(std::int64_t k) {
    const std::int64_t turn = k / 8;
    for (std::int64_t i = 0; i <= k % 8 + 1; ++i)
      course.push_back({0.1 * static_cast<double>(i), static_cast<double>(turn), std::nan(""), i + turn, 0, 0});
    const auto count = static_cast<std::uint32_t>(course.size());
    paths[0] = {sizeof(dmrp_path), count, sizeof(dmrp_waypoint), k % 8 == 0 ? DMRP_PATH_PARTIAL : 0, course.data()};
    paths[1] = {sizeof(dmrp_path), 1, sizeof(dmrp_waypoint), 0, course.data()};
    routes[0] = {0, k % 8 == 0 ? 0 : DMRP_PATH_CONTINUES, &paths[0]};
    routes[1] = {1, 0, &paths[1]};
    sample.routes = routes.data();
    sample.route_count = k % 2 == 1 ? 0 : k % 3 == 0 ? 2 : 1;
    sample.route_stride = sizeof(dmrp_route);
  }
};

// A whole trial of `samples` steps: a second plan comes after half of them.
inline core::TraceBytes example_trace(std::int64_t samples, const core::TraceEncoder::RecordSink& sink = {},
                                      core::FoxgloveChannels* foxglove = nullptr) {
  const ExampleWorld example;
  const ExamplePlan first(1);
  const ExamplePlan second(2);
  core::TraceBytes bytes;
  core::TraceEncoder trace(
      example.world,
      [&](std::int64_t t_ns, std::span<const std::uint8_t> record) {
        bytes.insert(bytes.end(), record.begin(), record.end());
        if (sink) sink(t_ns, record);
      },
      foxglove);
  trace.plan(first.plan, 3);
  for (std::int64_t k = 0; k < samples; ++k) {
    if (k == samples / 2) {
      dmrp_plan failed{};  // an attempt without a plan
      failed.struct_size = sizeof(failed);
      failed.revision = 2;
      failed.status = DMRP_TIMEOUT;
      trace.plan(failed);
      trace.plan(second.plan);
      trace.note({DMRP_KIND_LOCAL_CONTROLLER, 1}, "replanned – ok");
    }
    trace.sample(ExampleSample(k, k < samples / 2 ? &first.plan : &second.plan).sample);
    if (k == 1) {
      const std::array<dmrp_pose, 2> poses{{{0, 0, 0}, {0.1, 0, 0.5}}};
      trace.trajectory({DMRP_KIND_LOCAL_CONTROLLER, 0}, 1, poses, 100'000'000);
      const std::array<float, 3> ranges{1.5F, std::numeric_limits<float>::infinity(), 0.25F};
      trace.scan(1, {sizeof(dmrp_scan), 3, 20'000'000, -0.5, 0.5, 0.0, 10.0, ranges.data()});
    }
  }
  const std::array<dmrp_robot_end, 2> robots{{{DMRP_ROBOT_FAILED, DMRP_FAILURE_HELD_BEHIND, -1, 1, 1},
                                              {DMRP_ROBOT_FINISHED, DMRP_FAILURE_NONE, 0, 2, DMRP_NOBODY}}};
  const dmrp_trial_end end{sizeof(dmrp_trial_end), DMRP_ENDING_TIME_LIMIT, samples * 20'000'000, robots.data(), 2,
                           sizeof(dmrp_robot_end)};
  trace.end(end, "time limit");
  return bytes;
}

}  // namespace dmrp::test
