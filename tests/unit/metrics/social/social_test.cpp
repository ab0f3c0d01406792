// SPDX-License-Identifier: MIT
// Proxemics, group intrusion, social work and pedestrian progress: cases computed by hand.
#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace social_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

dmrp_person person(double x, double y, std::uint32_t group = 0) {
  dmrp_person person{};
  person.position = {x, y};
  person.radius_m = 0.3;
  person.group = group;
  return person;
}

dmrp_person moving(dmrp_person person, double v_x, double v_y) {
  person.velocity = {v_x, v_y};
  return person;
}

// Walks to the square of 2 m about `target`.
dmrp_person walker(std::uint64_t id, dmrp_vec2 position, dmrp_vec2 target, double speed = 1.0) {
  dmrp_person person{};
  person.id = id;
  person.position = position;
  person.velocity = {speed, 0.0};
  person.desired_speed = 1.2;
  person.area_lower = {target.x - 1, target.y - 1};
  person.area_upper = {target.x + 1, target.y + 1};
  return person;
}

TEST_CASE("proxemics uses the nearest person's surface, and zones include their outer bounds") {
  // surfaces are 0.55 m nearer than centres
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).crowd({person(0.6, 0)});
  trial.sample(1.0, {at(0, 0)}).crowd({person(0, 0.9), person(2, 0)});  // 0.35: intimate, 1 s
  trial.sample(3.0, {at(0, 0)}).crowd({person(5, 0), person(0, 1.7)});  // 1.15: personal, 2 s
  trial.sample(6.0, {at(0, 0)}).crowd({person(0, -4.1)});               // 3.55: social, 3 s
  trial.sample(10.0, {at(0, 0)}).crowd({person(0, -4.2)});              // 3.65: none, 4 s
  trial.sample(30.0, {at(0, 0)});                                       // nobody: not counted
  trial.sample(31.0, {at(0, 0, 0.0, parked)}).crowd({person(0, 0.2)});  // overlap: intimate, 1 s
  trial.sample(99.0, {at(0, 0, 0.0, parked)}).crowd({person(0, 0.9)});  // parked: not counted
  trial.end(99.0, {31.0});
  const Measurement m = measure("dmrp.metric.proxemics", trial);
  CHECK_THAT(m.system("proxemics_intimate"), WithinAbs(100.0 * 2 / 11, 1e-13));
  CHECK_THAT(m.system("proxemics_personal"), WithinAbs(100.0 * 2 / 11, 1e-13));
  CHECK_THAT(m.system("proxemics_social"), WithinAbs(100.0 * 3 / 11, 1e-13));
}

TEST_CASE("a robot intrudes between two members of a group, not beside them or between people without a group") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  const std::vector<dmrp_person> pair = {person(-1, 0.2, 7), person(1, 0.2, 7), person(0, 0), person(0, 1, 8)};
  trial.sample(1.0, {at(0, 0)}).crowd(pair);       // 0.2 m from the segment
  trial.sample(2.0, {at(0, 0.1)}).crowd(pair);     // the same intrusion
  trial.sample(3.0, {at(0, 0.46)}).crowd(pair);    // 0.26 m: out
  trial.sample(4.0, {at(1.24, 0.2)}).crowd(pair);  // 0.24 m beyond its end: in again
  trial.sample(6.0, {at(1.25, 0.2)}).crowd(pair);  // touching is not cutting
  trial.sample(99.0, {at(0, 0)}).crowd({person(-1, 0), person(1, 0), person(0, 0, 8)});  // no group
  trial.end(99.0, {never});
  const Measurement m = measure("dmrp.metric.group_intrusion", trial);
  CHECK(m.system("group_intrusions") == 2.0);
  CHECK(m.system("group_intrusion_time") == 50.0);  // 3 s of 6
}

TEST_CASE("a robot intrudes a larger group anywhere inside its hull") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  // a square of 8 m with members inside it, two of them at one place, one on a side
  const std::vector<dmrp_person> group = {person(4, 4, 1), person(-4, -4, 1), person(4, -4, 1), person(-4, 4, 1),
                                          person(3, 3, 1), person(3, 3, 1),   person(0, 4, 1)};
  trial.sample(1.0, {at(0, 0)}).crowd(group);
  trial.sample(2.0, {at(4.2, 1)}).crowd(group);
  trial.sample(3.0, {at(4.3, 1)}).crowd(group);
  trial.sample(4.0, {at(4.17, 4.17)}).crowd(group);  // sqrt(2) * 0.17 m from the corner
  trial.sample(5.0, {at(4.18, 4.18)}).crowd(group);
  trial.end(5.0, {never});
  const Measurement m = measure("dmrp.metric.group_intrusion", trial);
  CHECK(m.system("group_intrusion_time") == 60.0);
  CHECK(m.system("group_intrusions") == 2.0);
}

