// SPDX-License-Identifier: MIT
// Schedule error, overlap in seconds and conflicts at the root, against values worked out by hand.
#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace schedule_test {

using namespace dmrp::test;

dmrp_robot_sample at_arc(double x, double progress_m) {
  dmrp_robot_sample robot = at(x, 0.0);
  robot.progress_m = progress_m;
  return robot;
}

TEST_CASE("schedule error: a waypoint is passed when the progress reaches it; waits count once") {
  SyntheticTrial trial(2);
  // due at 1 m after 1 s, at 2 m after 4 s (a wait of two seconds at 1 m), at 3 m after 5 s
  trial.plan({{{0, 0}, {1, 0}, {1, 0}, {1, 0}, {2, 0}, {3, 0}}, {{9, 9}}});
  trial.sample(0.0, {at_arc(0, 0), at(9, 9)});
  trial.sample(1.5, {at_arc(0.9, 0.9), at(9, 9)});
  trial.sample(2.0, {at_arc(1.1, 1.1), at(9, 9)});  // 1 s late
  trial.sample(3.5, {at_arc(2.0, 2.0), at(9, 9)});  // 0.5 s early
  trial.sample(6.0, {at_arc(2.9, 2.9), at(9, 9)});  // the last one is never passed
  trial.end(6.0);
  const Measurement m = measure("dmrp.metric.schedule_error", trial);
  CHECK(m.robot("schedule_error_s", 0) == Approx(0.25));
  CHECK(m.robot("schedule_deviation_s", 0) == Approx(0.75));
  CHECK(std::isnan(m.robot("schedule_error_s", 1)));  // it has nowhere to go
  CHECK(m.system("schedule_error_s") == Approx(0.25));
  CHECK(m.system("schedule_deviation_s") == Approx(0.75));
}

TEST_CASE("schedule error: a new plan has a schedule of its own") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {1, 0}, {2, 0}}});
  trial.sample(0.0, {at_arc(0, 0)});
  trial.sample(1.5, {at_arc(1, 1)});  // 0.5 s late
  trial.timed_plan({{waypoint(1, 0, 2.0), waypoint(3, 0, 4.0), waypoint(4, 0, 5.0)}});
  trial.sample(2.0, {at_arc(1, 0)});
  trial.sample(7.0, {at_arc(4, 3)});  // 3 s late at one, 2 s at the other
  trial.end(7.0);
  const Measurement m = measure("dmrp.metric.schedule_error", trial);
  CHECK(m.system("schedule_error_s") == Approx(5.5 / 3.0));
  SyntheticTrial without(1);
  without.sample(0.0, {at(0, 0)}).end(0.0, {never});
  CHECK(std::isnan(measure("dmrp.metric.schedule_error", without).system("schedule_error_s")));
}

TEST_CASE("overlap in seconds: two robots that cross") {
  // one through the other's way at right angles, both at the origin after 2 s, 1 m/s
  SyntheticTrial trial(2);
  trial.plan({{{-2, 0}, {-1, 0}, {0, 0}, {1, 0}, {2, 0}}, {{0, -2}, {0, -1}, {0, 0}, {0, 1}, {0, 2}}}).end(0.0);
  // positions every 0.2 s, 21 of each; robots of radius 0.25 m; at the same time they are sqrt(2) |t - 2| apart: within 0.5 m for |t - 2| <= 0.35
  const Measurement at_once = measure("dmrp.metric.sto_physical", trial, {{"window_s", 0.0}});
  CHECK(at_once.system("sto_physical") == Approx(3.0 / 21.0));
  // with a second to either side, the other one is at the origin for 1 <= t <= 3, half a metre off it at most half a
  // second longer: within 0.5 m for |t - 2| <= 0.5
  const Measurement in_window = measure("dmrp.metric.sto_physical", trial, {{"window_s", 1.0}});
  CHECK(in_window.system("sto_physical") == Approx(5.0 / 21.0));
}

TEST_CASE("overlap in seconds: the same motion in larger steps has the same value") {
  const auto value = [](double step_s) {
    SyntheticTrial trial(2);
    std::vector<dmrp_waypoint> east, north;
    for (double t_s = 0.0; t_s <= 8.0; t_s += step_s) {
      east.push_back(waypoint(t_s, 4, t_s));
      north.push_back(waypoint(4, t_s + 1.0, t_s));
    }
    trial.timed_plan({east, north}).end(0.0);
    return measure("dmrp.metric.sto_physical", trial, {{"window_s", 1.0}}).system("sto_physical");
  };
  CHECK(value(1.0) == value(2.0));
  CHECK(value(1.0) == value(4.0));
  CHECK(value(1.0) > 0.0);
}

