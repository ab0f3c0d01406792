// SPDX-License-Identifier: MIT
// Who walks together.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <vector>

namespace dmrp::pedestrians {

class Groups {
 public:
  void start() { group_of_slot_.clear(); }

  // Call once a step: sorts people into their groups anew where any group has changed.
  void update(const Span<Person>& people);

  // The slots of all who walk with the person in this slot, ascending, their own too; empty for who walks alone.
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
