// SPDX-License-Identifier: MIT
// STO, IBTR, LDF, PFD: cases computed by hand.
#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace paper_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

// A trial of one second a step with these speeds, standing at these places all the time (measured speed and position
// are separate things to a metric).
SyntheticTrial crawling(const std::vector<dmrp_vec2>& places, const std::vector<std::vector<double>>& speeds) {
  SyntheticTrial trial(places.size());
  std::vector<Points> paths;
  for (const dmrp_vec2& place : places) paths.push_back({place});
  trial.plan(paths);
  for (std::size_t t = 0; t <= speeds[0].size(); ++t) {
    std::vector<dmrp_robot_sample> robots;
    for (std::size_t robot = 0; robot < places.size(); ++robot)
      robots.push_back(at(places[robot].x, places[robot].y, t == 0 ? 0.0 : speeds[robot][t - 1]));
    trial.sample(static_cast<double>(t), robots);
  }
  trial.end(static_cast<double>(speeds[0].size()), std::vector<double>(places.size(), never));
  return trial;
}

// ---- STO

TEST_CASE("STO counts waypoints that another robot passes at about the same step") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}},       // passes (2, 0) at step 2
              {{2, -3}, {2, -2}, {2, -1}, {2, 0}, {2, 1}}});  // at step 3
  trial.end(0.0);
  SECTION("one step apart is inside the window of 2: one waypoint of 5 each") {
    const Measurement m = measure("dmrp.metric.sto", trial);
    CHECK(m.robot("sto", 0) == 0.2);
    CHECK(m.robot("sto", 1) == 0.2);
    CHECK(m.system("sto") == 0.2);
  }
  SECTION("outside a window of 0") {
    CHECK(measure("dmrp.metric.sto", trial, {{"window", 0}}).system("sto") == 0.0);
  }
  SECTION("within a distance includes it: (2,0) and (2,-1) at step 2, (3,0) and (2,0) at step 3") {
    const Measurement m = measure("dmrp.metric.sto", trial, {{"window", 0}, {"distance_m", 1.0}});
    CHECK(m.system("sto") == 0.4);  // 2 of 5 each
  }
}

TEST_CASE("STO lets robots rest at their goals, in plans of unequal length") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}},                              // rests at (1, 0) from step 1 on
              {{1, 4}, {1, 3}, {1, 2}, {1, 1}, {1, 0.5}}});  // comes within 0.5 m at step 4, its last
  trial.end(0.0);
  SECTION("window 2: robot 0 looks up to step 1 + 2, before the other is near") {
    const Measurement m = measure("dmrp.metric.sto", trial);
    CHECK(m.robot("sto", 0) == 0.0);  // of its own 2 waypoints
    CHECK(m.robot("sto", 1) == 0.2);  // step 4 of 5 waypoints
    CHECK(m.system("sto") == 0.1);
  }
  SECTION("window 3: from step 1 it sees step 4") {
    const Measurement m = measure("dmrp.metric.sto", trial, {{"window", 3}});
    CHECK(m.robot("sto", 0) == 0.5);
    CHECK(m.system("sto") == 0.35);  // (0.5 + 0.2) / 2
  }
}

TEST_CASE("STO keeps waits, in numerator and denominator") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}, {1, 0}, {1, 0}, {2, 0}},             // waits at (1, 0), steps 1 to 3
              {{1, 4}, {1, 3}, {1, 2}, {1, 1}, {1, 0}, {1, -1}}});  // passes it at step 4
  trial.end(0.0);
  const Measurement m = measure("dmrp.metric.sto", trial);
  // robot 0: step 2 sees step 4, step 3 too; step 1 sees up to 3; step 4 is at (2, 0)
  CHECK(m.robot("sto", 0) == 0.4);
  // robot 1: step 4 sees steps 2 and 3 of the other
  CHECK_THAT(m.robot("sto", 1), WithinAbs(1.0 / 6.0, 1e-15));
  CHECK_THAT(m.system("sto"), WithinAbs((0.4 + 1.0 / 6.0) / 2.0, 1e-15));
}

TEST_CASE("STO ignores padding after the robot's arrival") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}}, {{1, 4}, {1, 3}, {1, 2}, {1, 1}, {1, 0.5}, {1, 0.5}}});
  trial.end(0.0);
  // as in the case of unequal lengths
  CHECK(measure("dmrp.metric.sto", trial).system("sto") == 0.1);
  CHECK(measure("dmrp.metric.sto", trial, {{"window", 3}}).system("sto") == 0.35);
}

