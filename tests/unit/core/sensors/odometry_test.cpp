// SPDX-License-Identifier: MIT
#include "core/sensors/odometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <numbers>
#include <tuple>
#include <utility>

namespace odometry_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr double pi = std::numbers::pi;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t tick_ns = 100'000'000;

OdometrySettings noise(double a1, double a2, double a3, double a4, std::int64_t fix_period_ns = 0) {
  return {{a1, a2, a3, a4}, fix_period_ns};
}

// Mean and standard deviation, over many seeds, of the error of the believed pose after one motion.
template <class ErrorOf>
std::pair<double, double> error_of(const OdometrySettings& settings, const dmrp_pose& from, const dmrp_pose& to,
                                   ErrorOf error) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 4000;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Odometry odometry(settings, seed, 2, from);
    odometry.read(0, from, {});
    odometry.read(tick_ns, to, {});
    const double e = error(odometry.pose());
    sum += e;
    squares += e * e;
  }
  return {sum / count, std::sqrt(squares / count)};
}

TEST_CASE("without noise the believed pose is exact, to the bit") {
  Odometry odometry({}, 1, 0, {1, 2, 0.3});
  odometry.read(0, {1, 2, 0.3}, {});
  const dmrp_pose there = {1.1, 2.05, 0.31};
  odometry.read(tick_ns, there, {0.5, 0.0, 0.1});
  CHECK(odometry.pose().x == there.x);
  CHECK(odometry.pose().theta == there.theta);
  CHECK(odometry.velocity().omega == 0.1);
  const dmrp_pose seen = odometry.to_estimated({5, 5, 1.0});
  CHECK(seen.x == 5.0);
  CHECK(seen.theta == 1.0);
}

TEST_CASE("errors of odometry have the variances of the model") {
  // 0.5 m straight ahead: the distance has the variance a3 d^2, the turn before it a2 d^2, which leads to the side
  const dmrp_pose origin = {0, 0, 0};
  const dmrp_pose ahead = {0.5, 0, 0};
  auto [mean, sd] = error_of(noise(0, 0, 0.04, 0), origin, ahead, [](const dmrp_pose& p) { return p.x - 0.5; });
  CHECK(mean == Approx(0.0).margin(0.006));
  CHECK(sd == Approx(0.2 * 0.5).epsilon(0.05));
  std::tie(mean, sd) = error_of(noise(0, 0.01, 0, 0), origin, ahead, [](const dmrp_pose& p) { return p.y; });
  CHECK(mean == Approx(0.0).margin(0.002));
  CHECK(sd == Approx(0.5 * 0.1 * 0.5).epsilon(0.05));
  // both turns have this variance
  std::tie(mean, sd) = error_of(noise(0, 0.01, 0, 0), origin, ahead, [](const dmrp_pose& p) { return p.theta; });
  CHECK(sd == Approx(std::sqrt(2.0) * 0.1 * 0.5).epsilon(0.05));
  // a turn in place has the variance a1 turn^2, and an apparent motion of the variance a4 turn^2
  const dmrp_pose turned = {0, 0, 0.4};
  std::tie(mean, sd) = error_of(noise(0.09, 0, 0, 0), origin, turned, [](const dmrp_pose& p) { return p.theta - 0.4; });
  CHECK(sd == Approx(0.3 * 0.4).epsilon(0.05));
  std::tie(mean, sd) =
      error_of(noise(0, 0, 0, 0.25), origin, turned, [](const dmrp_pose& p) { return std::hypot(p.x, p.y); });
  CHECK(sd == Approx(0.5 * 0.4).epsilon(0.05));
  // backward motion has the same errors as forward motion
  std::tie(mean, sd) =
      error_of(noise(0.09, 0, 0.04, 0), origin, {-0.5, 0, 0}, [](const dmrp_pose& p) { return p.x + 0.5; });
  CHECK(sd == Approx(0.2 * 0.5).epsilon(0.05));
  // a robot that stands does not drift
  std::tie(mean, sd) = error_of(noise(1, 1, 1, 1), origin, origin, [](const dmrp_pose& p) { return p.x + p.theta; });
  CHECK(sd == 0.0);
}

