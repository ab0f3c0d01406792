// SPDX-License-Identifier: MIT
// The best velocity among those that half-planes permit.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), sections 5.2 and
// 5.3; incremental linear programming: de Berg et al., Computational Geometry, chapter 4. Half-planes are added in the
// order given, nearest first, not at random: the result is the same, and they are few.
#pragma once

#include <cstddef>
#include <vector>

#include "pedestrians/orca/half_plane.hpp"

namespace dmrp::pedestrians {

// Keeps its buffer from one solution to the next.
class VelocityProgram {
 public:
  // The velocity in all half-planes that is nearest to `preferred` and no faster than `max_speed`. Where there is none:
  // the one that keeps to the first `hard_count` half-planes and leaves the others by as little as possible (the
  // greatest violation is least). Hard half-planes hold the zero velocity.
  dmrp_vec2 solve(const std::vector<HalfPlane>& planes, std::size_t hard_count, double max_speed, dmrp_vec2 preferred);

 private:
  dmrp_vec2 least_violation(const std::vector<HalfPlane>& planes, std::size_t hard_count, std::size_t first_violated,
                            double max_speed, dmrp_vec2 start);

  std::vector<HalfPlane> bisected_;
};

}  // namespace dmrp::pedestrians