TEST_CASE("STO counts the way of a robot that leaves its goal and returns") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}, {0, 0}, {1, 0}}, {{0, 9}, {0, 8}, {0, 0.5}}});
  trial.end(0.0);
  // window 0: (0, 0) at step 2 is 0.5 m from the other; its own way has 4 waypoints, not 2
  CHECK(measure("dmrp.metric.sto", trial, {{"window", 0}}).robot("sto", 0) == 0.25);
}

TEST_CASE("STO resamples at the step duration") {
  SyntheticTrial trial(2);
  // robot 0 along x at 0.4 m a step: 0, 0.4, 0.8, then its goal (1, 0) at step 3, reached at 2.5 s. Robot 1 gives its
  // turning points only: 0 to 3 s down to (0.8, 1), then at (0.8, 0) after 4 s.
  trial.timed_plan(
      {{waypoint(0, 0, 0), waypoint(1, 0, 2.5)}, {waypoint(0.8, 4, 0), waypoint(0.8, 1, 3), waypoint(0.8, 0, 4)}});
  trial.end(0.0);
  const Measurement m = measure("dmrp.metric.sto", trial, {{"distance_m", 0.3}});
  // robot 0: step 2 (0.8, 0) and step 3 (1, 0) see step 4 of the other: 2 of 4 waypoints
  CHECK(m.robot("sto", 0) == 0.5);
  // robot 1: of 5 waypoints only step 4 is near: at (0.8, 0) it sees step 2 and the rest at (1, 0)
  CHECK(m.robot("sto", 1) == 0.2);
}

TEST_CASE("STO of one robot is 0") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {1, 0}}}).end(0.0);
  CHECK(measure("dmrp.metric.sto", trial).system("sto") == 0.0);
}

// ---- IBTR

TEST_CASE("IBTR is the share of the mission in which a pair crawls") {
  // both within 2 m (the distance itself included); mean speed 0.8, threshold 0.16
  const auto trial = crawling({{0, 0}, {2, 0}}, {{1, 1, 1, 0, 0, 1, 1, 1, 1, 1},    // crawls in (3, 5]
                                                 {1, 1, 1, 1, 0, 0, 1, 1, 1, 1}});  // in (4, 6]
  const Measurement m = measure("dmrp.metric.ibtr", trial);
  CHECK(m.system("ibtr") == 10.0);  // both in (4, 5]: 1 s of 10; an event of one sample is one step long
  CHECK(m.system("ibtr_pair_sum") == 10.0);
  CHECK(m.robot("ibtr", 0) == 10.0);
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].name == "ibtr");
  CHECK(m.events[0].from_s == 4.0);
  CHECK(m.events[0].to_s == 5.0);
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("IBTR closes an event that is open at the end") {
  const auto trial = crawling({{0, 0}, {1, 0}}, {{1, 1, 1, 1, 1, 1, 1, 1, 0, 0}, {1, 1, 1, 1, 1, 1, 1, 0, 0, 0}});
  const Measurement m = measure("dmrp.metric.ibtr", trial);
  CHECK(m.system("ibtr") == 20.0);  // (8, 10]
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].from_s == 8.0);
  CHECK(m.events[0].to_s == 10.0);
}

TEST_CASE("IBTR is the union of overlapping pairs, its second value their sum") {
  // robots 0 and 2 are 4 m apart, 1 between them; each drives 1 m/s but where it stands: 0 in (2, 5], 1 in (2, 6],
  // 2 in (4, 6]. Pair 0-1 blocks in (2, 5], pair 1-2 in (4, 6].
  const auto stops = [](std::size_t from, std::size_t to) {
    std::vector<double> speeds(20, 1.0);
    for (std::size_t i = from; i < to; ++i) speeds[i] = 0.0;
    return speeds;
  };
  const auto trial = crawling({{0, 0}, {2, 0}, {4, 0}}, {stops(2, 5), stops(2, 6), stops(4, 6)});
  const Measurement m = measure("dmrp.metric.ibtr", trial);
  CHECK(m.system("ibtr") == 20.0);           // (2, 6]: 4 s of 20
  CHECK(m.system("ibtr_pair_sum") == 25.0);  // 3 s + 2 s
  CHECK(m.robot("ibtr", 0) == 15.0);         // 3 s
  CHECK(m.robot("ibtr", 1) == 20.0);         // 4 s
  CHECK(m.robot("ibtr", 2) == 10.0);         // 2 s
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{0, 1});
  CHECK(m.events[1].robots == std::vector<std::uint32_t>{1, 2});
}

