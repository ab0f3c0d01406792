// SPDX-License-Identifier: MIT
// path_controller.hpp: the common part of the controllers: each follows a path, stops at its end and annotates.
#pragma once

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <array>
#include <cassert>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <span>

#include "controllers/motion/path_tracker.hpp"
#include "controllers/motion/stop_and_rotate.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

// What a controller writes into the trace about its robot.
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

class PathController : public LocalController {
 public:
  void set_path(Path path, std::uint64_t /*revision*/) override { tracker_.set_path(path); }

  // Brakes while there is no path.
  Status step(const Observation& now, Command& command) final {
    command = braking(now);
    tracker_.update(now);
    return tracker_.empty() ? Status::ok : control(now, command);
  }

 protected:
  static Descriptor describe_controller(const char* id, const char* name) {
    return Descriptor(id, name, "1.0.0").vendor("dmrp").license("MIT");
  }

  // In start().
  void begin(const Start& start) {
    annotations_ = {find_extension<dmrp_annotate>(), start.robot};
    tracker_.clear();
    at_goal_.reset();
  }

  // The tracker is up to date, and `command` is braking(now).
  virtual Status control(const Observation& now, Command& command) = 0;

  Annotations annotations_;
  PathTracker tracker_;
  StopAndRotate at_goal_;
};

}  // namespace dmrp::controllers
