// SPDX-License-Identifier: MIT
// Reads a trace of format version 1: the channel dmrp/trace of tests/same_bits/v1_trial/, run by dmrp-host of commit
// e7aacf7, the last before version 2. Expected values were printed by the reader of that commit; the tests of
// tests/same_bits/ compare all others.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"

using namespace dmrp::core;

namespace {

TraceReader v1_trial() {
  return TraceReader(TraceRecords(std::filesystem::path(DMRP_V1_TRIAL)));
}

dmrp_sample last_sample(TraceReader& trace) {
  dmrp_sample last{};
  while (const dmrp_sample* sample = trace.next_sample()) last = *sample;
  return last;
}

}  // namespace

TEST_CASE("a trace of version 1 gives its world", "[trace]") {
  const TraceReader trace = v1_trial();
  const dmrp_world& world = trace.world();
  CHECK(world.struct_size == sizeof(dmrp_world));
  CHECK(world.person_count == 2);
  CHECK(world.person_radius_m == 0.0);  // not known
  CHECK(world.lower.y == 0.5);
  CHECK(world.upper.x == 5.0);
  CHECK(world.step_ns == 50'000'000);
  CHECK(world.control_period_ns == 500'000'000);
  CHECK(world.time_limit_ns == 1'000'000'000);
  CHECK(world.call_budget_ns == 1'000'000'000);
  CHECK(world.segment_count == 31);
  CHECK(world.segments[30].to.y == 0.5);

  REQUIRE(world.robot_count == 2);
  const dmrp_robot& anna = world.robots[0];
  CHECK(anna.name == std::string("anna"));
  CHECK(anna.type == std::string());
  CHECK(anna.start.theta == 0.25);
  REQUIRE(anna.goal_count == 2);
  CHECK(std::isnan(anna.goals[0].pose.theta));
  CHECK(anna.goals[1].pose.theta == 1.5);
  CHECK(anna.goals[1].settle_ns == 500'000'000);
  const dmrp_robot& bert = world.robots[1];
  CHECK(bert.kinematics == DMRP_KINEMATICS_DIFFERENTIAL);
  CHECK(bert.start.theta == 3.1415926535897931);
  CHECK(bert.limits->struct_size == sizeof(dmrp_limits));
  CHECK(bert.limits->v_max == 0.8);
  CHECK(bert.limits->alpha_max == 1.0);
  CHECK(bert.limits->wheelbase_m == 0.0);
  CHECK(bert.limits->steering_max == 0.0);
  CHECK(bert.limits->steering_rate_max == 0.0);
  CHECK(bert.footprint->struct_size == sizeof(dmrp_footprint));
  CHECK(bert.footprint->inscribed_radius_m == 0.25);
  CHECK(bert.footprint->part_count == 0);
  CHECK(bert.footprint->parts == nullptr);

  REQUIRE(world.shape_count == 2);
  CHECK(world.shapes[0].name == std::string("planter"));
  CHECK(world.shapes[0].radius_m == 0.4);
  CHECK(world.shapes[0].height_m == 0.9);
  CHECK(world.shapes[1].kind == DMRP_SHAPE_POLYGON);
  REQUIRE(world.shapes[1].vertex_count == 3);
  CHECK(world.shapes[1].vertices[2].x == 4.4);

  REQUIRE(world.planning_grid);
  CHECK(world.planning_grid->width == 6);
  CHECK(world.planning_grid->height == 5);
  CHECK(world.planning_grid->free[0] == 1);
  CHECK(world.planning_grid->edges[7] == 255);
  CHECK(world.planning_grid->clearance[7] == 1.5f);
}

TEST_CASE("a trace of version 1 gives its plan, scans and annotations", "[trace]") {
  const TraceReader trace = v1_trial();
  REQUIRE(trace.plans().size() == 1);
  const dmrp_plan& plan = trace.plans()[0].plan;
  CHECK(plan.revision == 1);
  CHECK(plan.planning_ns == 93'779);
  REQUIRE(plan.path_count == 2);
  REQUIRE(plan.paths[1].count == 7);
  CHECK(plan.paths[1].stride == sizeof(dmrp_waypoint));
  CHECK(plan.paths[1].waypoints[6].x == 0.5);
  CHECK(plan.paths[1].waypoints[6].t_ns == 10'800'000'000);
  CHECK(plan.paths[0].waypoints[4].goal_index == 1);
  CHECK(plan.paths[0].waypoints[4].reserved == 0);
  REQUIRE(plan.statistic_count == 5);
  CHECK(plan.statistics[0].name == std::string("lower_bound"));
  CHECK(plan.statistics[0].value == 10.0);

  REQUIRE(trace.scans().size() == 4);
  CHECK(trace.scans()[3].t_ns == 500'000'000);
  CHECK(trace.scans()[3].robot == 1);
  CHECK(trace.scans()[3].angle_increment == 0.52359877559829882);
  REQUIRE(trace.scans()[3].ranges.size() == 12);
  CHECK(std::isinf(trace.scans()[3].ranges[3]));
  REQUIRE(trace.trajectories().size() == 5);
  CHECK(trace.trajectories()[4].step_ns == 112'323'089);
  REQUIRE(trace.trajectories()[4].poses.size() == 32);
  CHECK(trace.trajectories()[4].poses[31].theta == -3.1415926535897922);
  REQUIRE(trace.notes().size() == 4);
  CHECK(trace.notes()[2].text == "iterations 40, bands 2");
  CHECK(trace.notes()[2].t_ns == 500'000'000);
}

TEST_CASE("a trace of version 1 gives its samples and its end", "[trace]") {
  TraceReader trace = v1_trial();
  REQUIRE(trace.sample_count() == 21);
  const dmrp_sample sample = last_sample(trace);
  CHECK(sample.t_ns == 1'000'000'000);
  CHECK(sample.control_tick == 1);
  CHECK(sample.plan == trace.first_plan());
  REQUIRE(sample.robot_count == 2);
  CHECK(sample.robots[1].pose.theta == -2.8558694748812634);
  CHECK(sample.robots[1].velocity.omega == 0.34293210125129875);
  CHECK(sample.robots[1].command.v_x == 0.57835284632714878);
  CHECK(sample.robots[1].state == DMRP_ROBOT_ACTIVE);
  CHECK(sample.robots[1].steering_angle == 0.0);
  REQUIRE(sample.person_count == 2);
  REQUIRE(sample.person_stride == sizeof(dmrp_person));
  CHECK(sample.people[0].id == 2);
  CHECK(sample.people[0].position.x == 1.0336912900456885);
  CHECK(sample.people[0].target.y == 2.8015302865001122);
  CHECK(sample.people[0].area_upper.y == 3.6);
  CHECK(sample.people[0].reaction == DMRP_REACTION_UNSPECIFIED);
  CHECK(sample.people[1].id == 1);
  CHECK(sample.people[1].velocity.y == 0.24999999999999911);
  CHECK(sample.people[1].area_lower.x == -1.0);
  REQUIRE(sample.contact_count == 1);
  CHECK(sample.contacts[0].flags == DMRP_CONTACT_FAULT_B);
  CHECK(sample.contacts[0].b == 1);
  CHECK(sample.contacts[0].depth_m == 0.032438300444769974);
  CHECK(std::isnan(sample.contacts[0].impact_speed));
  REQUIRE(sample.call_count == 1);
  CHECK(sample.calls[0].kind == DMRP_CALL_PEOPLE);
  CHECK(sample.calls[0].other == 0);
  CHECK(sample.calls[0].duration_ns == 2'293);

  REQUIRE(trace.end());
  CHECK(trace.end()->ending == DMRP_ENDING_TIME_LIMIT);
  REQUIRE(trace.end()->robot_count == 2);
  CHECK(trace.end()->robots[1].failure == DMRP_FAILURE_TIMEOUT);
  CHECK(trace.end()->robots[1].arrival_ns == -1);
  CHECK(trace.end()->robots[1].visits == 0);
  CHECK(trace.end()->robots[1].culprit == DMRP_NOBODY);
  CHECK(trace.reason() == "time limit");
}