TEST_CASE("IBTR separates two events of one pair") {
  const auto trial = crawling({{0, 0}, {1, 0}}, {{1, 0, 1, 1, 0, 0, 1, 1, 1, 1}, {1, 0, 1, 1, 0, 0, 1, 1, 1, 1}});
  const Measurement m = measure("dmrp.metric.ibtr", trial);
  CHECK(m.system("ibtr") == 30.0);  // (1, 2] and (4, 6]
  CHECK(m.events.size() == 2);
}

TEST_CASE("IBTR compares each robot with its own mean speed") {
  // robot 0: mean (9 * 1 + 0.1) / 10 = 0.91, so 0.1 is below 0.182; robot 1 always does 0.1, its mean: no crawl
  const auto trial = crawling({{0, 0}, {1, 0}}, {{1, 1, 1, 1, 1, 1, 1, 1, 1, 0.1}, std::vector<double>(10, 0.1)});
  CHECK(measure("dmrp.metric.ibtr", trial).system("ibtr") == 0.0);
}

TEST_CASE("IBTR finds no congestion beside a robot that never moves, because its threshold is 0") {
  const std::vector<double> stops = {1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
  const std::vector<double> never_moves(10, 0.0);
  CHECK(measure("dmrp.metric.ibtr", crawling({{0, 0}, {1, 0}}, {stops, never_moves})).system("ibtr") == 0.0);
  CHECK(measure("dmrp.metric.ibtr", crawling({{0, 0}, {1, 0}}, {never_moves, stops})).system("ibtr") == 0.0);
}

TEST_CASE("IBTR does not count parked neighbours as congestion") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{1, 0}}});
  trial.sample(0.0, {at(0, 0), at(1, 0)});
  trial.sample(1.0, {at(0, 0, 1.0), at(1, 0, 1.0)});
  trial.sample(2.0, {at(0, 0, 0.0), at(1, 0, 1.0, parked)});  // robot 1 arrives
  trial.sample(3.0, {at(0, 0, 0.0), at(1, 0, 0.0, parked)});  // robot 0 stands beside the parked one
  trial.sample(4.0, {at(0, 0, 0.0), at(1, 0, 0.0, parked)});
  trial.end(4.0, {never, 2.0});
  const Measurement m = measure("dmrp.metric.ibtr", trial);
  CHECK(m.system("ibtr") == 0.0);
  CHECK(m.events.empty());
}

TEST_CASE("IBTR uses the mean speed over active time only") {
  // Robot 0 drives (1 + 0.05) / 2 = 0.525 m/s on average until it arrives at 2 s: threshold 0.105. Over all 20 s its
  // mean would be 0.0525, its threshold 0.0105, and its 0.05 m/s no crawl. The step of its arrival still counts.
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{1, 0}}});
  trial.sample(0.0, {at(0, 0), at(1, 0)});
  trial.sample(1.0, {at(0, 0, 1.0), at(1, 0, 1.0)});
  trial.sample(2.0, {at(0, 0, 0.05, parked), at(1, 0, 0.0)});
  trial.sample(20.0, {at(0, 0, 0.0, parked), at(1, 0, 1.0)});
  trial.end(20.0, {2.0, never});
  CHECK(measure("dmrp.metric.ibtr", trial).system("ibtr") == 5.0);  // (1, 2] of 20 s
}

TEST_CASE("IBTR with the constants of the released code") {
  // 2.4 m apart. Robot 0: mean (8 * 1 + 2 * 0.3) / 10 = 0.86; robot 1 the same. 0.3 is below half of it, not a fifth
  const std::vector<double> speeds = {1, 1, 1, 0.3, 0.3, 1, 1, 1, 1, 1};
  const auto trial = crawling({{0, 0}, {2.4, 0}}, {speeds, speeds});
  const ParamOverrides released = {{"distance_m", 2.5}, {"speed_fraction", 0.5}};
  CHECK(measure("dmrp.metric.ibtr", trial, released).system("ibtr") == 20.0);
  CHECK(measure("dmrp.metric.ibtr", trial).system("ibtr") == 0.0);
  CHECK(measure("dmrp.metric.ibtr", trial, {{"distance_m", 2.5}}).system("ibtr") == 0.0);
  CHECK(measure("dmrp.metric.ibtr", trial, {{"speed_fraction", 0.5}}).system("ibtr") == 0.0);
}