TEST_CASE("the hull of a group in a line is a segment, that of a group at one place a point") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  trial.sample(1.0, {at(0, 0.2)}).crowd({person(-2, 0, 1), person(1, 0, 1), person(2, 0, 1)});
  trial.sample(2.0, {at(0, 0.2)}).crowd({person(0, 0, 1), person(0, 0, 1)});
  trial.sample(4.0, {at(0, 0.3)}).crowd({person(-2, 0, 1), person(1, 0, 1), person(2, 0, 1)});
  trial.end(4.0, {never});
  CHECK(measure("dmrp.metric.group_intrusion", trial).system("group_intrusion_time") == 50.0);
}

TEST_CASE("group intrusion without groups is undefined") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(0, 0)}).crowd({person(0, 0)}).end(1.0);
  const Measurement m = measure("dmrp.metric.group_intrusion", trial);
  CHECK(std::isnan(m.system("group_intrusions")));
  CHECK(std::isnan(m.system("group_intrusion_time")));
}

TEST_CASE("social work integrates the forces between robot and people over time") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  SECTION("both at rest: 2.1 exp(-d / 0.35) each, for 2 s") {
    trial.sample(2.0, {at(0, 0)}).crowd({person(1, 0)}).end(2.0, {never});
    const Measurement m = measure("dmrp.metric.social_work", trial);
    const double force = 2.1 * std::exp(-1.0 / 0.35);
    CHECK_THAT(m.system("social_work_robot"), WithinAbs(2 * force, 1e-14));
    CHECK_THAT(m.system("social_work_people"), WithinAbs(2 * force, 1e-14));
    CHECK_THAT(m.system("social_work"), WithinAbs(4 * force, 1e-14));
  }
  SECTION("on the robot the forces of two people cancel, on people they do not") {
    trial.sample(1.0, {at(0, 0)}).crowd({person(1, 0), person(-1, 0)}).end(1.0, {never});
    const Measurement m = measure("dmrp.metric.social_work", trial);
    CHECK_THAT(m.system("social_work_robot"), WithinAbs(0.0, 1e-15));
    CHECK_THAT(m.system("social_work_people"), WithinAbs(2 * 2.1 * std::exp(-1.0 / 0.35), 1e-14));
  }
  SECTION("driving at somebody: D = 2 * 1 + 1, B = 1.05, theta 0") {
    trial.sample(1.0, {at(0, 0, 1.0)}).crowd({person(2, 0)}).end(1.0, {never});
    CHECK_THAT(measure("dmrp.metric.social_work", trial).system("social_work_people"),
               WithinAbs(2.1 * std::exp(-2.0 / 1.05), 1e-14));
  }
  SECTION("somebody who walks past: D at 45 degrees to the line between them") {
    trial.sample(1.0, {at(0, 0)}).crowd({moving(person(1, 0), 0.0, -0.5)}).end(1.0, {never});
    const double reach = 0.35 * std::sqrt(2.0), theta = M_PI / 4;
    const double along = std::exp(-1.0 / reach - std::pow(3 * reach * theta, 2));
    const double aside = std::exp(-1.0 / reach - std::pow(2 * reach * theta, 2));
    const Measurement m = measure("dmrp.metric.social_work", trial);
    const double force = 2.1 * std::sqrt(along * along + aside * aside);
    CHECK_THAT(m.system("social_work_robot"), WithinAbs(force, 1e-14));
    CHECK_THAT(m.system("social_work_people"), WithinAbs(force, 1e-14));
  }
  SECTION("a wall at 0.1 m presses on the robot by 10 exp(-0.5)") {
    trial.box("wall", {0.35, -1}, {1, 1});
    trial.sample(1.0, {at(0, 0)}).crowd({person(500, 0)}).end(1.0, {never});
    CHECK_THAT(measure("dmrp.metric.social_work", trial).system("social_work"), WithinAbs(10 * std::exp(-0.5), 1e-12));
  }
  SECTION("forces are taken at control steps and on arrival, each for the time since the last") {
    trial.sample(1.0, {at(0, 0)}).crowd({person(0.1, 0)}).without_control();
    trial.sample(2.0, {at(0, 0)}).crowd({person(1, 0)});                                   // for 2 s
    trial.sample(3.0, {at(0, 0, 0.0, parked)}).crowd({person(0.5, 0)}).without_control();  // for 1 s
    trial.sample(4.0, {at(0, 0, 0.0, parked)}).crowd({person(0.5, 0)});
    trial.end(4.0, {3.0});
    CHECK_THAT(measure("dmrp.metric.social_work", trial).system("social_work_people"),
               WithinAbs(2 * 2.1 * std::exp(-1.0 / 0.35) + 2.1 * std::exp(-0.5 / 0.35), 1e-14));
  }
  SECTION("without people it is undefined") {
    trial.sample(1.0, {at(0, 0)}).end(1.0, {never});
    CHECK(std::isnan(measure("dmrp.metric.social_work", trial).system("social_work")));
  }
}

