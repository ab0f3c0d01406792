// SPDX-License-Identifier: MIT
// Clearance, danger time and time to collision: cases computed by hand, and against brute force.
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace safety_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;
using dmrp::toolkit::Stream;

dmrp_person person(double x, double y, double v_x = 0.0, double v_y = 0.0, double radius_m = 0.3) {
  dmrp_person person{};
  person.position = {x, y};
  person.velocity = {v_x, v_y};
  person.radius_m = radius_m;
  return person;
}

dmrp_robot_sample turned(dmrp_robot_sample robot, double theta) {
  robot.pose.theta = theta;
  return robot;
}

TEST_CASE("clearance and proxemics measure from the true outline of a polygonal robot") {
  SyntheticTrial trial(2);
  trial.robot_rectangle(0.6, 0.3);
  trial.box("wall", {1, -5}, {2, 5}).circle("pillar", {0, -2}, 1.0);
  trial.plan({{{0, 0}}, {{0, 0}}});
  // robot 0 faces the end of robot 1 with its side
  const dmrp_robot_sample along_wall = turned(at(0, 0), M_PI / 2);
  trial.sample(0.0, {along_wall, at(-3, 0)}).crowd({person(0, 1.5)});
  trial.sample(1.0, {along_wall, at(-3, 0)}).crowd({person(0, 1.5)});
  trial.end(1.0, {never, never});

  const Measurement m = measure("dmrp.metric.clearance", trial);
  CHECK_THAT(m.robot("clearance_static_min", 0), WithinAbs(0.4, 1e-12));  // the pillar: 1 - 0.6; the wall: 1 - 0.3
  CHECK_THAT(m.robot("clearance_robot_min", 0), WithinAbs(2.1, 1e-12));   // 3 - 0.3 - 0.6
  CHECK_THAT(m.robot("clearance_robot_min", 1), WithinAbs(2.1, 1e-12));
  CHECK_THAT(m.robot("clearance_person_min", 0), WithinAbs(0.6, 1e-12));                         // 1.5 - 0.6 - 0.3
  CHECK_THAT(m.robot("clearance_person_min", 1), WithinAbs(std::hypot(2.4, 1.2) - 0.3, 1e-12));  // from a corner
  const Measurement zones = measure("dmrp.metric.proxemics", trial);
  CHECK(zones.robot("proxemics_personal", 0) == 100.0);
  CHECK(zones.robot("proxemics_social", 1) == 100.0);
}

