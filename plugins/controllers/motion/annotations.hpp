// SPDX-License-Identifier: MIT
// annotations.hpp: what a controller writes into the trace about its robot.
#pragma once

#include <dmrp/ext/annotate.h>

#include <array>
#include <cassert>
#include <span>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

class Annotations {
 public:
  Annotations() = default;

  // `annotate` may be NULL: nothing is written then. `robot`: that of start().
  Annotations(const dmrp_annotate* annotate, std::int32_t robot)
      : annotate_(annotate), robot_(static_cast<std::uint32_t>(robot)) {}

  // Ask before computing any.
  bool wanted() const { return annotate_ && annotate_->wanted(annotate_); }

  void trajectory(std::uint32_t role, std::span<const Pose> poses, double step_s) const {
    assert(annotate_);
    const dmrp_trajectory trajectory = {sizeof(trajectory),
                                        role,
                                        robot_,
                                        static_cast<std::uint32_t>(poses.size()),
                                        poses.data(),
                                        static_cast<std::int64_t>(step_s * 1e9)};
    annotate_->trajectory(annotate_, &trajectory);
  }

  void note(const char* text) const {
    const dmrp_note note = {sizeof(note), robot_, text};
    annotate_->note(annotate_, &note);
  }

  // The arc of a command, if it is wanted.
  void arc(const Pose& from, const Command& command, double duration_s) const {
    if (!wanted()) return;
    constexpr std::size_t count = 18;
    const double step_s = duration_s / (count - 1);
    const ArcStepper stepper(command.v_x, command.v_y, command.omega, step_s);
    DirectedPoint at = directed(from);
    std::array<Pose, count> poses;
    for (Pose& pose : poses) {
      pose = pose_of(at);
      stepper.step(at);
    }
    trajectory(DMRP_ANNOTATE_PREDICTED, poses, step_s);
  }

 private:
  const dmrp_annotate* annotate_ = nullptr;
  std::uint32_t robot_ = 0;
};

}  // namespace dmrp::controllers
