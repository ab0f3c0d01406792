// SPDX-License-Identifier: MIT
#include "controllers/mpc/turn_in_place.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"
#include "controllers/motion/stop_and_rotate.hpp"

namespace dmrp::controllers::mpc {

namespace {

// A robot faces the first point of its route beyond this distance.
constexpr double face_ahead_m = 0.3;

// The turn ends so close to its heading.
constexpr double turned_rad = 0.05;

// A holonomic robot turns first where its speed along its way would be below this share of its greatest.
constexpr double slow_share = 0.5;

}  // namespace

void TurnInPlace::begin(const std::vector<Vec2>& route, const Observation& now) {
  const Vec2 robot = toolkit::position(now.pose);
  const auto beyond = std::find_if(route.begin(), route.end(),
                                   [robot](Vec2 point) { return toolkit::distance(robot, point) > face_ahead_m; });
  if (beyond != route.end()) heading_ = toolkit::bearing(robot, *beyond);
}

bool TurnInPlace::begin_if_slow(const std::vector<Vec2>& route, const Observation& now) {
  if (!is_holonomic(now.limits)) return false;
  begin(route, now);
  if (!heading_) return false;
  const Vec2 way = toolkit::from_angle(toolkit::difference(now.pose.theta, *heading_));
  const double lengthwise_m_s = way.x > 0.0 ? now.limits.v_max : -now.limits.v_min;
  constexpr double least = 1e-9;
  const double speed_m_s = std::min(lengthwise_m_s / std::max(std::abs(way.x), least),
                                    now.limits.v_y_max / std::max(std::abs(way.y), least));
  if (speed_m_s >= slow_share * now.limits.v_max) heading_.reset();
  return heading_.has_value();
}

bool TurnInPlace::goes_on(const Observation& now, const FootprintCheck& footprint, Command& command) {
  if (!heading_) return false;
  const double angle = toolkit::difference(now.pose.theta, *heading_);
  const std::optional<Command> turn = braking_turn(angle, now, footprint);
  if (std::abs(angle) < turned_rad || !turn) {
    heading_.reset();
    return false;
  }
  command = *turn;
  return true;
}

}  // namespace dmrp::controllers::mpc
