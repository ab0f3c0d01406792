// SPDX-License-Identifier: MIT
// Encounters of robots with people and with each other: meetings laid out by hand.
#include <catch2/catch.hpp>
#include <functional>
#include <map>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace encounters_test {

using namespace dmrp::test;

constexpr double pi = 3.14159265358979323846;

// Where a body is and how it moves, by time. Robots face where they move.
struct Track {
  double x, y, v_x, v_y;
};
using Way = std::function<Track(double)>;

Way straight(double x, double y, double v_x, double v_y) {
  return [=](double t) { return Track{x + v_x * t, y + v_y * t, v_x, v_y}; };
}
Way standing(double x, double y) {
  return straight(x, y, 0.0, 0.0);
}

// One minute at ten control ticks a second, so that values are counts.
Measurement minute_of(const std::vector<Way>& robots, const std::vector<Way>& people, bool controlled = true) {
  SyntheticTrial trial(robots.size());
  trial.plan(std::vector<Points>(robots.size(), {{0, 0}}));
  for (int tick = 0; tick <= 600; ++tick) {
    std::vector<dmrp_robot_sample> now;
    for (const Way& way : robots) {
      const auto [x, y, v_x, v_y] = way(0.1 * tick);
      now.push_back(facing(x, y, std::atan2(v_y, v_x)));
      now.back().velocity.v_x = std::hypot(v_x, v_y);
    }
    std::vector<dmrp_person> crowd;
    for (const Way& way : people) {
      const auto [x, y, v_x, v_y] = way(0.1 * tick);
      crowd.push_back({});
      crowd.back().id = 70 + crowd.size();
      crowd.back().radius_m = 0.25;
      crowd.back().position = {x, y};
      crowd.back().velocity = {v_x, v_y};
    }
    trial.sample(0.1 * tick, now).crowd(crowd);
    if (!controlled) trial.without_control();
  }
  trial.end(60.0, std::vector<double>(robots.size(), never));
  return measure("dmrp.metric.encounters", trial);
}

// The kinds with which the system, or a robot, met anybody.
std::map<std::string, double> met(const Measurement& m, int robot = -1) {
  std::map<std::string, double> counts;
  for (const std::string kind : {"head_on", "overtaking", "crossing"})
    for (const std::string with : {"person", "robot"}) {
      const std::string name = "encounters_" + kind + "_" + with;
      const double value = robot < 0 ? m.system(name) : m.robot(name, static_cast<std::uint64_t>(robot));
      if (value != 0.0 && !std::isnan(value)) counts[kind + " " + with] = value;
    }
  return counts;
}
using Counts = std::map<std::string, double>;

TEST_CASE("an encounter has its kind by the directions of motion when it begins") {
  const Way robot = straight(0, 0, 0.5, 0);
  CHECK(met(minute_of({robot}, {straight(10, 0.3, -1, 0)})) == Counts{{"head_on person", 1}});
  CHECK(met(minute_of({robot}, {straight(-5, 0.3, 1, 0)})) == Counts{{"overtaking person", 1}});
  CHECK(met(minute_of({robot}, {straight(3, 0.3, 0.2, 0)})) == Counts{{"overtaking person", 1}});
  CHECK(met(minute_of({robot}, {straight(5, -10, 0, 1)})) == Counts{{"crossing person", 1}});
  // both sides of 45 and of 135 degrees; they are at (5, 0) after 10 s
  for (const double degrees : {0.0, 44.0, 46.0, 134.0, 136.0}) {
    const double v_x = 1.5 * std::cos(degrees * pi / 180), v_y = 1.5 * std::sin(degrees * pi / 180);
    const char* kind = degrees < 45 ? "overtaking person" : degrees < 135 ? "crossing person" : "head_on person";
    CHECK(met(minute_of({robot}, {straight(5 - 10 * v_x, -10 * v_y, v_x, v_y)})) == Counts{{kind, 1}});
  }
}

