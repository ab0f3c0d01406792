// SPDX-License-Identifier: MIT
// odometry.hpp: where a robot believes it is.
//
// The odometry motion model of Thrun, Burgard, Fox, Probabilistic Robotics (2005), table 5.6: between two readings the
// robot turned by rot1, went trans, and turned by rot2; each is read with a normal error of variance
//   rot1: a1 rot1^2 + a2 trans^2    trans: a3 trans^2 + a4 (rot1^2 + rot2^2)    rot2: a1 rot2^2 + a2 trans^2
// Readings are taken at control ticks. Errors add up to a drift, until a fix (of a localisation, say) tells the robot
// its true pose again. The world itself, arrivals and metrics know the truth.
#pragma once

#include <dmrp/values.h>

#include <cstdint>

#include "core/scene/settings.hpp"

namespace dmrp::core {

class Odometry {
 public:
  // `seed`: the trial's. At first the robot knows where it is.
  Odometry(const OdometrySettings& settings, std::uint64_t seed, std::uint32_t robot, const dmrp_pose& pose);

  // A reading: how the robot has got to this pose since the one before. Times grow.
  void read(std::int64_t t_ns, const dmrp_pose& pose, const dmrp_twist& velocity);

  // As the robot believes; the truth itself without noise.
  const dmrp_pose& pose() const { return believed_; }
  const dmrp_twist& velocity() const { return velocity_; }

  // Something seen from where the robot is, in the world as the robot believes it to lie about it.
  dmrp_pose as_believed(const dmrp_pose& pose) const;
  dmrp_vec2 direction_as_believed(dmrp_vec2 direction) const;

 private:
  bool is_exact() const;
  double turned_by() const;  // the error of the heading

  OdometrySettings settings_;
  std::uint64_t seed_;
  std::uint32_t robot_;
  std::int64_t read_ns_ = -1;
  std::int64_t fixed_ns_ = 0;
  dmrp_pose true_{};
  dmrp_pose believed_{};
  dmrp_twist velocity_{};
};

}  // namespace dmrp::core
