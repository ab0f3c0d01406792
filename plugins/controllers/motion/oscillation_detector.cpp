// SPDX-License-Identifier: MIT
#include "controllers/motion/oscillation_detector.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers {

void OscillationDetector::reset(std::size_t length) {
  ring_.assign(std::max<std::size_t>(length, 2), {0.0, 0.0});
  recorded_ = 0;
}

void OscillationDetector::record(const Command& command, const Limits& limits) {
  const double v_limit = command.v_x >= 0.0 ? limits.v_max : -limits.v_min;
  const auto fraction = [](double value, double limit) { return limit > 0.0 ? value / limit : 0.0; };
  ring_[recorded_ % ring_.size()] = {fraction(command.v_x, v_limit), fraction(command.omega, limits.omega_max)};
  ++recorded_;
}

bool OscillationDetector::is_oscillating(double v_fraction, double omega_fraction) const {
  const std::size_t count = std::min(recorded_, ring_.size());
  if (2 * count < ring_.size()) return false;
  double v_sum = 0.0;
  double omega_sum = 0.0;
  int sign_changes = 0;
  double last_omega = 0.0;
  for (std::size_t k = recorded_ - count; k < recorded_; ++k) {
    const Fraction& command = ring_[k % ring_.size()];
    v_sum += command.v;
    omega_sum += command.omega;
    if (command.omega * last_omega < 0.0) ++sign_changes;
    if (command.omega != 0.0) last_omega = command.omega;
  }
  const double n = static_cast<double>(count);
  return std::abs(v_sum) / n < v_fraction && std::abs(omega_sum) / n < omega_fraction && sign_changes > 1;
}

}  // namespace dmrp::controllers
