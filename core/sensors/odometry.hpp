// SPDX-License-Identifier: MIT
// odometry.hpp: the pose estimate of a robot.
//
// The odometry motion model of Thrun, Burgard, Fox, Probabilistic Robotics (2005), table 5.6: between two readings the
// robot turned by rot1, moved by trans, and turned by rot2; each is measured with a normal error of variance
//   rot1: a1 rot1^2 + a2 trans^2    trans: a3 trans^2 + a4 (rot1^2 + rot2^2)    rot2: a1 rot2^2 + a2 trans^2
// A holonomic drive moves sideways without turning, so its motion is the turn and a way whose components along and
// across the heading are measured alike, as in the omnidirectional model of ROS's AMCL:
//   turn: a1 turn^2 + a2 trans^2    each component: a3 trans^2 + a4 turn^2
// Readings are taken at control ticks. Errors accumulate to a drift until a fix (by a localisation, for example) resets
// the estimate to the true pose. The world, arrivals and metrics use the true pose.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/random.hpp>

#include "core/scene/settings.hpp"

namespace dmrp::core {

class Odometry {
 public:
  // `seed`: the trial's. The first estimate is exact.
  Odometry(const OdometrySettings& settings, std::uint64_t seed, std::uint32_t robot, const dmrp_pose& pose,
           Drive drive = Drive::differential);

  // Takes a reading of the motion from the pose of the previous reading to this true pose. Times must increase.
  void read(std::int64_t t_ns, const dmrp_pose& pose, const dmrp_twist& velocity);

  // The estimate; the true values if there is no noise.
  const dmrp_pose& pose() const { return estimate_; }
  const dmrp_twist& velocity() const { return velocity_; }

  // Maps a true pose or direction in the world to the frame of the estimate: the place at which a robot with this
  // estimate would observe it.
  dmrp_pose to_estimated(const dmrp_pose& pose) const;
  dmrp_vec2 direction_to_estimated(dmrp_vec2 direction) const;

 private:
  bool is_exact() const;
  double heading_error() const;
  void add_rolling_errors(const dmrp_pose& before, toolkit::Stream& noise, double per_second);
  void add_omnidirectional_errors(const dmrp_pose& before, toolkit::Stream& noise, double per_second);

  OdometrySettings settings_;
  std::uint64_t seed_;
  std::uint32_t robot_;
  Drive drive_;
  std::int64_t read_ns_ = -1;
  std::int64_t fixed_ns_ = 0;
  dmrp_pose truth_{};
  dmrp_pose estimate_{};
  dmrp_twist velocity_{};
};

}  // namespace dmrp::core
