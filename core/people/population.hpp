// SPDX-License-Identifier: MIT
// population.hpp: the people of a trial: their properties, first positions and targets. Pedestrian models move them.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/people/walking_groups.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// Each person has a slot. A person who reaches the last region of its flow leaves; then either a new person appears in
// the slot, in the flow's first region, or the slot stays empty. The members of a group leave one by one as they
// arrive; when all have left, the next group appears.
//
// Every random draw has its own stream, identified by the seed, the slot (the first slot of a group for common
// properties) and the number of people that the slot had before. So the crowd is the same for all combinations with the
// same seed, except for positions that other people or robots block at the time.
//
// Recorded people appear and leave with their tracks, in the slots after those of the flows.
class Population {
 public:
  // People keep spawn_distance_to_robots_m from `robots`. Throws NoRoom if there is no room for everybody.
  Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes,
             std::uint64_t seed, std::span<const dmrp_vec2> robots);

  // All people present, by slot. The id of the n-th person of a slot (from 0) is the slot plus n times the number of
  // slots; ids of groups follow the same rule.
  std::span<const dmrp_person> people() const { return people_; }

  // Sets position and velocity of people()[place].
  void move(std::size_t place, dmrp_vec2 position, dmrp_vec2 velocity);

  bool is_recorded(std::size_t place) const { return slot_of_[place] >= slots_.size(); }

  // The position of a recorded person at t_ns; nothing for other people.
  std::optional<dmrp_vec2> position_on_track(std::size_t place, std::int64_t t_ns) const;

  // Nobody is present, and nobody will appear.
  bool is_over(std::int64_t t_ns) const;

  // Gives people who reached a region their next one, removes people who reached their last one, and adds and removes
  // recorded people.
  void advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots);

 private:
  struct Slot {
    std::uint32_t group = 0;  // in groups_
    std::uint32_t leg = 0;    // walks from flow.regions[leg] to the next
  };

  struct Group {
    WalkingGroup who;
    std::uint32_t present = 0;
    std::uint64_t generation = 0;  // groups that its slots had before
    std::uint64_t tries = 0;       // to respawn, after arrival
    std::int64_t next_try_ns = 0;
  };

  // The headings at both ends of a leg.
  struct LegHeadings {
    double at_beginning = 0.0;
    double at_end = 0.0;
  };

  const Flow& flow_of(const Slot& slot) const { return flows_[groups_[slot.group].who.flow]; }
  dmrp_person person_at(std::uint32_t slot, dmrp_vec2 position) const;
  void set_target(dmrp_person& person, std::uint32_t slot) const;
  dmrp_person recorded_person_at(std::uint32_t slot, std::int64_t t_ns) const;
  const Track& track_of(std::uint32_t slot) const { return tracks_[slot - slots_.size()]; }
  void put(std::uint32_t slot, const dmrp_person& person);
  void add_recorded_people(std::int64_t t_ns);
  bool has_arrived(std::size_t place) const;
  bool is_on_last_leg(const Slot& slot) const;
  bool leaves(std::size_t place, std::int64_t t_ns) const;
  void remove_departed(std::int64_t t_ns);
  void respawn_groups(std::int64_t t_ns, std::span<const dmrp_vec2> robots);
  void try_to_respawn(Group& group, std::int64_t t_ns, std::span<const dmrp_vec2> robots);

  std::uint64_t seed_;
  PeopleSettings settings_;
  std::vector<Region> regions_;
  std::vector<Flow> flows_;
  std::vector<std::vector<LegHeadings>> headings_;  // by flow and leg
  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<Track> tracks_;
  toolkit::Rectangle world_;
  std::vector<Group> groups_;
  std::uint32_t group_ids_ = 0;  // groups of two or more
  std::vector<Slot> slots_;      // of the flows
  std::vector<dmrp_person> people_;
  std::vector<std::uint32_t> slot_of_;  // parallel to people_, ascending
};

}  // namespace dmrp::core
