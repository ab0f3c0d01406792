// SPDX-License-Identifier: MIT
#include "core/population.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <map>
#include <string>

#include "core/crowd_lattice.hpp"

namespace dmrp::core {
namespace {

using toolkit::Stream;

constexpr double lane_half_width_m = 1.5;  // how far aside of the route people begin
constexpr int tries_along_flow = 64;
constexpr int tries_anywhere = 2000;
constexpr int tries_in_region = 32;
constexpr std::int64_t retry_period_ns = 500'000'000;

dmrp_vec2 draw_in(Stream& stream, dmrp_vec2 lower, dmrp_vec2 upper) {
  const double x = stream.uniform(lower.x, upper.x);
  return {x, stream.uniform(lower.y, upper.y)};
}

// A place on a route of several legs.
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

// A region and how many people begin in it.
struct RegionCrowd {
  std::uint32_t region = 0;
  std::size_t people = 0;
};

// The smallest first: where regions overlap, it has the least room to evade.
std::vector<RegionCrowd> crowds_by_region(const std::vector<Flow>& flows, const std::vector<Region>& regions) {
  std::map<std::uint32_t, std::size_t> people;
  for (const Flow& flow : flows)
    if (flow.start == FlowStart::from) people[flow.regions.front()] += flow.people;
  std::vector<RegionCrowd> crowds;
  for (const auto& [region, count] : people) crowds.push_back({region, count});
  const auto area = [&](const RegionCrowd& crowd) {
    const dmrp_vec2 extent = regions[crowd.region].upper - regions[crowd.region].lower;
    return extent.x * extent.y;
  };
  std::stable_sort(crowds.begin(), crowds.end(),
                   [&](const RegionCrowd& one, const RegionCrowd& two) { return area(one) < area(two); });
  return crowds;
}

}  // namespace

Population::Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry,
                       const FlowRoutes& routes, std::uint64_t seed, std::span<const dmrp_vec2> robots)
    : seed_(seed),
      settings_(scenario.people),
      regions_(scenario.regions),
      flows_(scenario.flows),
      geometry_(std::move(geometry)),
      tracks_(scenario.tracks),
      world_{scenario.lower, scenario.upper},
      slots_(walker_count(scenario)) {
  std::map<std::uint32_t, std::vector<dmrp_vec2>> places;
  std::vector<dmrp_vec2> taken;
  for (const Track& track : tracks_)
    if (is_on_track(track, 0)) taken.push_back(position_on(track, 0));
  for (const RegionCrowd& crowd : crowds_by_region(flows_, regions_)) {
    std::vector<dmrp_vec2>& found = places[crowd.region];
    found = places_in(crowd.region, crowd.people, robots, taken);
    taken.insert(taken.end(), found.begin(), found.end());
  }
  std::uint32_t slot = 0;
  for (std::uint32_t flow = 0; flow < flows_.size(); ++flow) {
    for (std::uint32_t number = 0; number < flows_[flow].people; ++number, ++slot) {
      Slot& own = slots_[slot];
      own.flow = flow;
      Beginning beginning;
      if (flows_[flow].start == FlowStart::from) {
        auto& left = places[flows_[flow].regions.front()];
        beginning.position = left.back();
        left.pop_back();
      } else {
        beginning = place_along_flow(slot, number, routes.legs[flow], robots, taken);
        taken.push_back(beginning.position);
      }
      own.leg = beginning.leg;
      people_.push_back(person_at(slot, beginning.position));
      slot_of_.push_back(slot);
    }
  }
  let_come(0);
}

void Population::move(std::size_t place, dmrp_vec2 position, dmrp_vec2 velocity) {
  people_[place].position = position;
  people_[place].velocity = velocity;
}

void Population::advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  let_leave(t_ns);
  let_come(t_ns);
  for (std::size_t place = 0; place < people_.size() && !is_recorded(place); ++place) {
    Slot& own = slots_[slot_of_[place]];
    const bool arrived = has_arrived(place);
    if (arrived && !is_on_last_leg(own)) {
      ++own.leg;
      set_target(people_[place], slot_of_[place]);
    } else if ((arrived || own.tries > 0) && t_ns >= own.next_try_ns) {
      try_to_begin_anew(place, t_ns, robots);
    }
  }
}

bool Population::has_arrived(std::size_t place) const {
  const dmrp_person& person = people_[place];
  return toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position);
}

