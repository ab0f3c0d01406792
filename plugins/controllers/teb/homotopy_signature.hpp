// SPDX-License-Identifier: MIT
// homotopy_signature.hpp: tells ways round the obstacles apart, in whole numbers.
//
// Every obstacle has a mark at its left end and one at its right end, as seen from start to goal, and from each mark a
// ray goes out. How often a way crosses the ray from right to left, less how often from left to right, differs between
// two ways with the same ends by how often the loop of both winds round the mark. These numbers, one a mark, are what
// the H-signature by residues (Bhattacharya, Likhachev, Kumar: Topological constraints in search-based robot path
// planning, Autonomous Robots 33 (2012)) comes to in the plane; but they neither overflow nor round, and equality needs
// no threshold. Two marks an obstacle tell a way through it from those round it, which one representative point as
// upstream does not. The numbers are summed up as one of 64 bits, each times a random weight of its mark's.
//
// What moves at constant velocity is looked at in its own frame, its rays straight ahead of it: the numbers say whether
// the way passes in front of it, as the H-signature in space and time does.
#ifndef DMRP_CONTROLLERS_TEB_HOMOTOPY_SIGNATURE_HPP
#define DMRP_CONTROLLERS_TEB_HOMOTOPY_SIGNATURE_HPP

#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

using Signature = std::uint64_t;

// Of the mark at this place in the list: the finaliser of splitmix64 (Steele, Lea, Flood: Fast splittable
// pseudorandom number generators, OOPSLA 2014).
inline Signature signature_weight(std::size_t mark) {
  std::uint64_t z = (static_cast<std::uint64_t>(mark) + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// How a step from `from` to `to` crosses the ray from the origin along `ray`: 1 to its left, -1 to its right, else 0.
inline int ray_crossing(Vec2 from, Vec2 to, Vec2 ray) {
  const double side_from = toolkit::cross(ray, from);
  const double side_to = toolkit::cross(ray, to);
  if ((side_from > 0.0) == (side_to > 0.0)) return 0;
  // where the step meets the ray's line, times (side_to - side_from), whose sign is that of the crossing
  const double ahead = toolkit::dot(ray, from) * side_to - toolkit::dot(ray, to) * side_from;
  if (side_to > side_from) return ahead > 0.0 ? 1 : 0;
  return ahead < 0.0 ? -1 : 0;
}

// Stands or moves; a point of an obstacle.
struct Mark {
  Vec2 at = {0.0, 0.0};        // now
  Vec2 velocity = {0.0, 0.0};  // m/s
  std::uint32_t obstacle = 0;
};

// In the obstacles' order, one or two of each. `along`: from start to goal.
void set_marks(const std::vector<Obstacle>& obstacles, Vec2 along, std::vector<Mark>& marks);

// Of a straight step past marks that are thought to stand at `places`.
Signature step_signature(Vec2 from, Vec2 to, const std::vector<Vec2>& places);

// Of a band, past each mark where that will be by then.
Signature band_signature(const TimedElasticBand& band, const std::vector<Mark>& marks);

}  // namespace dmrp::controllers::teb

#endif
