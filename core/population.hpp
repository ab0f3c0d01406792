// SPDX-License-Identifier: MIT
// population.hpp: who the people are, where they begin and where they want to go. How they walk is a model's matter.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/flow_routes.hpp"
#include "core/scenario.hpp"
#include "core/static_geometry.hpp"

namespace dmrp::core {

inline constexpr double spawn_distance_to_robots_m = 1.5;  // between centres

// A constant number of people, each in a slot. At t = 0 they are spread along their flows; who reaches the last region
// of its flow leaves, and somebody new begins in the slot, in the flow's first region.
//
// Every draw has a stream of its own, named by the seed, the slot and how many people the slot has seen. So the crowd is
// the same for all combinations of a seed, but for where people stand in each other's or a robot's way when they begin.
class Population {
 public:
  // `robots`: where the robots begin. Throws std::runtime_error if there is no room for everybody.
  Population(const Scenario& scenario, std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes,
             std::uint64_t seed, std::span<const dmrp_vec2> robots);

  // By slot. Ids are the slot, plus the number of slots for everyone who was there before.
  std::span<const dmrp_person> people() const { return people_; }

  // Where a person came to, and how.
  void move(std::uint32_t slot, dmrp_vec2 position, dmrp_vec2 velocity);

  // Next regions for those who reached theirs; new people for those who reached their last.
  void advance(std::int64_t t_ns, std::span<const dmrp_vec2> robots);

 private:
  struct Slot {
    std::uint32_t flow = 0;
    std::uint32_t leg = 0;           // walks from flow.regions[leg] to the next
    std::uint64_t predecessors = 0;  // people that this slot has seen before
    std::uint64_t tries = 0;         // to begin anew, after arrival
    std::int64_t next_try_ns = 0;
  };

  void place_along_flow(std::uint32_t slot, std::uint32_t place, const std::vector<Route>& legs,
                        std::span<const dmrp_vec2> robots);
  void begin(std::uint32_t slot, dmrp_vec2 position, std::uint32_t leg);
  void set_target(std::uint32_t slot);
  void try_to_begin_anew(std::uint32_t slot, std::int64_t t_ns, std::span<const dmrp_vec2> robots);
  bool has_room(std::uint32_t slot, std::uint32_t others, dmrp_vec2 point, std::span<const dmrp_vec2> robots) const;

  std::uint64_t seed_;
  PeopleSettings settings_;
  std::vector<Region> regions_;
  std::vector<Flow> flows_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<Slot> slots_;
  std::vector<dmrp_person> people_;
};

}  // namespace dmrp::core
