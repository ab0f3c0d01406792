// SPDX-License-Identifier: MIT
// population.hpp: who the people are, where they begin and where they want to go. How they walk is a model's matter.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/scenario.hpp"
#include "core/static_geometry.hpp"

namespace dmrp::core {

inline constexpr double spawn_distance_to_robots_m = 1.5;

// A constant number of people, each in a slot. At t = 0 they are spread along their flows; who reaches the last region
// of its flow leaves, and somebody new begins in the slot, in the flow's first region.
//
// Every draw has a stream of its own, named by the seed, the slot and how many people the slot has seen. So the crowd is
// the same for all combinations of a seed, but for where people stand in each other's or a robot's way when they begin.
class Population {
 public:
  // `robots`: where the robots begin.
  Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry, std::uint64_t seed,
             std::span<const dmrp_vec2> robots);

  std::span<const dmrp_person> people() const { return people_; }

  // Where a person came to, and how.
  void move(std::uint32_t slot, dmrp_vec2 position, dmrp_vec2 velocity);

  // Next regions for those who reached theirs; new people for those who reached their last.
  void advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots);

 private:
  struct Slot {
    std::uint32_t flow = 0;
    std::uint32_t leg = 1;         // walks to flow.regions[leg]
    std::uint64_t generation = 0;  // people that this slot has seen before
    std::uint64_t tries = 0;       // to replace somebody who has arrived
    std::int64_t next_try_ns = 0;
  };

  void begin_life(std::uint32_t slot, dmrp_vec2 position, std::uint32_t leg);
  void set_target(std::uint32_t slot);
  void place_along_flow(std::uint32_t slot, std::uint32_t place_in_flow, std::span<const dmrp_vec2> robots);
  bool try_to_respawn(std::uint32_t slot, std::span<const dmrp_vec2> robots);
  bool is_free_for(std::uint32_t slot, std::uint32_t others, dmrp_vec2 point, std::span<const dmrp_vec2> robots) const;
  dmrp_vec2 point_in(std::uint32_t region, std::uint32_t slot, std::uint32_t leg) const;

  std::uint64_t seed_;
  PeopleSettings settings_;
  std::vector<Region> regions_;
  std::vector<Flow> flows_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<Slot> slots_;
  std::vector<dmrp_person> people_;
};

}  // namespace dmrp::core
