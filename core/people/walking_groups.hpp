// SPDX-License-Identifier: MIT
// walking_groups.hpp: the groups of flows, and their formations: side by side, as groups walk at low density (Moussaid
// et al.: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010); they calibrated a distance of 0.8 m
// between neighbours, which is group_gap_m between bodies of the default radius).
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
inline constexpr double personal_gap_m = 0.05;             // between the bodies of any two people at the beginning
inline constexpr double group_gap_m = 0.4;                 // between the bodies of group members at the beginning

// People of a flow who walk together. A person who walks alone is a group of one.
struct WalkingGroup {
  std::uint32_t flow = 0;
  std::uint32_t number = 0;      // within the flow
  std::uint32_t first_slot = 0;  // its members have this slot and the following ones
  std::uint32_t size = 1;
  std::uint32_t id = 0;  // 1, 2, ... over all groups of two or more; 0 for a group of one
};

// The groups of all flows, by slot.
std::vector<WalkingGroup> divide_into_groups(const std::vector<Flow>& flows);

std::uint32_t group_count(const Flow& flow);

// The number of members who walk side by side: at most three, the others walk in rows behind. Zanlungo and Kanda
// (CogSci 2013) observed that larger groups split up like this.
std::uint32_t widest_row(std::uint32_t group_size);

// The positions of members relative to the group's centre, for this heading: rows of `abreast`, from right to left and
// from front to back, with `apart_m` between neighbours.
std::vector<dmrp_vec2> formation(std::uint32_t size, std::uint32_t abreast, double apart_m, double heading);

// Constraints on the positions of people at the beginning.
struct StandingRoom {
  const StaticGeometry& geometry;
  double radius_m = 0.0;
  std::span<const dmrp_vec2> robots;  // people keep spawn_distance_to_robots_m from them
  std::span<const dmrp_vec2> taken;   // positions of other people

  double apart_m() const { return 2.0 * radius_m + personal_gap_m; }
  double apart_in_group_m() const { return 2.0 * radius_m + group_gap_m; }

  bool is_free(dmrp_vec2 point) const;

  // The positions of a group in formation around `middle`; nothing unless all are free and none is behind a wall.
  std::optional<std::vector<dmrp_vec2>> places_around(dmrp_vec2 middle, double heading, std::uint32_t size,
                                                      std::uint32_t abreast) const;
};

dmrp_vec2 draw_in(const toolkit::Rectangle& area, toolkit::Stream& stream);

// The positions of a formation's centre for which all members are in the area. Along an axis on which the formation
// does not fit: the area's centre.
toolkit::Rectangle middles_in(const toolkit::Rectangle& area, std::span<const dmrp_vec2> offsets);

// Random positions of a group with this heading in the area, with rows as wide as possible. Nothing if 32 tries for
// each width of rows find none.
std::optional<std::vector<dmrp_vec2>> draw_places(const StandingRoom& room, const toolkit::Rectangle& area,
                                                  double heading, std::uint32_t size, toolkit::Stream& stream);

}  // namespace dmrp::core
