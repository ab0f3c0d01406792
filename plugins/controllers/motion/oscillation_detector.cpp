// SPDX-License-Identifier: MIT
#include "controllers/motion/oscillation_detector.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers {

void OscillationDetector::reset(std::size_t length) {
  ring_.assign(std::max<std::size_t>(length, 2), {0.0, 0.0});
  noted_ = 0;
}

void OscillationDetector::note(const Command& command, const Limits& limits) {
  const double v_limit = command.v_x >= 0.0 ? limits.v_max : -limits.v_min;
  const auto share = [](double value, double limit) { return limit > 0.0 ? value / limit : 0.0; };
  ring_[noted_ % ring_.size()] = {share(command.v_x, v_limit), share(command.omega, limits.omega_max)};
  ++noted_;
}

bool OscillationDetector::is_oscillating(double v_share, double omega_share) const {
  const std::size_t count = std::min(noted_, ring_.size());
  if (2 * count < ring_.size()) return false;
  double v_sum = 0.0;
  double omega_sum = 0.0;
  int sign_changes = 0;
  double last_omega = 0.0;
  for (std::size_t age = noted_ - count; age < noted_; ++age) {
    const Share& share = ring_[age % ring_.size()];
    v_sum += share.v;
    omega_sum += share.omega;
    if (share.omega * last_omega < 0.0) ++sign_changes;
    if (share.omega != 0.0) last_omega = share.omega;
  }
  const double n = static_cast<double>(count);
  return std::abs(v_sum) / n < v_share && std::abs(omega_sum) / n < omega_share && sign_changes > 1;
}

}  // namespace dmrp::controllers