TEST_CASE("who passes at a distance, stands, moves away or is beside the robot already makes no encounter") {
  const Way robot = straight(0, 0, 0.5, 0);
  CHECK(met(minute_of({robot}, {straight(10, 0.99, -1, 0)})) == Counts{{"head_on person", 1}});  // 0.49 m between them
  CHECK(met(minute_of({robot}, {straight(10, 1.01, -1, 0)})).empty());
  CHECK(met(minute_of({robot}, {standing(10, 0)})).empty());
  CHECK(met(minute_of({standing(0, 0)}, {straight(10, 0, -1, 0)})).empty());
  CHECK(met(minute_of({robot}, {straight(-5, 0, -1, 0), straight(5, 0, 1, 0)})).empty());
  CHECK(met(minute_of({robot}, {straight(0, 0.9, 0.5, 0)})).empty());
  CHECK(met(minute_of({robot}, {straight(0, 0.9, 0.5, -0.001)})).empty());
  // a person turns back 5 m before the robot, which would reach it in 2 s; then 14 m, more than 5 s
  const auto turns_at = [](double left_m) -> Way {
    const double turn_s = (20 - left_m) / 2.0;
    return [=](double t) {
      return t < turn_s ? Track{20 - 1.5 * t, 0, -1.5, 0} : Track{20 - 1.5 * turn_s + 1.5 * (t - turn_s), 0, 1.5, 0};
    };
  };
  CHECK(met(minute_of({robot}, {turns_at(5.0)})) == Counts{{"head_on person", 1}});
  CHECK(met(minute_of({robot}, {turns_at(14.0)})).empty());
}

TEST_CASE("a meeting counts once, however its course wavers and however long it lasts, and again after it is over") {
  const Way robot = straight(0, 0, 0.5, 0);
  // off the course and back on it, every half second
  const Way wavers = [](double t) {
    const bool aside = static_cast<int>(2 * t + 0.05) % 2 == 1;
    return Track{20 - t, 0, -1, aside ? 1.0 : 0.0};
  };
  CHECK(met(minute_of({robot}, {wavers})) == Counts{{"head_on person", 1}});
  // they stop 1.5 m apart for 30 s, and go on
  const Way waits = [](double t) {
    const double moved = t < 5 ? t : t < 35 ? 5 : t - 30;
    const double v_x = t < 5 || t >= 35 ? 1.0 : 0.0;
    return Track{moved, 0, v_x, 0};
  };
  const Way opposite = [=](double t) { return Track{12 - waits(t).x, 0.4, -waits(t).v_x, 0}; };
  CHECK(met(minute_of({waits}, {opposite})) == Counts{{"head_on person", 1}});
  // to and fro along the robot's place, past it every 20 s
  const Way paces = [](double t) {
    const double phase = std::fmod(t, 40.0);
    return phase < 20 ? Track{10 - phase, 0.6, -1, 0} : Track{-10 + phase - 20, 0.6, 1, 0};
  };
  CHECK(met(minute_of({straight(-3, 0, 0.1, 0)}, {paces})) == Counts{{"head_on person", 2}, {"overtaking person", 1}});
}

TEST_CASE("robots that meet each have an encounter, a minute of both has two") {
  const Measurement m =
      minute_of({straight(0, 0, 0.5, 0), straight(20, 0, -0.5, 0), straight(0, 50, 0.5, 0)}, {straight(10, 55, -1, 0)});
  CHECK(met(m, 0) == Counts{{"head_on robot", 1}});
  CHECK(met(m, 1) == Counts{{"head_on robot", 1}});
  CHECK(met(m, 2).empty());
  CHECK(met(m) == Counts{{"head_on robot", 2.0 / 3}});
}

TEST_CASE("encounters are by active time, and undefined where nobody could be met") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  for (int tick = 0; tick <= 1200; ++tick) {
    const double t = 0.1 * tick;
    const bool arrived = t > 29.95;
    // the second robot arrives after 30 s; what stands is no encounter, nor what is carried away
    trial.sample(
        t, {at(0.1 * t, 0, 0.1), at(10 - 0.1 * t, 20, arrived ? 0.3 : 0.1, arrived ? parked : DMRP_ROBOT_ACTIVE)});
    dmrp_person person{};
    person.radius_m = 0.25;
    person.position = {20 - t, 0.0};
    person.velocity = {-1.0, 0.0};
    trial.crowd({person});
  }
  trial.end(120.0, {never, 30.0});
  const Measurement m = measure("dmrp.metric.encounters", trial);
  CHECK(m.robot("encounters_head_on_person", 0) == 0.5);
  CHECK(m.robot("encounters_head_on_person", 1) == 0.0);
  CHECK(m.system("encounters_head_on_person") == 1.0 / 2.5);  // one in 2 + 0.5 minutes

  CHECK(std::isnan(minute_of({straight(0, 0, 1, 0)}, {}).system("encounters_crossing_person")));
  CHECK(std::isnan(minute_of({straight(0, 0, 1, 0)}, {}).system("encounters_crossing_robot")));
  // between control ticks nobody looks
  CHECK(met(minute_of({straight(0, 0, 1, 0)}, {straight(10, 0, -1, 0)}, false)).empty());
}

}  // namespace encounters_test