TEST_CASE("pedestrian progress is a telescoping sum over legs and successive people") {
  SyntheticTrial trial(0);
  // 10 m from its target, walks on 1 m a second; at 3 s it has another target, to which it is 4 m; at 5 s it is
  // replaced by a person 6 m from a target who walks away from it at 0.5 m/s
  trial.sample(0.0, {}).crowd({walker(0, {0, 0}, {11, 0})});
  trial.sample(1.0, {}).crowd({walker(0, {1, 0}, {11, 0})});
  trial.sample(2.0, {}).crowd({walker(0, {2, 0}, {11, 0})});
  trial.sample(3.0, {}).crowd({walker(0, {10, 0}, {10, 5})});
  trial.sample(4.0, {}).crowd({walker(0, {10, 1}, {10, 5})});
  trial.sample(5.0, {}).crowd({walker(9, {0, 0}, {7, 0})});
  trial.sample(6.0, {}).crowd({walker(9, {-0.5, 0}, {7, 0})});
  trial.end(6.0);
  const Measurement m = measure("dmrp.metric.pedestrian_progress", trial);
  const std::map<double, double> expected = {{0, 0}, {1, 1}, {2, 2}, {3, 10}, {4, 11}, {5, 14}, {6, 13.5}};
  CHECK(m.curves.at("pedestrian_progress") == expected);
  CHECK(m.system("pedestrian_speed") == 1.0);
  CHECK_THAT(m.system("pedestrian_desired_speed"), WithinAbs(1.2, 1e-15));
}

TEST_CASE("pedestrian progress is a mean over the people present at once, also when some leave the world") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).crowd({walker(0, {0, 0}, {5, 0}), walker(1, {0, 9}, {5, 9}), walker(2, {0, 3}, {5, 3})});
  trial.sample(0.6, {}).crowd({walker(0, {1, 0}, {5, 0}), walker(1, {0, 9}, {5, 9}), walker(2, {1, 3}, {5, 3})});
  trial.sample(1.2, {}).crowd({walker(0, {2, 0}, {5, 0}, 0.5), walker(2, {2, 3}, {5, 3}, 0.5)});  // 1 is gone: 4 m
  trial.sample(2.0, {}).crowd({walker(2, {3, 3}, {5, 3})});                                       // so is 0
  trial.sample(3.0, {});
  trial.end(3.0);
  const Measurement m = measure("dmrp.metric.pedestrian_progress", trial);
  const std::map<double, double> curve = m.curves.at("pedestrian_progress");
  REQUIRE(curve.size() == 4);
  CHECK(curve.at(0.0) == 0.0);
  CHECK_THAT(curve.at(1.0), WithinAbs((2 + 4 + 2) / 3.0, 1e-15));  // by the step that 1 s falls into
  CHECK_THAT(curve.at(2.0), WithinAbs((4 + 4 + 3) / 3.0, 1e-15));
  CHECK_THAT(curve.at(3.0), WithinAbs((4 + 4 + 4) / 3.0, 1e-15));
  // 3 people for 0.6 s, 2 at 0.5 m/s for 0.6 s, 1 for 0.8 s
  CHECK_THAT(m.system("pedestrian_speed"), WithinAbs((1.8 + 0.6 + 0.8) / (1.8 + 1.2 + 0.8), 1e-12));
}

TEST_CASE("pedestrian progress identifies people by id, not by index") {
  SyntheticTrial trial(0);
  trial.sample(0.0, {}).crowd({walker(0, {0, 0}, {9, 0}), walker(1, {0, 0}, {5, 0})});
  trial.sample(1.0, {}).crowd({walker(1, {1, 0}, {5, 0}), walker(0, {2, 0}, {9, 0})});
  trial.end(1.0);
  CHECK(measure("dmrp.metric.pedestrian_progress", trial).curves.at("pedestrian_progress").at(1.0) == 1.5);
}

TEST_CASE("pedestrian progress without people is one undefined point") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(0, 0)}).end(1.0);
  const Measurement m = measure("dmrp.metric.pedestrian_progress", trial);
  REQUIRE(m.curves.at("pedestrian_progress").size() == 1);
  CHECK(std::isnan(m.curves.at("pedestrian_progress").at(0.0)));
  CHECK(std::isnan(m.system("pedestrian_speed")));
}

}  // namespace social_test
