// SPDX-License-Identifier: MIT
// crowd_lattice.hpp: many people in a place, evenly and yet at random.
#pragma once

#include <dmrp/values.h>

#include <cstddef>
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

}  // namespace dmrp::core
