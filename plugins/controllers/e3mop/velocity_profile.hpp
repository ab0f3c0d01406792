// SPDX-License-Identifier: MIT
// velocity_profile.hpp: time-optimal speeds along a path (section V of the paper): forward and backward integration
// under the maximum-velocity curve.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/e3mop/spline_path.hpp"

namespace dmrp::controllers::e3mop {

// Sets speed and time_s of the path's points. With the curvature k and its derivative k' along the path, the
// maximum-velocity curve is the minimum of v_max, omega_max / |k| and sqrt(alpha_max / |k'|). Below it, a_max bounds
// the acceleration, and alpha_max bounds omega' = k v' + k' v^2.
//
// A start speed above the maximum-velocity curve stays as it is; the tracking controller handles it.
void plan_speeds(std::vector<PathPoint>& path, double start_speed, double end_speed, const Limits& limits);

// The speed at the time `ahead_s` after the path's start.
double speed_after(const std::vector<PathPoint>& path, double ahead_s);

}  // namespace dmrp::controllers::e3mop
