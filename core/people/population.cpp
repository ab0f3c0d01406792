// SPDX-License-Identifier: MIT
#include "core/people/population.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>

#include "core/people/first_places.hpp"

namespace dmrp::core {
namespace {

using toolkit::Stream;

constexpr int tries_in_region = 32;
constexpr std::int64_t retry_period_ns = 500'000'000;

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
  assert(routes.legs.size() == flows_.size());
  for (const std::vector<Route>& legs : routes.legs) {
    std::vector<LegHeadings>& headings = headings_.emplace_back();
    for (const Route& leg : legs) {
      const std::vector<double> arcs = toolkit::arc_lengths(leg);
      headings.push_back({toolkit::heading_at(leg, arcs, 0.0, 0.0), toolkit::heading_at(leg, arcs, arcs.back(), 0.0)});
    }
  }
  std::vector<dmrp_vec2> recorded;
  for (const Track& track : tracks_)
    if (is_on_track(track, 0)) recorded.push_back(position_on(track, 0));
  const auto places = first_places(scenario, routes, {*geometry_, settings_.radius_m, robots, recorded}, seed);
  for (const WalkingGroup& who : divide_into_groups(flows_)) {
    group_ids_ = std::max(group_ids_, who.id);
    groups_.push_back({who, who.size});
    for (std::uint32_t slot = who.first_slot; slot < who.first_slot + who.size; ++slot) {
      slots_[slot] = {static_cast<std::uint32_t>(groups_.size() - 1), places[slot].leg};
      people_.push_back(person_at(slot, places[slot].position));
      slot_of_.push_back(slot);
    }
  }
  add_recorded_people(0);
}

void Population::move(std::size_t place, dmrp_vec2 position, dmrp_vec2 velocity) {
  assert(place < people_.size() && toolkit::is_finite(position) && toolkit::is_finite(velocity));
  people_[place].position = position;
  people_[place].velocity = velocity;
}

void Population::advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  remove_departed(t_ns);
  add_recorded_people(t_ns);
  for (std::size_t place = 0; place < people_.size() && !is_recorded(place); ++place) {
    Slot& own = slots_[slot_of_[place]];
    Group& group = groups_[own.group];
    const bool arrived = has_arrived(place);
    if (arrived && !is_on_last_leg(own)) {
      ++own.leg;
      set_target(people_[place], slot_of_[place]);
    } else if ((arrived || group.tries > 0) && group.who.size == 1 && t_ns >= group.next_try_ns) {
      try_to_respawn(group, t_ns, robots);
    }
  }
  respawn_groups(t_ns, robots);
}

bool Population::has_arrived(std::size_t place) const {
  const dmrp_person& person = people_[place];
  return toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position);
}

bool Population::is_on_last_leg(const Slot& slot) const {
  return slot.leg + 2 == flow_of(slot).regions.size();
}

std::optional<dmrp_vec2> Population::position_on_track(std::size_t place, std::int64_t t_ns) const {
  if (!is_recorded(place)) return std::nullopt;
  return position_on(track_of(slot_of_[place]), t_ns);
}

bool Population::is_over(std::int64_t t_ns) const {
  return people_.empty() &&
         std::none_of(flows_.begin(), flows_.end(), [](const Flow& flow) { return flow.respawn && flow.people > 0; }) &&
         std::none_of(tracks_.begin(), tracks_.end(),
                      [&](const Track& track) { return track.points.front().t_ns > t_ns; });
}

// Adds recorded people whose tracks have begun.
void Population::add_recorded_people(std::int64_t t_ns) {
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    if (!is_on_track(tracks_[i], t_ns)) continue;
    const auto slot = static_cast<std::uint32_t>(slots_.size()) + i;
    if (!std::binary_search(slot_of_.begin(), slot_of_.end(), slot)) put(slot, recorded_person_at(slot, t_ns));
  }
}

// Replaces the person in the slot, if any.
void Population::put(std::uint32_t slot, const dmrp_person& person) {
  const auto at = std::lower_bound(slot_of_.begin(), slot_of_.end(), slot);
  const auto place = people_.begin() + (at - slot_of_.begin());
  if (at != slot_of_.end() && *at == slot) {
    *place = person;
  } else {
    people_.insert(place, person);
    slot_of_.insert(at, slot);
  }
}

// The target of a recorded person is the end of the track. The target area is the whole world, so that models do not
// compute a way to it.
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

// A person who walks alone and will respawn leaves only when there is room for the new one.
bool Population::leaves(std::size_t place, std::int64_t t_ns) const {
  const std::uint32_t slot = slot_of_[place];
  if (is_recorded(place)) return !is_on_track(track_of(slot), t_ns);
  const Slot& own = slots_[slot];
  return is_on_last_leg(own) && (!flow_of(own).respawn || groups_[own.group].who.size > 1) && has_arrived(place);
}

