// SPDX-License-Identifier: MIT
// velocity_profile.hpp: time-optimal speeds along a path (section V of the paper): forward and backward integration
// under the maximum-velocity curve.
#ifndef DMRP_CONTROLLERS_E3MOP_VELOCITY_PROFILE_HPP
#define DMRP_CONTROLLERS_E3MOP_VELOCITY_PROFILE_HPP

#include <dmrp/robot.h>

#include <vector>

#include "controllers/e3mop/spline_path.hpp"

namespace dmrp::controllers::e3mop {

// Fills in speed and time_s. The maximum-velocity curve at a point is the least of v_max, omega_max / |k| and, with k'
// the change of the curvature k along the path, sqrt(alpha_max / |k'|). Below it the speed changes by a_max at most,
// and by what alpha_max leaves of that: omega' = k v' + k' v^2.
//
// A start that is too fast for the path's beginning stays as it is: what the robot does about that is the tracker's.
void plan_speeds(std::vector<PathPoint>& path, double start_speed, double end_speed, const dmrp_limits& limits);

// The speed `ahead_s` after the path's start.
double speed_after(const std::vector<PathPoint>& path, double ahead_s);

}  // namespace dmrp::controllers::e3mop

#endif
