// SPDX-License-Identifier: MIT
// homotopy_signature.hpp: an integer signature that distinguishes homotopy classes of paths around obstacles.
//
// Each obstacle has two marks, at its left and its right end as seen from start to goal, and each mark emits a ray.
// Count the crossings of a path with the ray from right to left, minus those from left to right. For two paths with the
// same ends, the difference of their counts is the winding number of the closed loop around the mark. In the plane
// these counts are equivalent to the H-signature by residues (Bhattacharya, Likhachev, Kumar: Topological constraints
// in search-based robot path planning, Autonomous Robots 33 (2012)), but they neither overflow nor round, and comparing
// them needs no threshold. Two marks per obstacle distinguish a path through an obstacle from the paths around it,
// which the one representative point of upstream does not. The signature is the sum of the counts, each times a
// pseudorandom 64-bit weight of its mark.
//
// An obstacle that moves at constant velocity is considered in its own frame, with its rays along its velocity: the
// counts tell whether the path passes in front of it, as the H-signature in space and time does.
#pragma once

#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

using Signature = std::uint64_t;

// The weight of the mark with this index: the finaliser of splitmix64 (Steele, Lea, Flood: Fast splittable pseudorandom
// number generators, OOPSLA 2014).
inline Signature signature_weight(std::size_t mark) {
  std::uint64_t z = (static_cast<std::uint64_t>(mark) + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// 1 if the step crosses the ray from the origin along `ray` to its left, -1 if to its right, otherwise 0.
inline int ray_crossing(Vec2 from, Vec2 to, Vec2 ray) {
  const double side_from = toolkit::cross(ray, from);
  const double side_to = toolkit::cross(ray, to);
  if ((side_from > 0.0) == (side_to > 0.0)) return 0;
  // the coordinate along the ray at which the step crosses its line, times (side_to - side_from)
  const double ahead = toolkit::dot(ray, from) * side_to - toolkit::dot(ray, to) * side_from;
  if (side_to > side_from) return ahead > 0.0 ? 1 : 0;
  return ahead < 0.0 ? -1 : 0;
}

// A point of an obstacle, standing or moving.
struct Mark {
  Vec2 at = {0.0, 0.0};        // now
  Vec2 velocity = {0.0, 0.0};  // m/s
  std::uint32_t obstacle = 0;
};

// One or two marks per obstacle, in the obstacles' order. `along`: the vector from start to goal.
void set_marks(const std::vector<Obstacle>& obstacles, Vec2 along, std::vector<Mark>& marks);

// The signature of a straight step past standing marks.
Signature step_signature(Vec2 from, Vec2 to, const std::vector<Vec2>& marks);

// The signature of a band past marks that may move.
Signature band_signature(const TimedElasticBand& band, const std::vector<Mark>& marks);

}  // namespace dmrp::controllers::teb
