// SPDX-License-Identifier: MIT
// unicycle.hpp: what (v, omega) does to a differential drive, exactly: arcs, braking, reachable speeds.
#ifndef DMRP_CONTROLLERS_MOTION_UNICYCLE_HPP
#define DMRP_CONTROLLERS_MOTION_UNICYCLE_HPP

#include <dmrp/values.h>

#include <algorithm>
#include <cmath>

namespace dmrp::controllers {

// A pose whose heading is kept as a direction: stepping along an arc then needs no sine.
struct ArcState {
  double x = 0.0;
  double y = 0.0;
  double cos_theta = 1.0;
  double sin_theta = 0.0;
};

inline ArcState arc_state(const dmrp_pose& pose) {
  return {pose.x, pose.y, std::cos(pose.theta), std::sin(pose.theta)};
}

// Equal steps along the arc of a constant (v, omega): each turns by omega dt and moves by the chord.
class ArcStepper {
 public:
  ArcStepper(double v, double omega, double dt) {
    const double half_turn = 0.5 * omega * dt;
    // sin(x)/x by its series where the quotient would lose digits
    const double sinc =
        std::abs(half_turn) > 1e-4 ? std::sin(half_turn) / half_turn : 1.0 - half_turn * half_turn / 6.0;
    const double chord = v * dt * sinc;
    ahead_ = chord * std::cos(half_turn);
    left_ = chord * std::sin(half_turn);
    cos_turn_ = std::cos(omega * dt);
    sin_turn_ = std::sin(omega * dt);
  }

  void step(ArcState& state) const {
    const double c = state.cos_theta;
    const double s = state.sin_theta;
    state.x += c * ahead_ - s * left_;
    state.y += s * ahead_ + c * left_;
    state.cos_theta = c * cos_turn_ - s * sin_turn_;
    state.sin_theta = s * cos_turn_ + c * sin_turn_;
  }

 private:
  double ahead_;
  double left_;
  double cos_turn_;
  double sin_turn_;
};

// The value nearest to `target` that `current` can be changed to by at most `step`.
inline double toward(double current, double target, double step) {
  return std::clamp(target, current - step, current + step);
}

// The greatest speed that, kept for one control period and then braked at `deceleration`, ends within `distance`
// (metres or radians). Below sqrt(2 deceleration distance) by what happens before the next command.
inline double stopping_speed(double distance, double deceleration, double period_s) {
  if (distance <= 0.0) return 0.0;
  const double a = deceleration;
  return a * (std::sqrt(period_s * period_s + 2.0 * distance / a) - period_s);
}

}  // namespace dmrp::controllers

#endif
