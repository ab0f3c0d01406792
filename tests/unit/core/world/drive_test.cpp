// SPDX-License-Identifier: MIT
// Each drive against closed-form trajectories.
#include "core/world/drive.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace drive_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr double dt_s = 0.02;
constexpr double exact = 1e-9;

dmrp_limits limits() {
  dmrp_limits limits{};
  limits.v_min = -1.0;
  limits.v_max = 2.0;
  limits.v_y_max = 1.0;
  limits.omega_max = 2.0;
  limits.a_max = 1.0;
  limits.alpha_max = 1.0;
  limits.wheelbase_m = 0.7;
  limits.steering_max = 0.6;
  limits.steering_rate_max = 0.5;
  return limits;
}

DriveState drive_for(DriveState state, const dmrp_twist& command, Drive drive, int steps) {
  for (int i = 0; i < steps; ++i) state = advance(state, command, drive, limits(), dt_s);
  return state;
}

// The place after a ramp of the steering angle at constant speed, by the midpoint rule with many short steps.
dmrp_vec2 integrated_ramp(double v_x, double rate, double duration_s, double wheelbase_m) {
  constexpr int steps = 200'000;
  dmrp_vec2 place{};
  for (int i = 0; i < steps; ++i) {
    const double t_s = (i + 0.5) * duration_s / steps;
    const double heading = -v_x / (wheelbase_m * rate) * std::log(std::cos(rate * t_s));
    place += (v_x * duration_s / steps) * toolkit::from_angle(heading);
  }
  return place;
}

TEST_CASE("a differential drive at constant velocity describes an arc") {
  const DriveState start = {{1.0, 2.0, 0.3}, {0.8, 0.0, 0.5}};
  const DriveState end = drive_for(start, {0.8, 0.0, 0.5}, Drive::differential, 250);
  const double radius_m = 0.8 / 0.5;
  CHECK(end.pose.x == Approx(1.0 + radius_m * (std::sin(2.8) - std::sin(0.3))).margin(exact));
  CHECK(end.pose.y == Approx(2.0 - radius_m * (std::cos(2.8) - std::cos(0.3))).margin(exact));
  CHECK(end.pose.theta == Approx(2.8).margin(exact));
}

TEST_CASE("a holonomic drive moves sideways and turns at once") {
  // the velocity in the world turns with the robot: both components describe arcs
  const dmrp_twist velocity = {0.6, -0.4, 0.7};
  const DriveState end = drive_for({{0.0, 0.0, 0.0}, velocity}, velocity, Drive::holonomic, 100);
  const double turn = 1.4;
  CHECK(end.pose.x == Approx((0.6 * std::sin(turn) + 0.4 * (1.0 - std::cos(turn))) / 0.7).margin(exact));
  CHECK(end.pose.y == Approx((0.6 * (1.0 - std::cos(turn)) - 0.4 * std::sin(turn)) / 0.7).margin(exact));
  CHECK(end.pose.theta == Approx(turn).margin(exact));
}

TEST_CASE("a holonomic drive speeds up at a_max in any direction") {
  const DriveState end = drive_for({}, {0.6, 0.8, 0.0}, Drive::holonomic, 25);
  CHECK(end.velocity.v_x == Approx(0.3).margin(exact));
  CHECK(end.velocity.v_y == Approx(0.4).margin(exact));
  const DriveState settled = drive_for({}, {0.6, 0.8, 0.0}, Drive::holonomic, 51);
  CHECK(settled.velocity.v_x == Approx(0.6).margin(exact));
}

TEST_CASE("a car with a constant steering angle describes a circle of radius wheelbase / tan") {
  const double steering = 0.4;
  const double radius_m = 0.7 / std::tan(steering);
  const dmrp_twist velocity = {1.0, 0.0, 1.0 / radius_m};
  const DriveState end = drive_for({{0.0, 0.0, 0.0}, velocity, steering}, velocity, Drive::ackermann, 150);
  const double turn = 3.0 / radius_m;
  CHECK(end.pose.x == Approx(radius_m * std::sin(turn)).margin(exact));
  CHECK(end.pose.y == Approx(radius_m * (1.0 - std::cos(turn))).margin(exact));
  CHECK(end.pose.theta == Approx(turn).margin(exact));
  CHECK(end.steering_rad == Approx(steering).margin(exact));
}

TEST_CASE("a car's steering ramp follows the integral of its curvature") {
  // from straight ahead toward 0.5 rad at 0.5 rad/s, at 1 m/s
  const double omega = std::tan(0.5) / 0.7;
  const DriveState end = drive_for({{0, 0, 0}, {1.0, 0.0, 0.0}}, {1.0, 0.0, omega}, Drive::ackermann, 40);
  CHECK(end.steering_rad == Approx(0.4).margin(exact));
  CHECK(end.pose.theta == Approx(-std::log(std::cos(0.4)) / (0.7 * 0.5)).margin(exact));
  const dmrp_vec2 place = integrated_ramp(1.0, 0.5, 0.8, 0.7);
  CHECK(end.pose.x == Approx(place.x).margin(exact));
  CHECK(end.pose.y == Approx(place.y).margin(exact));
  CHECK(end.velocity.omega == Approx(std::tan(0.4) / 0.7).margin(exact));
}

TEST_CASE("a ramp that ends within a step goes on as a circle") {
  // 0.005 rad take half of the step
  const double aim = 0.005;
  const double omega = std::tan(aim) / 0.7;
  const DriveState end = advance({{0, 0, 0}, {1.0, 0.0, 0.0}}, {1.0, 0.0, omega}, Drive::ackermann, limits(), dt_s);
  CHECK(end.steering_rad == Approx(aim).margin(exact));
  CHECK(end.pose.theta == Approx(-std::log(std::cos(aim)) / (0.7 * 0.5) + 0.01 * std::tan(aim) / 0.7).margin(exact));
}

TEST_CASE("a standing car keeps its wheels and does not turn") {
  const DriveState end = drive_for({{0, 0, 1.0}, {}, 0.3}, {0.0, 0.0, 1.0}, Drive::ackermann, 50);
  CHECK(end.pose.theta == Approx(1.0));
  CHECK(end.steering_rad == Approx(0.3));
  CHECK(clip_to_drive({0.0, 0.0, 1.0}, Drive::ackermann, limits()).omega == 0.0);
}

TEST_CASE("commands are clipped to the drive's ability") {
  const dmrp_twist command = {1.0, 0.5, 1.9};
  CHECK(clip_to_drive(command, Drive::holonomic, limits()).v_y == 0.5);
  dmrp_limits differential = limits();
  differential.v_y_max = 0.0;
  CHECK(clip_to_drive(command, Drive::differential, differential).v_y == 0.0);
  CHECK(clip_to_drive(command, Drive::ackermann, differential).omega == Approx(std::tan(0.6) / 0.7));
}

}  // namespace drive_test
