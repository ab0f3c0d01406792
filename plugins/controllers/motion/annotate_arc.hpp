// SPDX-License-Identifier: MIT
// annotate_arc.hpp: writes the arc of a command into the trace.
#pragma once

#include <dmrp/ext/annotate.h>

#include <array>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

// `annotate` may be NULL.
inline void annotate_arc(const dmrp_annotate* annotate, const Pose& from, double v, double omega, double duration_s) {
  if (!annotate || !annotate->wanted(annotate)) return;
  constexpr std::size_t count = 18;
  const double step_s = duration_s / (count - 1);
  const ArcStepper stepper(v, omega, step_s);
  DirectedPoint at = directed(from);
  std::array<Pose, count> poses;
  for (Pose& pose : poses) {
    pose = pose_of(at);
    stepper.step(at);
  }
  annotate->trajectory(annotate, DMRP_ANNOTATE_PREDICTED, poses.data(), count, static_cast<int64_t>(step_s * 1e9));
}

}  // namespace dmrp::controllers
