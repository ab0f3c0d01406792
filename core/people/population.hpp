// SPDX-License-Identifier: MIT
// population.hpp: who the people are, where they begin and where they want to go. How they walk is a model's matter.
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

// People, each in a slot. Who reaches the last region of its flow leaves: either somebody new begins in the slot, in the
// flow's first region, or the slot stays empty for good. The people of a group leave one by one, as they arrive; when
// all have left, the next group begins, together.
//
// Every draw has a stream of its own, named by the seed, the slot (the first one of a group for what is the group's) and
// how many people the slot has seen. So the crowd is the same for all combinations of a seed, but for where people stand
// in each other's or a robot's way when they begin.
//
// Recorded people come and leave with their tracks, in the slots after those of the flows.
class Population {
 public:
  // `robots`: where nobody begins within spawn_distance_to_robots_m. Throws NoRoom if there is none for everybody.
  Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes,
             std::uint64_t seed, std::span<const dmrp_vec2> robots);

  // All who are there, by slot. Ids are the slot, plus the number of slots for everyone who was there before; likewise
  // those of groups.
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
    std::uint32_t group = 0;  // in groups_
    std::uint32_t leg = 0;    // walks from flow.regions[leg] to the next
  };

  struct Group {
    WalkingGroup who;
    std::uint32_t present = 0;
    std::uint64_t predecessors = 0;  // groups that its slots have seen before
    std::uint64_t tries = 0;         // to begin anew, after arrival
    std::int64_t next_try_ns = 0;
  };

  // Which way people walk.
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
  void let_come(std::int64_t t_ns);
  bool has_arrived(std::size_t place) const;
  bool is_on_last_leg(const Slot& slot) const;
  bool leaves(std::size_t place, std::int64_t t_ns) const;
  void let_leave(std::int64_t t_ns);
  void let_groups_begin_anew(std::int64_t t_ns, std::span<const dmrp_vec2> robots);
  void try_to_begin_anew(Group& group, std::int64_t t_ns, std::span<const dmrp_vec2> robots);

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
