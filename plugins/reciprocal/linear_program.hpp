// SPDX-License-Identifier: MIT
// The best of the velocities that half-planes permit.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), sections 5.2 and
// 5.3; incremental linear programming: de Berg et al., Computational Geometry, chapter 4. The half-planes are added in
// the given order, nearest first, not at random: the optimum is the same, and there are few of them.
#pragma once

#include <cstddef>
#include <vector>

#include "reciprocal/half_plane.hpp"

namespace dmrp::reciprocal {

// Keeps its buffer from one solution to the next.
class VelocityProgram {
 public:
  // The velocity nearest to `preferred` in the intersection of all half-planes and of the disc of `max_speed`. If the
  // intersection is empty: the velocity within the first `hard_count` half-planes that minimises the greatest violation
  // of the others. Hard half-planes must contain the zero velocity.
  Vec2 solve(const std::vector<HalfPlane>& planes, std::size_t hard_count, double max_speed, Vec2 preferred);

 private:
  Vec2 least_violation(const std::vector<HalfPlane>& planes, std::size_t hard_count, std::size_t first_violated,
                       double max_speed, Vec2 start);

  std::vector<HalfPlane> bisected_;
};

}  // namespace dmrp::reciprocal
