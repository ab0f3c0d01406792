// SPDX-License-Identifier: MIT
// path_controller.hpp: the common part of the controllers: each follows a path, stops at its end and annotates.
#pragma once

#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <dmrp/plugin.hpp>

#include "controllers/motion/annotations.hpp"
#include "controllers/motion/path_tracker.hpp"
#include "controllers/motion/stop_and_rotate.hpp"

namespace dmrp::controllers {

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