TEST_CASE("the clearance of polygons that overlap is negative") {
  SyntheticTrial trial(2);
  trial.robot_rectangle(0.6, 0.3);
  trial.plan({{{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(1.1, 0.1)});
  trial.sample(1.0, {at(0, 0), at(1.1, 0.1)});
  trial.end(1.0, {never, never});
  CHECK_THAT(measure("dmrp.metric.clearance", trial).robot("clearance_robot_min", 0), WithinAbs(-0.1, 1e-12));
}

TEST_CASE("clearance is the time average of the surface distance until arrival") {
  SyntheticTrial trial(2);
  trial.box("wall", {2, -1}, {3, 1}).circle("pillar", {0, 4}, 1.0);
  trial.plan({{{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(1.99, 0), at(-9, 0)}).crowd({person(1.9, 0)});  // stands for no time
  trial.sample(1.0, {at(0, 0), at(-4, 0)}).crowd({person(0, -2), person(-4, -1)});
  trial.sample(4.0, {at(0, 2), at(-1, 0, 0.0, parked)});
  trial.sample(9.0, {at(0, -1), at(-0.5, -1, 0.0, parked)}).crowd({person(-0.5, -1.5)});
  trial.end(9.0, {never, 4.0});

  const Measurement m = measure("dmrp.metric.clearance", trial);
  // robot 0: at (0, 0) 2 m to the wall; at (0, 2) 1 m to the pillar; at (0, -1) 2 m to the wall; less 0.25
  CHECK(m.robot("clearance_static_min", 0) == 0.75);
  CHECK_THAT(m.robot("clearance_static_mean", 0), WithinAbs((1 * 1.75 + 3 * 0.75 + 5 * 1.75) / 9, 1e-15));
  // to the other: 4 m, sqrt(5) m, 0.5 m, less 0.5; the parked one counts
  CHECK(m.robot("clearance_robot_min", 0) == 0.0);
  CHECK_THAT(m.robot("clearance_robot_mean", 0),
             WithinAbs((1 * 3.5 + 3 * (std::sqrt(5.0) - 0.5) + 5 * 0.0) / 9, 1e-14));
  // to people, while there are any: 2 m, sqrt(0.5) m, less 0.55
  CHECK_THAT(m.robot("clearance_person_min", 0), WithinAbs(std::sqrt(0.5) - 0.55, 1e-15));
  CHECK_THAT(m.robot("clearance_person_mean", 0), WithinAbs((1 * 1.45 + 5 * (std::sqrt(0.5) - 0.55)) / 6, 1e-14));
  // robot 1 is active in (0, 4]: at (-4, 0), 1 m from somebody, and at (-1, 0)
  CHECK_THAT(m.robot("clearance_person_min", 1), WithinAbs(0.45, 1e-15));
  CHECK_THAT(m.robot("clearance_robot_min", 1), WithinAbs(std::sqrt(5.0) - 0.5, 1e-15));
  CHECK(m.system("clearance_static_min") == 0.75);
  CHECK(m.system("clearance_robot_min") == 0.0);
  CHECK_THAT(m.system("clearance_person_min"), WithinAbs(std::sqrt(0.5) - 0.55, 1e-15));

  // d_safe 0.3: robot 0 in (4, 9], by both; robot 1 never
  CHECK_THAT(m.robot("danger_time", 0), WithinAbs(100.0 * 5 / 9, 1e-13));
  CHECK_THAT(m.robot("danger_time_robot", 0), WithinAbs(100.0 * 5 / 9, 1e-13));
  CHECK_THAT(m.robot("danger_time_person", 0), WithinAbs(100.0 * 5 / 6, 1e-13));
  CHECK(m.robot("danger_time", 1) == 0.0);
  CHECK_THAT(m.system("danger_time"), WithinAbs(50.0 * 5 / 9, 1e-13));
}

TEST_CASE("clearance is negative in contact, deep inside a shape and beyond the border") {
  SyntheticTrial trial(3);
  trial.bounds({-10, -10}, {10, 10}).box("wall", {2, -1}, {5, 1}).circle("pillar", {-5, 0}, 2.0);
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(0, 0), at(0, 0)});
  trial.sample(1.0, {at(2.5, 0), at(-4, 0), at(10.5, 0)});
  trial.end(1.0);
  const Measurement m = measure("dmrp.metric.clearance", trial);
  CHECK(m.robot("clearance_static_min", 0) == -0.75);
  CHECK(m.robot("clearance_static_min", 1) == -1.25);
  CHECK(m.robot("clearance_static_min", 2) == -0.75);
}

TEST_CASE("danger excludes the safe distance itself") {
  SyntheticTrial trial(1);
  trial.box("wall", {1, -1}, {2, 1}).plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  trial.sample(1.0, {at(0.5, 0)}).sample(2.0, {at(0.51, 0)}).end(2.0, {never});
  CHECK(measure("dmrp.metric.clearance", trial, {{"safe_distance_m", 0.25}}).system("danger_time") == 50.0);
}

TEST_CASE("clearance without other bodies counts walls only") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(0, 0)}).end(1.0);
  const Measurement m = measure("dmrp.metric.clearance", trial);
  CHECK(m.system("clearance_static_min") == 999.75);  // to the border
  for (const char* name : {"clearance_robot_min", "clearance_robot_mean", "clearance_person_min",
                           "clearance_person_mean", "danger_time_robot", "danger_time_person"})
    CHECK(std::isnan(m.system(name)));
  CHECK(m.system("danger_time") == 0.0);
}

