// SPDX-License-Identifier: MIT
// crowd_lattice.hpp: many people in a place, evenly and yet at random.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <functional>
#include <vector>

namespace dmrp::core {

// `count` points in the rectangle, pairwise at least `apart_m` from each other, each where has_room() says yes: on the
// widest hexagonal lattice, of random phase, that has enough such points; each moved at random as far as it may be,
// given the distance to its neighbours. Points drawn one by one would stop at about half of the closest packing, a
// lattice reaches nearly all of it. In random order. Fewer than `count` where there is no room for more.
std::vector<dmrp_vec2> spread_on_lattice(const toolkit::Rectangle& where, std::size_t count, double apart_m,
                                         toolkit::Stream& stream, const std::function<bool(dmrp_vec2)>& has_room);

// What groups mind when they spread.
struct GroupSpread {
  double apart_m = 0.0;           // between any two
  double apart_in_group_m = 0.0;  // between companions, where there is room for that; not less than apart_m
  bool rows_along_x = true;       // companions stand in rows along this axis
  std::function<bool(dmrp_vec2)> has_room;
  std::function<bool(dmrp_vec2, dmrp_vec2)> in_sight;  // companions are not parted by a wall
};

// Places for groups of these sizes, parallel to `sizes`: companions have neighbouring points of a hexagonal lattice,
// each group somewhere in a stretch of its own of the way that winds through all points row by row. Where the lattice is
// too wide for all, it narrows; where there is no room, the groups that find none are empty.
std::vector<std::vector<dmrp_vec2>> spread_groups_on_lattice(const toolkit::Rectangle& where,
                                                             const std::vector<std::uint32_t>& sizes,
                                                             toolkit::Stream& stream, const GroupSpread& spread);

}  // namespace dmrp::core