TEST_CASE("overlap in seconds: robots rest at their goals, and without a plan there is no value") {
  SyntheticTrial trial(2);
  // the second one reaches the first one's goal 3 s after it and stays 0.4 m off
  trial.plan({{{0, 0}, {1, 0}}, {{1.4, 4}, {1.4, 3}, {1.4, 2}, {1.4, 1}, {1.4, 0}}}).end(0.0);
  const Measurement m = measure("dmrp.metric.sto_physical", trial, {{"window_s", 0.0}});
  CHECK(m.robot("sto_physical", 0) == Approx(0.0));
  // from y = 0.3 on: of 21 positions, y = 0.2 and y = 0
  CHECK(m.robot("sto_physical", 1) == Approx(2.0 / 21.0));
  SyntheticTrial without(1);
  without.sample(0.0, {at(0, 0)}).end(0.0, {never});
  CHECK(std::isnan(measure("dmrp.metric.sto_physical", without).system("sto_physical")));
}

TEST_CASE("conflicts at the root: by waiting, by a detour, or left") {
  const auto counts = [](const std::vector<Points>& paths) {
    SyntheticTrial trial(paths.size());
    trial.planning_grid(7, 7).plan(paths).end(0.0);
    const Measurement m = measure("dmrp.metric.root_conflicts", trial);
    return std::vector<double>{m.system("root_conflicts"), m.system("root_conflicts_waited"),
                               m.system("root_conflicts_detoured"), m.system("root_conflicts_left")};
  };
  // both on their straight ways are on (2.5, 2.5) after two steps
  const Points east = {{0.5, 2.5}, {1.5, 2.5}, {2.5, 2.5}, {3.5, 2.5}, {4.5, 2.5}};
  const Points north = {{2.5, 0.5}, {2.5, 1.5}, {2.5, 2.5}, {2.5, 3.5}, {2.5, 4.5}};
  CHECK(counts({east, north}) == std::vector{1.0, 0.0, 0.0, 1.0});
  const Points north_later = {{2.5, 0.5}, {2.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {2.5, 3.5}, {2.5, 4.5}};
  CHECK(counts({east, north_later}) == std::vector{1.0, 1.0, 0.0, 0.0});
  const Points north_beside = {{2.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {1.5, 2.5}, {1.5, 3.5}, {1.5, 4.5}, {2.5, 4.5}};
  CHECK(counts({east, north_beside}) == std::vector{1.0, 0.0, 1.0, 0.0});

  // head-on: they exchange (2.5, 2.5) and (3.5, 2.5)
  const Points eastward = {{0.5, 2.5}, {1.5, 2.5}, {2.5, 2.5}, {3.5, 2.5}, {4.5, 2.5}, {5.5, 2.5}};
  const Points westward = {{5.5, 2.5}, {4.5, 2.5}, {3.5, 2.5}, {2.5, 2.5}, {1.5, 2.5}, {0.5, 2.5}};
  CHECK(counts({eastward, westward}) == std::vector{1.0, 0.0, 0.0, 1.0});
  const Points aside = {{5.5, 2.5}, {5.5, 3.5}, {4.5, 3.5}, {3.5, 3.5}, {2.5, 3.5}, {1.5, 3.5}, {0.5, 3.5}, {0.5, 2.5}};
  CHECK(counts({eastward, aside}) == std::vector{1.0, 0.0, 1.0, 0.0});

  // a robot that follows, and one that waits at its goal out of the way, are no conflicts
  CHECK(counts({east, {{0.5, 1.5}, {0.5, 2.5}, {1.5, 2.5}, {2.5, 2.5}}}) == std::vector{0.0, 0.0, 0.0, 0.0});
}

TEST_CASE("conflicts at the root need a plan from cell to cell") {
  SyntheticTrial leaps(1);
  leaps.planning_grid(7, 7).plan({{{0.5, 0.5}, {4.5, 2.5}}}).end(0.0);
  CHECK(std::isnan(measure("dmrp.metric.root_conflicts", leaps).system("root_conflicts")));
  SyntheticTrial tour(1);
  tour.route(0, {0.5, 0.5, 0}, {{1.5, 0.5, 0}, {2.5, 0.5, 0}});
  tour.planning_grid(7, 7).plan({{{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}}}).end(0.0);
  CHECK(std::isnan(measure("dmrp.metric.root_conflicts", tour).system("root_conflicts")));
}

}  // namespace schedule_test
