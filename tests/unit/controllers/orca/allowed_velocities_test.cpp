// SPDX-License-Identifier: MIT
// The tracking error of a differential drive that follows a holonomic velocity, against its motion.
#include "controllers/orca/allowed_velocities.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace allowed_velocities_test {

using namespace dmrp::controllers::orca;
namespace toolkit = dmrp::toolkit;

// The greatest distance between the robot and the point, by small steps, until the robot has turned and beyond.
double simulated_error(const Follower& follower, double speed, double angle) {
  const double step_s = 1e-4;
  const double rate = arc_rate(follower, angle);
  dmrp_vec2 robot = {0.0, 0.0};
  double theta = 0.0;
  double greatest = 0.0;
  double t_s = 0.0;
  for (; std::abs(theta) < std::abs(angle); t_s += step_s) {
    robot += arc_speed(speed, angle) * step_s * toolkit::from_angle(theta + 0.5 * rate * step_s);
    theta += rate * step_s;
    greatest = std::max(greatest, toolkit::distance(robot, speed * (t_s + step_s) * toolkit::from_angle(angle)));
  }
  return greatest;
}

constexpr Follower slow_turner = {0.8, 1.0, 1.0, 0.35};
constexpr Follower quick_turner = {0.8, 6.0, 40.0, 0.35};

TEST_CASE("The tracking error is that of the motion, greatest at the end of the arc") {
  for (const Follower& follower : {slow_turner, quick_turner}) {
    for (const double angle : {0.1, 0.3, -0.7, 1.2, -1.5, 2.0, 3.1}) {
      CAPTURE(angle, follower.omega_max);
      const double error_m = tracking_error(follower, 0.5, angle);
      CHECK(error_m == Approx(simulated_error(follower, 0.5, angle)).margin(1e-3));
      CHECK(tracking_error(follower, 0.5, -angle) == Approx(error_m));
    }
  }
}

TEST_CASE("The speed on the arc makes the tracking error least") {
  const double turn = 1.0;
  const double duration_s = turn / arc_rate(slow_turner, turn);
  const auto error_at = [&](double arc) {
    const double radius_m = arc / arc_rate(slow_turner, turn);
    const dmrp_vec2 robot = {radius_m * std::sin(turn), radius_m * (1.0 - std::cos(turn))};
    return toolkit::distance(robot, 0.5 * duration_s * toolkit::from_angle(turn));
  };
  const double best = arc_speed(0.5, turn);
  CHECK(error_at(best) == Approx(tracking_error(slow_turner, 0.5, turn)));
  CHECK(error_at(best) < error_at(best + 0.01));
  CHECK(error_at(best) < error_at(best - 0.01));
  CHECK(arc_speed(0.5, 0.0) == 0.5);
  CHECK(arc_speed(0.5, dmrp::toolkit::pi) == Approx(0.0).margin(1e-12));
}

TEST_CASE("A turn from rest to rest takes its accelerations into account") {
  // 0.5 s to 1 rad/s and 0.5 s back are 0.5 rad; 1.5 rad more take 1.5 s
  const Follower follower = {0.8, 1.0, 2.0, 0.35};
  CHECK(arc_rate(follower, 2.0) == Approx(2.0 / 2.5));
  CHECK(arc_rate(follower, -0.125) == Approx(-0.125 / 0.5));
  CHECK(arc_rate(follower, 0.01) == Approx(0.01 / 0.35));
}

TEST_CASE("The polygon of allowed velocities keeps the tracking error") {
  const double error_m = GENERATE(0.01, 0.05, 0.1);
  const double heading = GENERATE(0.0, 2.5);
  CAPTURE(error_m, heading);
  std::vector<dmrp::reciprocal::HalfPlane> planes;
  append_allowed(slow_turner, error_m, heading, planes);
  const auto allows = [&planes](dmrp_vec2 velocity) {
    return std::all_of(planes.begin(), planes.end(),
                       [velocity](const auto& plane) { return violation(plane, velocity) <= 1e-9; });
  };
  CHECK(allows({0.0, 0.0}));
  CHECK(allows(0.799 * toolkit::from_angle(heading)));
  CHECK_FALSE(allows(0.4 * toolkit::from_angle(heading + 1.6)));
  toolkit::Stream chance(1, "allowed velocities");
  int allowed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double angle = chance.uniform(-toolkit::pi, toolkit::pi);
    const double speed = 0.8 * std::sqrt(chance.uniform());
    if (!allows(speed * toolkit::from_angle(heading + angle))) continue;
    ++allowed;
    REQUIRE(tracking_error(slow_turner, speed, angle) < 1.05 * error_m);
  }
  CHECK(allowed > 100);
}

}  // namespace allowed_velocities_test
