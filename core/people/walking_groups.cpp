// SPDX-License-Identifier: MIT
#include "core/people/walking_groups.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

constexpr std::uint32_t most_abreast = 3;
constexpr int tries_in_area = 32;

}  // namespace

std::uint32_t group_count(const Flow& flow) {
  assert(flow.group_size > 0);
  return flow.people / flow.group_size + (flow.people % flow.group_size != 0);
}

std::vector<WalkingGroup> divide_into_groups(const std::vector<Flow>& flows) {
  std::vector<WalkingGroup> groups;
  std::uint32_t slot = 0;
  std::uint32_t id = 0;
  for (std::uint32_t flow = 0; flow < flows.size(); ++flow) {
    std::uint32_t left = flows[flow].people;
    for (std::uint32_t number = 0; left > 0; ++number) {
      const std::uint32_t size = std::min(left, flows[flow].group_size);
      groups.push_back({flow, number, slot, size, size > 1 ? ++id : 0});
      slot += size;
      left -= size;
    }
  }
  return groups;
}

std::uint32_t widest_row(std::uint32_t group_size) {
  return std::min(group_size, most_abreast);
}

std::vector<dmrp_vec2> formation(std::uint32_t size, std::uint32_t abreast, double apart_m, double heading) {
  assert(abreast > 0);
  const dmrp_vec2 ahead = toolkit::from_angle(heading);
  const dmrp_vec2 left = toolkit::perpendicular(ahead);
  const std::uint32_t rows = (size + abreast - 1) / abreast;
  std::vector<dmrp_vec2> offsets;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint32_t in_row = std::min(abreast, size - row * abreast);
    const double ahead_m = apart_m * (0.5 * (rows - 1) - row);
    for (std::uint32_t column = 0; column < in_row; ++column) {
      const double left_m = apart_m * (column - 0.5 * (in_row - 1));
      offsets.push_back(ahead_m * ahead + left_m * left);
    }
  }
  return offsets;
}

bool StandingRoom::is_free(dmrp_vec2 point) const {
  for (const dmrp_vec2 robot : robots)
    if (toolkit::distance(robot, point) < spawn_distance_to_robots_m) return false;
  for (const dmrp_vec2 other : taken)
    if (toolkit::distance(other, point) < apart_m()) return false;
  return geometry.disc_is_free(point, radius_m);
}

std::optional<std::vector<dmrp_vec2>> StandingRoom::places_around(dmrp_vec2 middle, double heading, std::uint32_t size,
                                                                  std::uint32_t abreast) const {
  std::vector<dmrp_vec2> places = formation(size, abreast, apart_in_group_m(), heading);
  for (dmrp_vec2& place : places) {
    place += middle;
    if (!is_free(place) || (size > 1 && !geometry.line_of_sight(middle, place))) return std::nullopt;
  }
  return places;
}

dmrp_vec2 draw_in(const toolkit::Rectangle& area, toolkit::Stream& stream) {
  const double x = stream.uniform(area.lower.x, area.upper.x);
  return {x, stream.uniform(area.lower.y, area.upper.y)};
}

toolkit::Rectangle middles_in(const toolkit::Rectangle& area, std::span<const dmrp_vec2> offsets) {
  toolkit::Rectangle middles = area;
  for (const dmrp_vec2 offset : offsets) {
    middles.lower.x = std::max(middles.lower.x, area.lower.x - offset.x);
    middles.lower.y = std::max(middles.lower.y, area.lower.y - offset.y);
    middles.upper.x = std::min(middles.upper.x, area.upper.x - offset.x);
    middles.upper.y = std::min(middles.upper.y, area.upper.y - offset.y);
  }
  if (middles.lower.x > middles.upper.x) middles.lower.x = middles.upper.x = 0.5 * (area.lower.x + area.upper.x);
  if (middles.lower.y > middles.upper.y) middles.lower.y = middles.upper.y = 0.5 * (area.lower.y + area.upper.y);
  return middles;
}

std::optional<std::vector<dmrp_vec2>> draw_places(const StandingRoom& room, const toolkit::Rectangle& area,
                                                  double heading, std::uint32_t size, toolkit::Stream& stream) {
  for (std::uint32_t abreast = widest_row(size); abreast > 0; --abreast) {
    const toolkit::Rectangle middles = middles_in(area, formation(size, abreast, room.apart_in_group_m(), heading));
    for (int tries = 0; tries < tries_in_area; ++tries) {
      auto places = room.places_around(draw_in(middles, stream), heading, size, abreast);
      if (places &&
          std::all_of(places->begin(), places->end(), [&](dmrp_vec2 place) { return toolkit::contains(area, place); }))
        return places;
    }
  }
  return std::nullopt;
}

}  // namespace dmrp::core