void Population::remove_departed(std::int64_t t_ns) {
  std::size_t kept = 0;
  for (std::size_t place = 0; place < people_.size(); ++place) {
    const std::uint32_t slot = slot_of_[place];
    if (leaves(place, t_ns)) {
      if (!is_recorded(place)) --groups_[slots_[slot].group].present;
      continue;
    }
    people_[kept] = people_[place];
    slot_of_[kept] = slot;
    ++kept;
  }
  people_.resize(kept);
  slot_of_.resize(kept);
}

// The new person of a slot. All members of a group have the same desired speed.
dmrp_person Population::person_at(std::uint32_t slot, dmrp_vec2 position) const {
  const Group& group = groups_[slots_[slot].group];
  dmrp_person person{};
  person.id = slot + group.generation * (slots_.size() + tracks_.size());
  if (group.who.id != 0) person.group = static_cast<std::uint32_t>(group.who.id + group.generation * group_ids_);
  person.position = position;
  person.radius_m = settings_.radius_m;
  person.reaction = flows_[group.who.flow].reaction;
  Stream speeds(seed_, "population.speed", group.who.first_slot, group.generation);
  person.desired_speed =
      speeds.truncated_normal(settings_.speed_mean, settings_.speed_sd, settings_.speed_min, settings_.speed_max);
  set_target(person, slot);
  return person;
}

// A random free position in the leg's target region, beside those of the other members. The region's centre if none was
// found.
void Population::set_target(dmrp_person& person, std::uint32_t slot) const {
  const Slot& own = slots_[slot];
  const Group& group = groups_[own.group];
  const std::uint32_t index = flow_of(own).regions[own.leg + 1];
  const Region& region = regions_[index];
  const toolkit::Rectangle area = {region.lower, region.upper};
  const auto offsets = formation(group.who.size, widest_row(group.who.size), 2.0 * settings_.radius_m + group_gap_m,
                                 headings_[group.who.flow][own.leg].at_end);
  const toolkit::Rectangle middles = middles_in(area, offsets);
  const auto is_free = [&](dmrp_vec2 middle) {
    return std::all_of(offsets.begin(), offsets.end(), [&](dmrp_vec2 offset) {
      return geometry_->disc_is_free(toolkit::closest_point(area, middle + offset), settings_.radius_m);
    });
  };
  Stream stream(seed_, "population.target", group.who.first_slot, group.generation, own.leg);
  dmrp_vec2 middle = draw_in(middles, stream);
  int tries = 1;
  for (; tries < tries_in_region && !is_free(middle); ++tries) middle = draw_in(middles, stream);
  if (tries == tries_in_region) middle = middle_of(region);

  person.target = toolkit::closest_point(area, middle + offsets[slot - group.who.first_slot]);
  person.target_id = index;
  person.area_lower = region.lower;
  person.area_upper = region.upper;
}

void Population::respawn_groups(std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  for (Group& group : groups_)
    if (group.who.size > 1 && group.present == 0 && flows_[group.who.flow].respawn && t_ns >= group.next_try_ns)
      try_to_respawn(group, t_ns, robots);
}

// Places the group in the first region, side by side if possible. Until there is room, a person who walks alone stays
// and walks on to the target; a group of several has left the world.
void Population::try_to_respawn(Group& group, std::int64_t t_ns, std::span<const dmrp_vec2> robots) {
  const WalkingGroup& who = group.who;
  const Region& region = regions_[flows_[who.flow].regions.front()];
  const toolkit::Rectangle area = {region.lower, region.upper};
  std::vector<dmrp_vec2> others;
  for (std::size_t other = 0; other < people_.size(); ++other)
    if (is_recorded(other) || slots_[slot_of_[other]].group != slots_[who.first_slot].group)
      others.push_back(people_[other].position);
  const StandingRoom room = {*geometry_, settings_.radius_m, robots, others};
  Stream stream(seed_, "population.anew", who.first_slot, group.generation, group.tries);
  const auto places = draw_places(room, area, headings_[who.flow].front().at_beginning, who.size, stream);
  if (!places) {
    ++group.tries;
    group.next_try_ns = t_ns + retry_period_ns;
    return;
  }
  group.present = who.size;
  ++group.generation;
  group.tries = 0;
  group.next_try_ns = 0;
  for (std::uint32_t member = 0; member < who.size; ++member) {
    const std::uint32_t slot = who.first_slot + member;
    slots_[slot].leg = 0;
    put(slot, person_at(slot, (*places)[member]));
  }
}

}  // namespace dmrp::core
