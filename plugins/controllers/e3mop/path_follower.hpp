// SPDX-License-Identifier: MIT
// path_follower.hpp: drives the robot along a path with a velocity profile.
#ifndef DMRP_CONTROLLERS_E3MOP_PATH_FOLLOWER_HPP
#define DMRP_CONTROLLERS_E3MOP_PATH_FOLLOWER_HPP

#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/e3mop/spline_path.hpp"

namespace dmrp::controllers::e3mop {

// Where a pose is, seen from the place of the path that is nearest to it.
struct TrackingError {
  std::size_t index = 0;   // of the nearest sample
  double cross_m = 0.0;    // to the left of the path
  double aside_rad = 0.0;  // turned to the left of the path
};

// The path must not be empty.
TrackingError tracking_error(const std::vector<PathPoint>& path, const Pose& pose);

// Feed-forward of the profile's speed and of the curvature ahead; feedback of the errors at the place that the robot
// will have reached when the command acts. Within the limits and what a control period lets the robot reach.
Command follow(const std::vector<PathPoint>& path, const Observation& now);

}  // namespace dmrp::controllers::e3mop

#endif