TEST_CASE("clearance among many shapes equals exhaustive search along random ways") {
  for (int i = 0; i < 40; ++i) {
    Stream stream(1, "metrics.clearance", i);
    SyntheticTrial trial(1);
    trial.bounds({-10, -10}, {10, 10}).plan({{{0, 0}}});
    const std::size_t shapes = stream.below(30);
    for (std::size_t shape = 0; shape < shapes; ++shape) {
      const dmrp_vec2 place = {stream.uniform(-10, 10), stream.uniform(-10, 10)};
      const dmrp_vec2 size = {stream.uniform(0.1, 4.0), stream.uniform(0.1, 4.0)};
      if (stream.chance(0.5))
        trial.box("box", place, place + size);
      else
        trial.circle("circle", place, size.x / 2);
    }
    dmrp_vec2 position = {stream.uniform(-9, 9), stream.uniform(-9, 9)};
    const dmrp_world world = trial.world();
    trial.sample(0.0, {at(position.x, position.y)});
    double least = 1e9, sum = 0.0;
    for (int step = 1; step <= 200; ++step) {
      position += dmrp_vec2{stream.uniform(-0.2, 0.2), stream.uniform(-0.2, 0.2)};
      if (stream.chance(0.02)) position = {stream.uniform(-9, 9), stream.uniform(-9, 9)};
      trial.sample(step, {at(position.x, position.y)});
      double nearest = dmrp::toolkit::depth(dmrp::toolkit::Rectangle{{-10, -10}, {10, 10}}, position);
      for (std::uint32_t s = 0; s < world.shape_count; ++s)
        nearest = std::min(nearest, dmrp::toolkit::signed_distance(world.shapes[s], position));
      least = std::min(least, nearest - 0.25);
      sum += nearest - 0.25;
    }
    trial.end(200.0, {never});
    const Measurement m = measure("dmrp.metric.clearance", trial);
    CHECK(m.system("clearance_static_min") == Approx(least).margin(1e-12));
    CHECK(m.system("clearance_static_mean") == Approx(sum / 200).margin(1e-12));
  }
}

