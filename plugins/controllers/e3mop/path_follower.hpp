// SPDX-License-Identifier: MIT
// path_follower.hpp: the tracking controller for a path with a velocity profile.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/e3mop/spline_path.hpp"

namespace dmrp::controllers::e3mop {

// The deviation of a pose from the closest sample of a path.
struct TrackingError {
  std::size_t index = 0;     // of the closest sample
  double cross_m = 0.0;      // cross-track error, positive to the left of the path
  double heading_rad = 0.0;  // heading error, positive to the left
};

// The path must not be empty.
TrackingError tracking_error(const std::vector<PathPoint>& path, const Pose& pose);

// Feed-forward of the profile's speed and of the curvature ahead, and feedback of the tracking error predicted for the
// end of the control period. The command respects the limits and is reachable within one control period.
Command follow(const std::vector<PathPoint>& path, const Observation& now);

}  // namespace dmrp::controllers::e3mop
