// SPDX-License-Identifier: MIT
// walking_groups.hpp: who walks with whom, and where a group finds room: side by side, as groups walk at low density
// (Moussaid et al.: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010); they calibrated 0.8 m from one
// to the next, which is group_gap_m for people 0.6 m across).
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/scenario.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

inline constexpr double spawn_distance_to_robots_m = 1.5;  // between centres
inline constexpr double personal_gap_m = 0.05;             // between the bodies of two who begin
inline constexpr double group_gap_m = 0.2;                 // between the bodies of companions who begin

// The people of a flow who walk together. Who walks alone is a group of one.
struct WalkingGroup {
  std::uint32_t flow = 0;
  std::uint32_t number = 0;      // within the flow
  std::uint32_t first_slot = 0;  // of its people, who have the slots from here on
  std::uint32_t size = 1;
  std::uint32_t id = 0;  // 1, 2, ... over all groups of two or more; 0: alone
};

// Of all flows, by slot.
std::vector<WalkingGroup> deal_groups(const std::vector<Flow>& flows);

std::uint32_t group_count(const Flow& flow);

// How many walk side by side: three at most, the others in rows behind (larger groups split up so, as Zanlungo and Kanda
// saw, CogSci 2013).
std::uint32_t widest_row(std::uint32_t group_size);

// Where the members of a group are, from its middle, when it faces this way: rows of `abreast`, from right to left and
// from the front to the back, `apart_m` between neighbours. A group of one is in its middle.
std::vector<dmrp_vec2> formation(std::uint32_t size, std::uint32_t abreast, double apart_m, double heading);

// What keeps people from standing somewhere at the beginning.
struct StandingRoom {
  const StaticGeometry& geometry;
  double radius_m = 0.0;
  std::span<const dmrp_vec2> robots;  // nobody begins near them
  std::span<const dmrp_vec2> taken;   // by other people

  double apart_m() const { return 2.0 * radius_m + personal_gap_m; }
  double apart_in_group_m() const { return 2.0 * radius_m + group_gap_m; }

  bool holds(dmrp_vec2 point) const;

  // The places of a group in formation round `middle`; nothing unless all have room and none is beyond a wall.
  std::optional<std::vector<dmrp_vec2>> places_round(dmrp_vec2 middle, double heading, std::uint32_t size,
                                                     std::uint32_t abreast) const;
};

dmrp_vec2 draw_in(const toolkit::Rectangle& area, toolkit::Stream& stream);

// Where the middle of a formation may be so that everybody is in the area: along an axis on which it has no room there,
// half-way.
toolkit::Rectangle middles_in(const toolkit::Rectangle& area, std::span<const dmrp_vec2> offsets);

// The places of a group that faces this way, somewhere in the area: as many side by side as can be. Nothing if none was
// found, in 32 tries for each number.
std::optional<std::vector<dmrp_vec2>> draw_places(const StandingRoom& room, const toolkit::Rectangle& area,
                                                  double heading, std::uint32_t size, toolkit::Stream& stream);

}  // namespace dmrp::core