TEST_CASE("time to collision is the time until surfaces meet at constant velocities") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}}).sample(0.0, {at(0, 0), at(9, 0)});
  SECTION("head-on with a person: 5 m less 0.55 m at 2 m/s") {
    trial.sample(1.0, {at(0, 0, 1.0), at(0, 50)}).crowd({person(5, 0, -1.0)});
    trial.end(1.0, {never, never});
    CHECK_THAT(measure("dmrp.metric.time_to_collision", trial).robot("ttc_min", 0), WithinAbs(2.225, 1e-15));
  }
  SECTION("by the robot's heading, not along x: northward past a person in the east, and into one in the north") {
    trial.sample(1.0, {turned(at(0, 0, 1.0), 0.5 * M_PI), at(0, 50)}).crowd({person(5, 0), person(0, 3)});
    trial.end(1.0, {never, never});
    CHECK_THAT(measure("dmrp.metric.time_to_collision", trial).robot("ttc_min", 0), WithinAbs(2.45, 1e-15));
  }
  SECTION("a grazing pass hits, a wider one does not") {
    trial.sample(1.0, {at(0, 0, 1.0), at(0, 50)}).crowd({person(5, 0.54)});
    trial.end(1.0, {never, never});
    const double reach = 0.55;
    CHECK_THAT(measure("dmrp.metric.time_to_collision", trial).robot("ttc_min", 0),
               WithinAbs(5.0 - std::sqrt(reach * reach - 0.54 * 0.54), 1e-12));
    trial.crowd({person(5, 0.56)});
    CHECK(std::isnan(measure("dmrp.metric.time_to_collision", trial).robot("ttc_min", 0)));
  }
  SECTION("who drives behind somebody as fast never meets") {
    trial.sample(1.0, {at(0, 0, 0.5), at(2, 0, 0.5)}).end(1.0, {never, never});
    const Measurement m = measure("dmrp.metric.time_to_collision", trial);
    CHECK(std::isnan(m.system("ttc_min")));
    CHECK(m.system("ttc_low_time") == 0.0);
  }
  SECTION("in contact it is 0, also when parting") {
    trial.sample(1.0, {at(0, 0, -0.5), at(0.4, 0, 0.5)}).end(1.0, {never, never});
    const Measurement m = measure("dmrp.metric.time_to_collision", trial);
    CHECK(m.system("ttc_min") == 0.0);
    CHECK(m.system("ttc_low_time") == 100.0);
  }
  SECTION("both robots of a pair have it, a parked one does not look out") {
    trial.sample(1.0, {at(0, 0, 0.5), at(2.5, 0, 0.0, parked)});    // 2 m at 0.5 m/s
    trial.sample(5.0, {at(1.5, 0, 0.5), at(2.5, 0, 0.0, parked)});  // 0.5 m: 1 s
    trial.end(5.0, {never, 1.0});
    const Measurement m = measure("dmrp.metric.time_to_collision", trial);
    CHECK(m.robot("ttc_min", 0) == 1.0);
    CHECK(m.robot("ttc_min", 1) == 4.0);
    CHECK(m.system("ttc_min") == 1.0);
    CHECK(m.robot("ttc_low_time", 0) == 80.0);  // below 1.5 s in (1, 5]
    CHECK(m.robot("ttc_low_time", 1) == 0.0);
  }
}

TEST_CASE("time to collision of a single robot is undefined") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(0, 0, 1.0)}).end(1.0);
  const Measurement m = measure("dmrp.metric.time_to_collision", trial);
  CHECK(std::isnan(m.system("ttc_min")));
  CHECK(std::isnan(m.system("ttc_low_time")));
}

TEST_CASE("time to collision agrees with simulation in small steps") {
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    Stream stream(1, "metrics.ttc", i);
    const dmrp_person other = person(stream.uniform(-3, 3), stream.uniform(-3, 3), stream.uniform(-1, 1),
                                     stream.uniform(-1, 1), stream.uniform(0.1, 0.5));
    const double speed = stream.uniform(-0.8, 0.8), theta = stream.uniform(-3, 3);
    SyntheticTrial trial(1);
    trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
    trial.sample(1.0, {turned(at(0, 0, speed), theta)}).crowd({other}).end(1.0);
    const double ttc = measure("dmrp.metric.time_to_collision", trial).system("ttc_min");

    double first = std::nan("");
    for (double tau = 0.0; tau < 20.0 && std::isnan(first); tau += 0.001) {
      const double dx = other.position.x + (other.velocity.x - speed * std::cos(theta)) * tau;
      const double dy = other.position.y + (other.velocity.y - speed * std::sin(theta)) * tau;
      if (std::sqrt(dx * dx + dy * dy) < other.radius_m + 0.25) first = tau;
    }
    INFO("case " << i);
    if (std::isnan(first)) {
      // a graze shorter than a step may be overlooked by the steps, nothing else
      if (!std::isnan(ttc) && ttc < 19.9) {
        const double dx = other.position.x + (other.velocity.x - speed * std::cos(theta)) * ttc;
        const double dy = other.position.y + (other.velocity.y - speed * std::sin(theta)) * ttc;
        CHECK(std::sqrt(dx * dx + dy * dy) == Approx(other.radius_m + 0.25).margin(1e-9));
      }
    } else {
      CHECK(ttc == Approx(first).margin(0.0011));
      ++hits;
    }
  }
  CHECK(hits > 20);
}

}  // namespace safety_test