bool Population::is_on_last_leg(const Slot& slot) const {
  return slot.leg + 2 == flows_[slot.flow].regions.size();
}

std::optional<dmrp_vec2> Population::position_on_track(std::size_t place, std::int64_t t_ns) const {
  if (!is_recorded(place)) return std::nullopt;
  return position_on(track_of(slot_of_[place]), t_ns);
}

bool Population::is_over(std::int64_t t_ns) const {
  return people_.empty() && std::none_of(tracks_.begin(), tracks_.end(),
                                         [&](const Track& track) { return track.points.front().t_ns > t_ns; });
}

// Recorded people who are not there yet.
void Population::let_come(std::int64_t t_ns) {
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    if (!is_on_track(tracks_[i], t_ns)) continue;
    const auto slot = static_cast<std::uint32_t>(slots_.size()) + i;
    const auto after = std::lower_bound(slot_of_.begin(), slot_of_.end(), slot);
    if (after != slot_of_.end() && *after == slot) continue;
    people_.insert(people_.begin() + (after - slot_of_.begin()), recorded_person_at(slot, t_ns));
    slot_of_.insert(after, slot);
  }
}

// Whoever wants to know where a recorded person is going gets the whole world as the place, which no way has to be found
// to, and the end of the track as the target.
dmrp_person Population::recorded_person_at(std::uint32_t slot, std::int64_t t_ns) const {
  const Track& track = track_of(slot);
  dmrp_person person{};
  person.id = slot;
  person.target_id = static_cast<std::uint32_t>(regions_.size());
  person.position = position_on(track, t_ns);
  person.velocity = velocity_on(track, t_ns);
  person.radius_m = settings_.radius_m;
  const double speed = mean_speed(track);
  person.desired_speed = speed > 0.0 ? speed : settings_.speed_mean;
  person.target = track.points.back().position;
  person.area_lower = world_.lower;
  person.area_upper = world_.upper;
  return person;
}

// For good.
void Population::let_leave(std::int64_t t_ns) {
  std::size_t kept = 0;
  for (std::size_t place = 0; place < people_.size(); ++place) {
    const std::uint32_t slot = slot_of_[place];
    const bool leaves = is_recorded(place)
                            ? !is_on_track(track_of(slot), t_ns)
                            : !flows_[slots_[slot].flow].respawn && is_on_last_leg(slots_[slot]) && has_arrived(place);
    if (leaves) continue;
    people_[kept] = people_[place];
    slot_of_[kept] = slot;
    ++kept;
  }
  people_.resize(kept);
  slot_of_.resize(kept);
}

// Places for all who begin in a region, in an order that says nothing.
std::vector<dmrp_vec2> Population::places_in(std::uint32_t region, std::size_t count, std::span<const dmrp_vec2> robots,
                                             std::span<const dmrp_vec2> taken) const {
  const Region& where = regions_[region];
  Stream stream(seed_, "population.from", region);
  const double apart_m = 2.0 * settings_.radius_m + personal_gap_m;
  auto places = spread_on_lattice({where.lower, where.upper}, count, apart_m, stream,
                                  [&](dmrp_vec2 point) { return has_room(point, robots, taken); });
  if (places.size() < count) {
    const auto blamed = std::find_if(flows_.begin(), flows_.end(), [&](const Flow& flow) {
      return flow.start == FlowStart::from && flow.regions.front() == region && flow.people > 0;
    });
    const auto others = std::count_if(taken.begin(), taken.end(), [&](dmrp_vec2 other) {
      return toolkit::contains(toolkit::Rectangle{where.lower, where.upper}, other);
    });
    throw NoRoom(static_cast<std::uint32_t>(blamed - flows_.begin()),
                 "no room in region '" + where.name + "' for " + std::to_string(count) + " people, for " +
                     std::to_string(places.size()) + " at most" +
                     (others > 0 ? " beside " + std::to_string(others) + " who are there already" : ""));
  }
  return places;
}