TEST_CASE("drift grows until a fix, and the reported speed is that of the readings") {
  Odometry odometry(noise(0.01, 0.01, 0.01, 0.01, second_ns), 3, 0, {0, 0, 0});
  double largest_m = 0.0;
  dmrp_pose before_believed{};
  for (int tick = 0; tick <= 100; ++tick) {
    const dmrp_pose truth = {0.05 * tick, 0.0, 0.0};
    odometry.read(tick * tick_ns, truth, {0.5, 0.0, 0.0});
    const double error_m = std::hypot(odometry.pose().x - truth.x, odometry.pose().y - truth.y);
    if (tick > 0 && tick % 10 == 0) {
      CHECK(error_m == 0.0);
    } else if (tick > 1) {
      const double went_m = std::hypot(odometry.pose().x - before_believed.x, odometry.pose().y - before_believed.y);
      CHECK(odometry.velocity().v_x == Approx(went_m / 0.1));
    }
    largest_m = std::max(largest_m, error_m);
    before_believed = odometry.pose();
  }
  CHECK(largest_m > 0.005);
}

TEST_CASE("observations are relative to the believed pose") {
  Odometry odometry(noise(0.5, 0.5, 0.5, 0.5), 5, 0, {0, 0, 0});
  odometry.read(0, {0, 0, 0}, {});
  odometry.read(tick_ns, {0.3, 0.1, 0.4}, {});
  const dmrp_pose believed = odometry.pose();
  REQUIRE(std::abs(believed.theta - 0.4) > 1e-3);
  // 2 m straight ahead, facing the robot
  const dmrp_pose other = {0.3 + 2.0 * std::cos(0.4), 0.1 + 2.0 * std::sin(0.4), 0.4 + pi};
  const dmrp_pose seen = odometry.to_estimated(other);
  CHECK(seen.x == Approx(believed.x + 2.0 * std::cos(believed.theta)));
  CHECK(seen.y == Approx(believed.y + 2.0 * std::sin(believed.theta)));
  CHECK(std::abs(toolkit::difference(seen.theta, believed.theta + pi)) < 1e-12);
  const dmrp_vec2 toward = odometry.direction_to_estimated({std::cos(0.4), std::sin(0.4)});
  CHECK(toward.x == Approx(std::cos(believed.theta)));
}

TEST_CASE("noise depends on the seed and the robot") {
  const auto after = [](std::uint64_t seed, std::uint32_t robot) {
    Odometry odometry(noise(0.1, 0.1, 0.1, 0.1), seed, robot, {0, 0, 0});
    odometry.read(0, {0, 0, 0}, {});
    odometry.read(tick_ns, {0.08, 0, 0.05}, {});
    return odometry.pose().x;
  };
  CHECK(after(1, 0) == after(1, 0));
  CHECK(after(1, 0) != after(2, 0));
  CHECK(after(1, 0) != after(1, 1));
}

TEST_CASE("a holonomic drive's sideways motion is no turn") {
  const auto moved = [](Drive drive) {
    Odometry odometry(noise(1.0, 0.0, 0.0, 0.0), 5, 0, {0, 0, 0}, drive);
    odometry.read(0, {0, 0, 0}, {});
    odometry.read(tick_ns, {0.0, 0.1, 0.0}, {0.0, 1.0, 0.0});
    return odometry.pose();
  };
  CHECK(moved(Drive::holonomic).theta == 0.0);
  CHECK(moved(Drive::holonomic).y == Approx(0.1));
  CHECK(moved(Drive::differential).theta != 0.0);  // turn, drive, turn back
}

TEST_CASE("errors of a holonomic drive have the stated deviations") {
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_turn = 0.0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    Odometry odometry(noise(0.04, 0.01, 0.09, 0.16), static_cast<std::uint64_t>(i), 0, {0, 0, 0}, Drive::holonomic);
    odometry.read(0, {0, 0, 0}, {});
    odometry.read(tick_ns, {0.3, 0.4, 0.2}, {});
    sum_x += std::pow(odometry.pose().x - 0.3, 2);
    sum_y += std::pow(odometry.pose().y - 0.4, 2);
    sum_turn += std::pow(odometry.pose().theta - 0.2, 2);
  }
  const double component = 0.09 * 0.25 + 0.16 * 0.04;
  CHECK(sum_x / count == Approx(component).epsilon(0.1));
  CHECK(sum_y / count == Approx(component).epsilon(0.1));
  CHECK(sum_turn / count == Approx(0.04 * 0.04 + 0.01 * 0.25).epsilon(0.1));
}

}  // namespace odometry_test
