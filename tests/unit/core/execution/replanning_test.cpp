// SPDX-License-Identifier: MIT
#include "core/execution/replanning.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/execution/progress.hpp"

namespace replanning_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr std::int64_t second_ns = 1'000'000'000;

dmrp_waypoint waypoint(double x, double y) {
  dmrp_waypoint made{};
  made.x = x;
  made.y = y;
  return made;
}

std::vector<dmrp_waypoint> lane(double from, double to) {
  std::vector<dmrp_waypoint> path;
  for (double x = from; x <= to; x += 1.0) path.push_back(waypoint(x, 0));
  return path;
}

// One robot on a lane of 20 m, at 10 Hz; the times at which it is to be planned anew. `place` gives where it is.
template <class Place>
std::vector<double> replans(const ReplanSettings& settings, double until_s, Place&& place) {
  ReplanMonitor monitor(settings, 1);
  std::vector<RobotState> robots(1);
  std::vector<PathProgress> progress(1);
  progress[0].set_path(lane(0, 20), {0.0, 0.0});
  std::vector<double> times;
  for (int tick = 0; tick <= std::lround(10.0 * until_s); ++tick) {
    const double t_s = 0.1 * tick;
    progress[0].update(place(t_s), 0);
    const std::vector<double> gained_m = {progress[0].progress_m()};
    if (monitor.due(tick * second_ns / 10, robots, gained_m, progress)) times.push_back(t_s);
  }
  return times;
}

std::vector<double> approximately(const std::vector<double>& times) {
  std::vector<double> rounded;
  for (const double t : times) rounded.push_back(std::round(10.0 * t) / 10.0);
  return rounded;
}

TEST_CASE("by default there is no replanning") {
  CHECK(replans({}, 60.0, [](double) { return dmrp_vec2{0.0, 3.0}; }).empty());
}

TEST_CASE("periodic replanning happens at control ticks") {
  ReplanSettings settings;
  settings.period_ns = 2 * second_ns;
  const auto drives = [](double t_s) { return dmrp_vec2{0.5 * t_s, 0.0}; };
  CHECK(approximately(replans(settings, 6.5, drives)) == std::vector<double>{2.0, 4.0, 6.0});
  settings.period_ns = 1'750'000'000;
  CHECK(approximately(replans(settings, 4.0, drives)) == std::vector<double>{1.8, 3.6});
}

TEST_CASE("a robot that strays causes replanning, not before the minimum interval") {
  ReplanSettings settings;
  settings.stray_m = 1.0;
  // 1.05 m off at 2.1 s; the planner was asked at 0 s first
  const auto strays = [](double t_s) { return dmrp_vec2{2.0, 0.5 * t_s}; };
  CHECK(approximately(replans(settings, 6.5, strays)) == std::vector<double>{2.1, 4.1, 6.1});
  settings.min_interval_ns = 3 * second_ns;
  CHECK(approximately(replans(settings, 6.5, strays)) == std::vector<double>{3.0, 6.0});
}

TEST_CASE("a robot that stalls causes replanning, repeatedly if it still stalls") {
  ReplanSettings settings;
  settings.stall_ns = 5 * second_ns;
  // drives for 3 s and 1.65 m; the last gain of 0.2 m was complete at 2.8 s
  const auto stalls = [](double t_s) { return dmrp_vec2{0.55 * std::min(t_s, 3.0), 0.0}; };
  CHECK(approximately(replans(settings, 15.0, stalls)) == std::vector<double>{7.8, 12.8});
}

TEST_CASE("inactive robots cause no replanning") {
  ReplanSettings settings;
  settings.period_ns = second_ns;
  ReplanMonitor monitor(settings, 1);
  std::vector<RobotState> robots(1);
  robots[0].state = DMRP_ROBOT_FINISHED;
  CHECK_FALSE(monitor.due(5 * second_ns, robots, std::vector<double>(1), std::vector<PathProgress>(1)));
}

}  // namespace replanning_test