TEST_CASE("IBTR of one robot is 0") {
  CHECK(measure("dmrp.metric.ibtr", crawling({{0, 0}}, {{1, 0, 1, 0}})).system("ibtr") == 0.0);
}

TEST_CASE("IBTR weighs steps by their length") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{1, 0}}});
  trial.sample(0.0, {at(0, 0), at(1, 0)});
  trial.sample(7.5, {at(0, 0, 1.0), at(1, 0, 1.0)});
  trial.sample(8.0, {at(0, 0, 0.0), at(1, 0, 0.0)});  // 0.5 s of 8
  trial.end(8.0, {never, never});
  CHECK(measure("dmrp.metric.ibtr", trial).system("ibtr") == 6.25);
}

// ---- LDF

TEST_CASE("LDF is the largest variance of the number of neighbours, counted each second") {
  // robot 1 sits 1.5 m east of robot 0, robot 2 1.5 m west (3 m apart), each 50 m away at other times
  const auto east = [](bool near) { return near ? 1.5 : 50.0; };
  const auto west = [](bool near) { return near ? -1.5 : -50.0; };
  SyntheticTrial trial(3);
  trial.plan({{{0, 0}}, {{50, 0}}, {{-50, 0}}});
  const bool near_1[] = {false, true, true, true, true};
  const bool near_2[] = {false, false, true, false, false};
  for (int t = 0; t <= 4; ++t) {
    const std::uint32_t state = t >= 3 ? parked : DMRP_ROBOT_ACTIVE;    // robot 1 is parked from 3 s on
    if (t > 0) trial.sample(t - 0.5, {at(0, 0), at(1, 0), at(-1, 0)});  // between two counts: seen by none
    trial.sample(t, {at(0, 0), at(east(near_1[t]), 0, 0.0, state), at(west(near_2[t]), 0)});
  }
  trial.end(4.0, {never, 3.0, never});

  const Measurement m = measure("dmrp.metric.ldf", trial);
  // robot 0: 0 1 2 1 1, mean 1, variance (1 + 0 + 1 + 0 + 0) / 5; parked robot 1 counts at 3 and 4 s
  CHECK(m.robot("ldf", 0) == 0.4);
  CHECK(m.robot("ldf", 1) == 0.16);  // 0 1 1 1 1: 4/5 - 16/25
  CHECK(m.robot("ldf", 2) == 0.16);  // 0 0 1 0 0: 1/5 - 1/25
  CHECK(m.system("ldf") == 0.4);
  // active robots only: robot 0 0 1 2 0 0: 5/5 - 9/25; robot 1 until parked 0 1 1: 2/3 - 4/9; robot 2 0 0 1 0 0
  CHECK(m.robot("ldf_active", 0) == 0.64);
  CHECK_THAT(m.robot("ldf_active", 1), WithinAbs(2.0 / 9.0, 1e-15));
  CHECK(m.robot("ldf_active", 2) == 0.16);
  CHECK(m.system("ldf_active") == 0.64);
}

TEST_CASE("LDF's distance is inclusive, and can be that of the released code") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{9, 0}}});
  trial.sample(0.0, {at(0, 0), at(2.0, 0)});  // within 2 m, not within 1
  trial.sample(1.0, {at(0, 0), at(1.0, 0)});  // within both
  trial.end(1.0);
  CHECK(measure("dmrp.metric.ldf", trial).system("ldf") == 0.0);                          // 1 1
  CHECK(measure("dmrp.metric.ldf", trial, {{"distance_m", 1.0}}).system("ldf") == 0.25);  // 0 1
}

TEST_CASE("LDF counts at instants that fall between samples") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{9, 0}}});
  trial.sample(0.0, {at(0, 0), at(9, 0)});
  trial.sample(0.6, {at(0, 0), at(9, 0)});
  trial.sample(1.2, {at(0, 0), at(1, 0)});  // stands for (0.6, 1.2], so for 1 s
  trial.sample(1.8, {at(0, 0), at(9, 0)});
  trial.sample(3.5, {at(0, 0), at(9, 0)});  // for 2 s and for 3 s
  trial.end(3.5, {never, never});
  // 0 1 0 0: 1/4 - 1/16
  CHECK(measure("dmrp.metric.ldf", trial).system("ldf") == 0.1875);
}

