// SPDX-License-Identifier: MIT
#include "core/execution/ending.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

using namespace dmrp;
using namespace dmrp::core;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::int64_t second_ns = 1'000'000'000;

// Robots whose progress is given, watched at 10 Hz until an ending or 100 s.
struct Watch {
  EndingMonitor monitor;
  std::vector<RobotState> robots;
  std::int64_t ended_ns = -1;

  Watch(std::uint32_t count, std::int64_t limit_ns) : monitor(count, limit_ns), robots(count) {}

  template <class Move>
  std::uint32_t run(const Move& move) {
    std::vector<double> gained(robots.size(), 0.0);
    for (std::int64_t t_ns = 0; t_ns <= 100 * second_ns; t_ns += 100'000'000) {
      move(1e-9 * static_cast<double>(t_ns), robots, gained, monitor, t_ns);
      const std::uint32_t ending = monitor.update(t_ns, robots, gained);
      ended_ns = t_ns;
      if (ending != 0) return ending;
    }
    return 0;
  }
};

void command_all(EndingMonitor& monitor, std::size_t robots, std::int64_t t_ns) {
  for (std::uint32_t i = 0; i < robots; ++i) monitor.command_given(i, t_ns);
}

}  // namespace

TEST_CASE("a trial ends when all have arrived, or at the time limit") {
  Watch arriving(2, 60 * second_ns);
  const auto ending = arriving.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    gained = {t, t};
    for (std::size_t i = 0; i < 2; ++i) {
      if (t >= 10.0 + static_cast<double>(i)) {
        robots[i].state = DMRP_ROBOT_FINISHED;
        robots[i].arrival_ns = t_ns;
      }
    }
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(arriving.ended_ns == 11 * second_ns);
  CHECK(arriving.monitor.robot_ends(ending, arriving.robots)[1].failure == DMRP_FAILURE_NONE);

  Watch slow(1, 60 * second_ns);
  CHECK(slow.run([](double t, auto&, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 1, t_ns);
    gained = {0.011 * t};
  }) == DMRP_ENDING_TIME_LIMIT);
  CHECK(slow.ended_ns == 60 * second_ns);
  CHECK(slow.monitor.robot_ends(DMRP_ENDING_TIME_LIMIT, slow.robots)[0].failure == DMRP_FAILURE_TIMEOUT);
}

TEST_CASE("a deadlock is 20 s without 0.2 m of progress of any unfinished robot") {
  Watch watch(3, 90 * second_ns);
  const auto ending = watch.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 3, t_ns);
    // one has arrived, one stands from the beginning, one advances until 7 s and then creeps
    robots[0].state = DMRP_ROBOT_FINISHED;
    gained = {0.0, 0.0, t < 7.0 ? t : 7.0 + 0.009 * (t - 7.0)};
  });
  CHECK(ending == DMRP_ENDING_DEADLOCK);
  // from 27 s on the window begins at 7 s, where all that is left is 20 s * 0.009 m/s = 0.18 m
  CHECK(watch.ended_ns == 27 * second_ns);
  const auto ends = watch.monitor.robot_ends(ending, watch.robots);
  CHECK(ends[0].failure == DMRP_FAILURE_NONE);
  CHECK(ends[1].failure == DMRP_FAILURE_DEADLOCK);
}

TEST_CASE("a recovery is no deadlock, and what the robot does in it no oscillation") {
  Watch watch(1, 90 * second_ns);
  const auto ending = watch.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 1, t_ns);
    gained = {0.0};
    if (t < 10.0 || t > 40.0) return;
    monitor.restart(0, t_ns);
    robots[0].pose.x = 0.2 * std::sin(t);  // to and fro
  });
  CHECK(ending == DMRP_ENDING_DEADLOCK);
  CHECK(watch.ended_ns == Approx(60 * second_ns).margin(0.2 * second_ns));  // 20 s after the recovery
  CHECK(watch.monitor.failure(0) == DMRP_FAILURE_NONE);

  Watch silent(1, 90 * second_ns);
  silent.run([](double t, auto&, auto& gained, auto& monitor, std::int64_t t_ns) {
    gained = {t};
    monitor.restart(0, t_ns);
  });
  CHECK(silent.monitor.failure(0) == DMRP_FAILURE_NONE);
}

TEST_CASE("oscillation is recorded for good and ends nothing") {
  Watch watch(2, 90 * second_ns);
  const auto ending = watch.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    // the first goes to and fro by 0.2 m until 30 s, then advances and arrives; the second stands still, but advances
    robots[0].pose.x = 0.1 * std::sin(t);
    gained = {t < 30.0 ? 0.0 : t - 30.0, 0.02 * t};
    if (t > 40.0) robots[0].state = robots[1].state = DMRP_ROBOT_FINISHED;
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(watch.monitor.failure(0) == DMRP_FAILURE_OSCILLATION);
  CHECK(watch.monitor.failure(1) == DMRP_FAILURE_NONE);
  CHECK(watch.monitor.robot_ends(ending, watch.robots)[0].failure == DMRP_FAILURE_OSCILLATION);

  Watch turning(2, 90 * second_ns);
  turning.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    robots[0].pose.theta = std::remainder(0.65 * t, 2.0 * pi);  // 13 rad in 20 s, more than 4 pi
    robots[1].pose.theta = std::remainder(0.6 * t, 2.0 * pi);   // 12 rad
    gained = {0.0, t > 21.0 ? t : 0.0};
  });
  CHECK(turning.monitor.failure(0) == DMRP_FAILURE_OSCILLATION);
  CHECK(turning.monitor.failure(1) == DMRP_FAILURE_NONE);
}

TEST_CASE("five seconds without a command are a failure of the controller") {
  Watch watch(1, 90 * second_ns);
  std::int64_t failed_ns = -1;
  watch.run([&](double t, auto&, auto& gained, auto& monitor, std::int64_t t_ns) {
    gained = {t};
    if (t < 10.05) monitor.command_given(0, t_ns);
    if (failed_ns < 0 && monitor.failure(0) == DMRP_FAILURE_CONTROLLER) failed_ns = t_ns;
  });
  CHECK(failed_ns == 15'100'000'000);  // seen one tick after 15.0 s
}
