// SPDX-License-Identifier: MIT
// allowed_velocities.hpp: the holonomic velocities that a differential drive can follow closely enough.
//
// Alonso-Mora, Breitenmoser, Rufli, Beardsley, Siegwart: Optimal reciprocal collision avoidance for multiple
// non-holonomic robots, DARS 2010 (Springer 2013), section 3.
#pragma once

#include <dmrp/cpp/plugin_base.hpp>
#include <vector>

#include "reciprocal/half_plane.hpp"

namespace dmrp::controllers::orca {

// How a differential drive follows a holonomic velocity: on an arc, to its direction within `align_s` or as fast as it
// turns, then straight.
struct Follower {
  double v_max = 0.0;  // m/s
  double omega_max = 0.0;
  double alpha_max = 0.0;  // rad/s^2
  double align_s = 0.0;
};

// The speed on the arc toward a holonomic velocity of this speed, `angle` to the side, that makes the tracking error
// least: 0 if it is straight behind.
double arc_speed(double speed, double angle);

// The turning rate meanwhile: the mean of a turn from rest to rest, which the paper, without accelerations, has not.
double arc_rate(const Follower& follower, double angle);

// The distance at the end of the arc between the robot and a point that moves with the holonomic velocity from the start.
double tracking_error(const Follower& follower, double speed, double angle);

// The greatest speed, up to v_max, at which the error stays within `error_m`.
double greatest_speed(const Follower& follower, double angle, double error_m);

// Half-planes whose intersection is a convex polygon of allowed velocities for a robot with this heading; the zero
// velocity is in all of them. Appends to `planes`.
void append_allowed(const Follower& follower, double error_m, double heading,
                    std::vector<reciprocal::HalfPlane>& planes);

}  // namespace dmrp::controllers::orca
