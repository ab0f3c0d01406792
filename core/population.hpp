// SPDX-License-Identifier: MIT
// population.hpp: who the people are, where they begin and where they want to go. How they walk is a model's matter.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/flow_routes.hpp"
#include "core/scenario.hpp"
#include "core/static_geometry.hpp"

namespace dmrp::core {

inline constexpr double spawn_distance_to_robots_m = 1.5;  // between centres
inline constexpr double personal_gap_m = 0.05;             // between the bodies of two who begin

// Somebody of a flow found no place at t = 0.
struct NoRoom : std::runtime_error {
  NoRoom(std::uint32_t index, const std::string& text) : std::runtime_error(text), flow(index) {}
  std::uint32_t flow;  // index into Scenario::flows
};

// People, each in a slot. Who reaches the last region of its flow leaves: either somebody new begins in the slot, in the
// flow's first region, or the slot stays empty for good.
//
// Every draw has a stream of its own, named by the seed, the slot and how many people the slot has seen. So the crowd is
// the same for all combinations of a seed, but for where people stand in each other's or a robot's way when they begin.
// (A flow that starts in its first region is put there on a jittered hexagonal lattice, for densities that people drawn
// one by one do not reach; all flows that start in the same region together.)
//
// Recorded people come and leave with their tracks, in the slots after those of the flows.
class Population {
 public:
  // `robots`: where nobody begins within spawn_distance_to_robots_m. Throws NoRoom if there is none for everybody.
  Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes,
             std::uint64_t seed, std::span<const dmrp_vec2> robots);

  // All who are there, by slot. Ids are the slot, plus the number of slots for everyone who was there before.
  std::span<const dmrp_person> people() const { return people_; }

  // Where the person at this place of people() came to, and how.
  void move(std::size_t place, dmrp_vec2 position, dmrp_vec2 velocity);

  bool is_recorded(std::size_t place) const { return slot_of_[place] >= slots_.size(); }

  // Where a recorded person goes until then; nothing for others.
  std::optional<dmrp_vec2> position_on_track(std::size_t place, std::int64_t t_ns) const;

  // Nobody is there, nor will anybody come.
  bool is_over(std::int64_t t_ns) const;

  // Next regions for those who reached theirs; who reached its last leaves; recorded people come and leave.
  void advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots);

 private:
  struct Slot {
    std::uint32_t flow = 0;
    std::uint32_t leg = 0;           // walks from flow.regions[leg] to the next
    std::uint64_t predecessors = 0;  // people that this slot has seen before
    std::uint64_t tries = 0;         // to begin anew, after arrival
    std::int64_t next_try_ns = 0;
  };

  // Somewhere a person begins, and the leg of its flow that leads on from there.
  struct Beginning {
    dmrp_vec2 position{};
    std::uint32_t leg = 0;
  };

  std::vector<dmrp_vec2> places_in(std::uint32_t region, std::size_t count, std::span<const dmrp_vec2> robots,
                                   std::span<const dmrp_vec2> taken) const;
  Beginning place_along_flow(std::uint32_t slot, std::uint32_t number, const std::vector<Route>& legs,
                             std::span<const dmrp_vec2> robots, std::span<const dmrp_vec2> taken) const;
  dmrp_person person_at(std::uint32_t slot, dmrp_vec2 position) const;
  void set_target(dmrp_person& person, std::uint32_t slot) const;
  dmrp_person recorded_person_at(std::uint32_t slot, std::int64_t t_ns) const;
  const Track& track_of(std::uint32_t slot) const { return tracks_[slot - slots_.size()]; }
  void let_come(std::int64_t t_ns);
  bool has_arrived(std::size_t place) const;
  bool is_on_last_leg(const Slot& slot) const;
  void let_leave(std::int64_t t_ns);
  void try_to_begin_anew(std::size_t place, std::int64_t t_ns, std::span<const dmrp_vec2> robots);
  bool has_room(dmrp_vec2 point, std::span<const dmrp_vec2> robots, std::span<const dmrp_vec2> taken) const;

  std::uint64_t seed_;
  PeopleSettings settings_;
  std::vector<Region> regions_;
  std::vector<Flow> flows_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<Track> tracks_;
  toolkit::Rectangle world_;
  std::vector<Slot> slots_;  // of the flows
  std::vector<dmrp_person> people_;
  std::vector<std::uint32_t> slot_of_;  // parallel to people_, ascending
};

}  // namespace dmrp::core