// Evenly along the whole route, each somewhere in a stretch of its own and somewhere aside of it.
Population::Beginning Population::place_along_flow(std::uint32_t slot, std::uint32_t number,
                                                   const std::vector<Route>& legs, std::span<const dmrp_vec2> robots,
                                                   std::span<const dmrp_vec2> taken) const {
  const Flow& flow = flows_[slots_[slot].flow];
  Stream stream(seed_, "population.begin", slot);
  for (int tries = 0; tries < tries_along_flow; ++tries) {
    const double fraction = (number + stream.uniform()) / flow.people;
    const double aside_m = stream.uniform(-lane_half_width_m, lane_half_width_m);
    const RoutePlace on_route = place_on(legs, fraction);
    const dmrp_vec2 left = toolkit::perpendicular(toolkit::from_angle(on_route.heading));
    const dmrp_vec2 point = on_route.point + aside_m * left;
    // not beyond a wall
    if (!has_room(point, robots, taken) || !geometry_->line_of_sight(on_route.point, point)) continue;
    return {point, on_route.leg};
  }
  for (int tries = 0; tries < tries_anywhere; ++tries) {
    const RoutePlace on_route = place_on(legs, stream.uniform());
    const dmrp_vec2 reach = {4.0 * lane_half_width_m, 4.0 * lane_half_width_m};
    const dmrp_vec2 point = draw_in(stream, on_route.point - reach, on_route.point + reach);
    if (!has_room(point, robots, taken) || !geometry_->line_of_sight(on_route.point, point)) continue;
    return {point, on_route.leg};
  }
  throw NoRoom(slots_[slot].flow, "no room along flow '" + flow.name + "' for " + std::to_string(flow.people) +
                                      " people, for " + std::to_string(number) + " at most");
}

// The person whom a slot has now, at the beginning.
dmrp_person Population::person_at(std::uint32_t slot, dmrp_vec2 position) const {
  const Slot& own = slots_[slot];
  dmrp_person person{};
  person.id = slot + own.predecessors * (slots_.size() + tracks_.size());
  person.position = position;
  person.radius_m = settings_.radius_m;
  Stream speeds(seed_, "population.speed", slot, own.predecessors);
  person.desired_speed =
      speeds.truncated_normal(settings_.speed_mean, settings_.speed_sd, settings_.speed_min, settings_.speed_max);
  set_target(person, slot);
  return person;
}

// Somewhere free in the region that the leg leads to; in its middle where nothing free was found.
void Population::set_target(dmrp_person& person, std::uint32_t slot) const {
  const Slot& own = slots_[slot];
  const std::uint32_t index = flows_[own.flow].regions[own.leg + 1];
  const Region& region = regions_[index];
  Stream stream(seed_, "population.target", slot, own.predecessors, own.leg);
  dmrp_vec2 target = draw_in(stream, region.lower, region.upper);
  int tries = 1;
  for (; tries < tries_in_region && !geometry_->disc_is_free(target, settings_.radius_m); ++tries)
    target = draw_in(stream, region.lower, region.upper);
  if (tries == tries_in_region) target = 0.5 * (region.lower + region.upper);

  person.target = target;
  person.target_id = index;
  person.area_lower = region.lower;
  person.area_upper = region.upper;
}

// Until there is room in the first region, the old person stays and walks on to its target.
void Population::try_to_begin_anew(std::size_t place, std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  const std::uint32_t slot = slot_of_[place];
  Slot& own = slots_[slot];
  const Region& first = regions_[flows_[own.flow].regions.front()];
  std::vector<dmrp_vec2> others;
  for (std::size_t other = 0; other < people_.size(); ++other)
    if (other != place) others.push_back(people_[other].position);
  Stream stream(seed_, "population.anew", slot, own.predecessors, own.tries);
  for (int tries = 0; tries < tries_in_region; ++tries) {
    const dmrp_vec2 point = draw_in(stream, first.lower, first.upper);
    if (!has_room(point, robots, others)) continue;
    ++own.predecessors;
    own.leg = 0;
    own.tries = 0;
    own.next_try_ns = 0;
    people_[place] = person_at(slot, point);
    return;
  }
  ++own.tries;
  own.next_try_ns = t_ns + retry_period_ns;
}

// Clear of shapes, robots and other people.
bool Population::has_room(dmrp_vec2 point, std::span<const dmrp_vec2> robots, std::span<const dmrp_vec2> taken) const {
  for (const dmrp_vec2 robot : robots)
    if (toolkit::distance(robot, point) < spawn_distance_to_robots_m) return false;
  const double apart_m = 2.0 * settings_.radius_m + personal_gap_m;
  for (const dmrp_vec2 other : taken)
    if (toolkit::distance(other, point) < apart_m) return false;
  return geometry_->disc_is_free(point, settings_.radius_m);
}

}  // namespace dmrp::core
