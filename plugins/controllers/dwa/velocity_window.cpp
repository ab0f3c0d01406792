// SPDX-License-Identifier: MIT
#include "controllers/dwa/velocity_window.hpp"

#include <algorithm>

namespace dmrp::controllers::dwa {

void sample_range(double lowest, double highest, std::size_t count, std::vector<double>& values) {
  values.clear();
  if (!(highest > lowest)) {
    values.push_back(lowest);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
    const double value = (1.0 - fraction) * lowest + fraction * highest;
    if (value > 0.0 && !values.empty() && values.back() < 0.0) values.push_back(0.0);
    values.push_back(value);
  }
}

void VelocityWindow::sample(const Observation& now, double reach_s, double v_most, const SampleCounts& counts) {
  const Limits& limits = now.limits;
  // a measured velocity outside the limits (noise) gives a window at the limit
  const auto window = [](double current, double step, double lower, double upper, std::size_t count,
                         std::vector<double>& values) {
    sample_range(std::clamp(current - step, lower, upper), std::clamp(current + step, lower, upper), count, values);
  };
  window(now.velocity.v_x, limits.a_max * reach_s, limits.v_min, std::min(limits.v_max, v_most), counts.v_x, v);
  const double v_y_most = std::min(limits.v_y_max, v_most);
  if (v_y_most > 0.0)
    window(now.velocity.v_y, limits.a_max * reach_s, -v_y_most, v_y_most, counts.v_y, v_y);
  else
    v_y.assign(1, 0.0);
  window(now.velocity.omega, limits.alpha_max * reach_s, -limits.omega_max, limits.omega_max, counts.omega, omega);
  center_ = {std::clamp(now.velocity.v_x, limits.v_min, limits.v_max),
             std::clamp(now.velocity.v_y, -limits.v_y_max, limits.v_y_max)};
  reach_m_s_ = limits.a_max * reach_s;
}

}  // namespace dmrp::controllers::dwa