TEST_CASE("LDF of one robot and of robots that stay together is 0") {
  SyntheticTrial alone(1);
  alone.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(1, 0)}).end(1.0);
  CHECK(measure("dmrp.metric.ldf", alone).system("ldf") == 0.0);

  SyntheticTrial convoy(2);
  convoy.plan({{{0, 0}}, {{1, 0}}});
  for (int t = 0; t <= 5; ++t) convoy.sample(t, {at(t, 0), at(t + 1, 0)});
  convoy.end(5.0);
  CHECK(measure("dmrp.metric.ldf", convoy).system("ldf") == 0.0);
}

// ---- PFD

TEST_CASE("PFD averages the distance to the path over control steps until arrival") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}, {1, 0}, {2, 0}, {2, 2}},        // a wait: a segment of no length
              {{9, 9}}});                                      // a path of one waypoint
  trial.sample(0.0, {at(0, 7), at(9, 9)});                     // ends no step: not counted
  trial.sample(0.1, {at(1, 0.3), at(9, 9)});                   // 0.3 beside a segment
  trial.sample(0.2, {at(1, 5), at(9, 20)}).without_control();  // no control step: not counted
  trial.sample(0.3, {at(2.4, 1), at(9, 9)});                   // 0.4 beside the last segment
  trial.sample(0.4, {at(-3, -4, 0.0, parked), at(9, 10)});     // 5 from the first point; the step of the arrival
  trial.sample(0.5, {at(90, 90, 0.0, parked), at(9, 9)});      // parked: not counted
  trial.end(0.5, {0.4, never});

  const Measurement m = measure("dmrp.metric.pfd", trial);
  CHECK_THAT(m.robot("pfd", 0), WithinAbs(1.9, 1e-15));  // (0.3 + 0.4 + 5) / 3
  CHECK(m.robot("pfd", 1) == 0.25);                      // (0 + 0 + 1 + 0) / 4
  CHECK_THAT(m.system("pfd"), WithinAbs(1.075, 1e-15));  // (1.9 + 0.25) / 2
  CHECK_THAT(m.system("pfd_initial"), WithinAbs(1.075, 1e-15));
}

TEST_CASE("PFD uses the current plan, its second value the first plan") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {4, 0}}});
  trial.sample(0.0, {at(0, 0)});
  trial.sample(0.1, {at(1, 0.5)});     // 0.5 off
  trial.plan({{{1, 0.5}, {4, 0.5}}});  // replanned from where it is
  trial.sample(0.2, {at(2, 0.5)});     // 0 off the new plan, 0.5 off the first
  trial.sample(0.3, {at(3, 0.6)});     // 0.1 and 0.6
  trial.end(0.3);
  const Measurement m = measure("dmrp.metric.pfd", trial);
  CHECK_THAT(m.system("pfd"), WithinAbs(0.2, 1e-15));                // (0.5 + 0 + 0.1) / 3
  CHECK_THAT(m.system("pfd_initial"), WithinAbs(1.6 / 3.0, 1e-15));  // (0.5 + 0.5 + 0.6) / 3
}

TEST_CASE("PFD along the route is measured from what the controller was handed last") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {4, 0}}, {{0, 9}, {4, 9}}});
  trial.sample(0.0, {at(0, 0), at(0, 9)}).handed(0, {{0, 0}, {4, 0}});
  trial.sample(0.1, {at(1, 0.5), at(0, 9)}).handed(0, {{1, 0.5}, {2, 1}, {4, 1}});  // led around something
  trial.sample(0.2, {at(2, 1), at(0, 9)});
  trial.sample(0.3, {at(3, 1.25), at(0, 9)});
  trial.end(0.3);
  const Measurement m = measure("dmrp.metric.pfd", trial);
  CHECK_THAT(m.robot("pfd_route", 0), WithinAbs(0.25, 1e-15));  // (0.5 + 0 + 0.25) / 3
  CHECK_THAT(m.robot("pfd", 0), WithinAbs((0.5 + 1 + 1.25) / 3, 1e-15));
  CHECK(std::isnan(m.robot("pfd_route", 1)));
}

}  // namespace paper_test
