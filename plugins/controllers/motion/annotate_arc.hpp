// SPDX-License-Identifier: MIT
// annotate_arc.hpp: leaves the arc that a controller has chosen in the trace, where the trace keeps such things.
#ifndef DMRP_CONTROLLERS_MOTION_ANNOTATE_ARC_HPP
#define DMRP_CONTROLLERS_MOTION_ANNOTATE_ARC_HPP

#include <dmrp/ext/annotate.h>

#include <array>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

// `annotate` may be NULL.
inline void annotate_arc(const dmrp_annotate* annotate, const dmrp_pose& from, double v, double omega,
                         double duration_s) {
  if (!annotate || !annotate->wanted(annotate)) return;
  constexpr std::size_t count = 18;
  const double step_s = duration_s / (count - 1);
  const ArcStepper stepper(v, omega, step_s);
  ArcState at = arc_state(from);
  std::array<dmrp_pose, count> poses;
  for (dmrp_pose& pose : poses) {
    pose = {at.x, at.y, std::atan2(at.sin_theta, at.cos_theta)};
    stepper.step(at);
  }
  annotate->trajectory(annotate, DMRP_ANNOTATE_PREDICTED, poses.data(), count, static_cast<int64_t>(step_s * 1e9));
}

}  // namespace dmrp::controllers

#endif
