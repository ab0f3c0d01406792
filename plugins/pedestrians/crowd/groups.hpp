// SPDX-License-Identifier: MIT
// The members of each walking group.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <vector>

namespace dmrp::pedestrians {

class Groups {
 public:
  void start() { group_of_slot_.clear(); }

  // Call once a step. Sorts people into their groups again when any group has changed.
  void update(const Span<Person>& people);

  // The slots of all members of this person's group, the person included, in ascending order. Empty for people who
  // walk alone.
  Span<std::uint32_t> members(std::uint32_t slot) const;

 private:
  struct Run {
    std::uint32_t begin;  // in members_
    std::uint32_t count;
  };

  void sort();

  std::vector<std::uint32_t> group_of_slot_;
  std::vector<std::uint32_t> members_;  // slots, group by group
  std::vector<Run> run_of_slot_;
};

}  // namespace dmrp::pedestrians
