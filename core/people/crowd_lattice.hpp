// SPDX-License-Identifier: MIT
// crowd_lattice.hpp: random but even positions for many people in a region.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <functional>
#include <vector>

namespace dmrp::core {

// Returns `count` points of the rectangle for which has_room() is true, at pairwise distances of at least `apart_m`, in
// random order; fewer where there is no room for more. The points come from the widest hexagonal lattice of random
// phase with enough such points; each is then displaced at random within the bounds of the distances. Points drawn one
// by one would reach about half of the closest packing; a lattice reaches nearly all of it.
std::vector<dmrp_vec2> spread_on_lattice(const toolkit::Rectangle& where, std::size_t count, double apart_m,
                                         toolkit::Stream& stream, const std::function<bool(dmrp_vec2)>& has_room);

// The constraints on positions of groups.
struct GroupSpread {
  double apart_m = 0.0;           // between any two people
  double apart_in_group_m = 0.0;  // between members of a group if there is room; at least apart_m
  bool rows_along_x = true;       // members stand in rows along this axis
  std::function<bool(dmrp_vec2)> has_room;
  std::function<bool(dmrp_vec2, dmrp_vec2)> in_sight;  // no wall separates members
};

// Positions for groups of these sizes, parallel to `sizes`. Members get neighbouring points of a hexagonal lattice;
// each group gets a random place in its section of the path that winds through all points row by row. The lattice
// narrows until all groups fit. Groups without room are empty in the result.
std::vector<std::vector<dmrp_vec2>> spread_groups_on_lattice(const toolkit::Rectangle& where,
                                                             const std::vector<std::uint32_t>& sizes,
                                                             toolkit::Stream& stream, const GroupSpread& spread);

}  // namespace dmrp::core
