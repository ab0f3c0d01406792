// SPDX-License-Identifier: MIT
#include "core/people/first_places.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <numeric>
#include <optional>

#include "core/people/crowd_lattice.hpp"

namespace dmrp::core {
namespace {

using toolkit::Stream;

constexpr double lane_half_width_m = 1.5;  // largest distance of first positions from the route
constexpr int tries_along_flow = 64;
constexpr int tries_anywhere = 2000;

// A point on a route of several legs.
struct RoutePlace {
  dmrp_vec2 point{};
  double heading = 0.0;
  std::uint32_t leg = 0;
};

RoutePlace place_on(const std::vector<Route>& legs, double fraction) {
  double left_m = 0.0;
  for (const Route& leg : legs) left_m += toolkit::length(leg);
  left_m *= fraction;
  for (std::uint32_t i = 0;; ++i) {
    const std::vector<double> arcs = toolkit::arc_lengths(legs[i]);
    if (left_m <= arcs.back() || i + 1 == legs.size())
      return {toolkit::point_at(legs[i], arcs, left_m), toolkit::heading_at(legs[i], arcs, left_m, 0.0), i};
    left_m -= arcs.back();
  }
}

// The positions of a group around a point that is visible from its route.
std::optional<std::vector<FirstPlace>> places_beside(const RoutePlace& on_route, dmrp_vec2 point, std::uint32_t size,
                                                     std::uint32_t abreast, const StandingRoom& room) {
  const auto places = room.places_around(point, on_route.heading, size, abreast);
  if (!places || !room.geometry.line_of_sight(on_route.point, point))
    return std::nullopt;  // otherwise it is behind a wall
  std::vector<FirstPlace> out;
  for (const dmrp_vec2 place : *places) out.push_back({place, on_route.leg});
  return out;
}

// Random positions in the group's section of the route and beside it, so that groups cover the route evenly. Members
// stand side by side if possible, otherwise in narrower rows. Returns nothing if there is no room.
std::vector<FirstPlace> places_along_flow(const Flow& flow, const WalkingGroup& group, const std::vector<Route>& legs,
                                          const StandingRoom& room, std::uint64_t seed) {
  Stream stream(seed, "population.begin", group.first_slot);
  for (std::uint32_t abreast = widest_row(group.size); abreast > 0; --abreast)
    for (int tries = 0; tries < tries_along_flow; ++tries) {
      const double fraction = (group.number + stream.uniform()) / group_count(flow);
      const double aside_m = stream.uniform(-lane_half_width_m, lane_half_width_m);
      const RoutePlace on_route = place_on(legs, fraction);
      const dmrp_vec2 left = toolkit::perpendicular(toolkit::from_angle(on_route.heading));
      if (auto places = places_beside(on_route, on_route.point + aside_m * left, group.size, abreast, room))
        return *std::move(places);
    }
  for (std::uint32_t abreast = widest_row(group.size); abreast > 0; --abreast)
    for (int tries = 0; tries < tries_anywhere; ++tries) {
      const RoutePlace on_route = place_on(legs, stream.uniform());
      const dmrp_vec2 reach = {4.0 * lane_half_width_m, 4.0 * lane_half_width_m};
      const dmrp_vec2 point = draw_in({on_route.point - reach, on_route.point + reach}, stream);
      if (auto places = places_beside(on_route, point, group.size, abreast, room)) return *std::move(places);
    }
  return {};
}

// The people of all flows who start in one region.
struct RegionCrowd {
  std::uint32_t region = 0;
  std::uint32_t first_flow = 0;
  std::vector<std::uint32_t> group_sizes;  // in order of slots
  bool rows_along_x = false;               // rows of members lie across the first flow's direction
};

// In order of size, the smallest region first.
std::vector<RegionCrowd> crowds_by_region(const Scenario& scenario) {
  std::map<std::uint32_t, RegionCrowd> by_region;
  for (const WalkingGroup& group : divide_into_groups(scenario.flows)) {
    const Flow& flow = scenario.flows[group.flow];
    if (flow.start != FlowStart::from) continue;
    const std::uint32_t first = flow.regions[0];
    const auto [at, is_new] = by_region.try_emplace(first);
    if (is_new) {
      const dmrp_vec2 way = middle_of(scenario.regions[flow.regions[1]]) - middle_of(scenario.regions[first]);
      at->second = {first, group.flow, {}, std::abs(way.y) > std::abs(way.x)};
    }
    at->second.group_sizes.push_back(group.size);
  }
  std::vector<RegionCrowd> crowds;
  for (auto& [region, crowd] : by_region) crowds.push_back(std::move(crowd));
  const auto area = [&](const RegionCrowd& crowd) {
    const dmrp_vec2 extent = scenario.regions[crowd.region].upper - scenario.regions[crowd.region].lower;
    return extent.x * extent.y;
  };
  std::stable_sort(crowds.begin(), crowds.end(),
                   [&](const RegionCrowd& one, const RegionCrowd& two) { return area(one) < area(two); });
  return crowds;
}

// Parallel to the crowd's group_sizes; groups without room are empty.
std::vector<std::vector<dmrp_vec2>> places_in_region(const Scenario& scenario, const RegionCrowd& crowd,
                                                     const StandingRoom& room, std::uint64_t seed) {
  const toolkit::Rectangle where = {scenario.regions[crowd.region].lower, scenario.regions[crowd.region].upper};
  Stream stream(seed, "population.from", crowd.region);
  const auto has_room = [&](dmrp_vec2 point) { return room.is_free(point); };
  const std::vector<std::uint32_t>& sizes = crowd.group_sizes;
  if (std::any_of(sizes.begin(), sizes.end(), [](std::uint32_t size) { return size > 1; })) {
    const auto in_sight = [&](dmrp_vec2 a, dmrp_vec2 b) { return room.geometry.line_of_sight(a, b); };
    return spread_groups_on_lattice(where, sizes, stream,
                                    {room.apart_m(), room.apart_in_group_m(), crowd.rows_along_x, has_room, in_sight});
  }
  const auto points = spread_on_lattice(where, sizes.size(), room.apart_m(), stream, has_room);
  std::vector<std::vector<dmrp_vec2>> places(sizes.size());
  for (std::size_t i = 0; i < points.size(); ++i) places[points.size() - 1 - i] = {points[i]};
  return places;
}

void refuse_if_too_few(const Scenario& scenario, const RegionCrowd& crowd, std::size_t found,
                       const std::vector<dmrp_vec2>& taken) {
  const std::size_t people = std::accumulate(crowd.group_sizes.begin(), crowd.group_sizes.end(), std::size_t{0});
  if (found == people) return;
  const Region& region = scenario.regions[crowd.region];
  const auto others = std::count_if(taken.begin(), taken.end(), [&](dmrp_vec2 other) {
    return toolkit::contains(toolkit::Rectangle{region.lower, region.upper}, other);
  });
  throw NoRoom(crowd.first_flow,
               "no room in region '" + region.name + "' for " + std::to_string(people) + " people, for " +
                   std::to_string(found) + " at most" +
                   (others > 0 ? " beside " + std::to_string(others) + " who are there already" : ""));
}

}  // namespace

std::vector<FirstPlace> first_places(const Scenario& scenario, const FlowRoutes& routes, const StandingRoom& room,
                                     std::uint64_t seed) {
  assert(routes.legs.size() == scenario.flows.size());
  std::vector<dmrp_vec2> taken(room.taken.begin(), room.taken.end());
  const auto room_now = [&] { return StandingRoom{room.geometry, room.radius_m, room.robots, taken}; };
  struct Places {
    std::vector<std::vector<dmrp_vec2>> of_groups;
    std::size_t used = 0;
  };
  std::map<std::uint32_t, Places> by_region;
  for (const RegionCrowd& crowd : crowds_by_region(scenario)) {
    const auto& places = by_region[crowd.region].of_groups = places_in_region(scenario, crowd, room_now(), seed);
    std::size_t found = 0;
    for (const auto& group : places) found += group.size();
    refuse_if_too_few(scenario, crowd, found, taken);
    for (const auto& group : places) taken.insert(taken.end(), group.begin(), group.end());
  }
  std::vector<std::size_t> placed_along(scenario.flows.size());
  std::vector<FirstPlace> out;
  for (const WalkingGroup& group : divide_into_groups(scenario.flows)) {
    const Flow& flow = scenario.flows[group.flow];
    if (flow.start == FlowStart::from) {
      Places& places = by_region[flow.regions.front()];
      for (const dmrp_vec2 position : places.of_groups[places.used]) out.push_back({position, 0});
      ++places.used;
      continue;
    }
    const auto places = places_along_flow(flow, group, routes.legs[group.flow], room_now(), seed);
    if (places.empty())
      throw NoRoom(group.flow, "no room along flow '" + flow.name + "' for " + std::to_string(flow.people) + " people" +
                                   (group.size > 1 ? " in groups of " + std::to_string(group.size) : "") + ", for " +
                                   std::to_string(placed_along[group.flow]) + " at most");
    for (const FirstPlace& place : places) {
      out.push_back(place);
      taken.push_back(place.position);
    }
    placed_along[group.flow] += places.size();
  }
  return out;
}

}  // namespace dmrp::core
