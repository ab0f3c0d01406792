// SPDX-License-Identifier: MIT
// Every controller with every drive that it can drive, in small worlds: the robot arrives, touches nothing, and never
// gets a command outside its drive's ability.
#include <catch2/catch.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/controllers.hpp"

namespace drives_test {

using namespace dmrp::test;

struct Driven {
  std::string controller;
  std::string body;
};

std::ostream& operator<<(std::ostream& out, const Driven& driven) {
  return out << driven.controller << " drives a " << driven.body;
}

// All pairs but the differential ones, which the behaviour tests drive.
std::vector<Driven> all_pairs() {
  std::vector<Driven> pairs;
  for (const char* body : {"holonomic disc", "holonomic rectangle"})
    for (const char* controller : {"dwa", "teb", "mpc", "pure_pursuit"}) pairs.push_back({controller, body});
  for (const char* body : {"car-like disc", "car-like rectangle"})
    for (const char* controller : {"teb", "mpc", "pure_pursuit"}) pairs.push_back({controller, body});
  return pairs;
}

// Without those of which the README says that they wait before an obstacle.
std::vector<Driven> evading_pairs() {
  std::vector<Driven> pairs = all_pairs();
  const auto waits = [](const Driven& driven) { return driven.controller == "pure_pursuit"; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), waits), pairs.end());
  return pairs;
}

Body body_of(const std::string& name) {
  Body body;
  if (name.find("holonomic") == 0) {
    body.kinematics = DMRP_KINEMATICS_HOLONOMIC;
    body.limits = holonomic_limits(-0.4, 0.8, 0.4, 1.0, 1.0, 1.0);
    return name == "holonomic disc" ? body : with_rectangle(body, 0.35, 0.35, 0.2);
  }
  body.kinematics = DMRP_KINEMATICS_ACKERMANN;
  body.limits = ackermann_limits(0.0, 0.8, 1.0, 0.4, 0.6);  // turns within 0.58 m
  return name == "car-like disc" ? body : with_rectangle(body, 0.5, 0.15, 0.2);
}

// Drives the course from starts a little aside of its start.
void check_drives(const Driven& driven, Course course, double within_s) {
  course.body = body_of(driven.body);
  const std::string id = "dmrp.controller." + driven.controller;
  dmrp::toolkit::Stream random(7, driven.controller + driven.body);
  const bool is_slow = driven.controller == "dwa" && driven.body == "holonomic rectangle";  // 300 outlines a step
  for (int i = 0; i < draws(is_slow ? 1 : 2); ++i) {
    course.start = {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.2, 0.2)};
    CAPTURE(driven, i, course.start.x, course.start.y, course.start.theta);
    check_arrives(run(id, course, tuned_parameters(id)), within_s);
  }
}

TEST_CASE("Each drive crosses an open hall", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {3.0, 0.0}, {7.0, 4.0}});
  check_drives(GENERATE(from_range(all_pairs())), course, 20.0);
}

TEST_CASE("Each drive follows a corridor", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = corridor(1.6);
  check_drives(GENERATE(from_range(all_pairs())), course, 20.0);
}

TEST_CASE("Each drive takes a corner between walls", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}});
  course.boxes = {{{-2.0, -1.2}, {6.2, -1.0}}, {{6.0, -1.0}, {6.2, 7.0}}, {{-2.0, 1.0}, {4.0, 7.0}}};
  check_drives(GENERATE(from_range(all_pairs())), course, 25.0);
}

TEST_CASE("Each drive passes a doorway", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = {{{3.5, 0.5}, {3.7, 5.0}}, {{3.5, -5.0}, {3.7, -0.5}}};
  check_drives(GENERATE(from_range(all_pairs())), course, 20.0);
}

TEST_CASE("Each drive passes an obstacle that stands on the path", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = {{{3.7, -0.3}, {4.3, 0.4}}};
  check_drives(GENERATE(from_range(evading_pairs())), course, 25.0);
}

TEST_CASE("A car-like robot that faces away turns round where there is room", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.body = body_of("car-like rectangle");
  course.start = {0.0, 0.0, 3.0};
  const std::string id = "dmrp.controller." + GENERATE(as<std::string>(), "teb", "mpc", "pure_pursuit");
  CAPTURE(id);
  check_arrives(run(id, course, tuned_parameters(id)), 25.0);
}

TEST_CASE("A holonomic robot goes round an obstacle sideways, without turning far", "[drives]") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {3.0, 0.0}});
  course.goal_heading = 0.0;
  course.boxes = {{{1.3, -0.2}, {1.6, 0.3}}};
  course.body = body_of("holonomic disc");
  const std::string id = "dmrp.controller." + GENERATE(as<std::string>(), "dwa", "teb", "mpc");
  CAPTURE(id);
  const Drive drive = run(id, course, tuned_parameters(id));
  check_arrives(drive, 20.0);
  double fastest_aside = 0.0;
  for (const dmrp_command& command : drive.commands) fastest_aside = std::max(fastest_aside, std::abs(command.v_y));
  CHECK(fastest_aside > 0.1);
}

}  // namespace drives_test
