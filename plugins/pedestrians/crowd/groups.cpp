// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/groups.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::pedestrians {

void Groups::update(const Span<Person>& people) {
  bool changed = group_of_slot_.size() != people.size();
  group_of_slot_.resize(people.size());
  for (std::size_t slot = 0; slot < people.size(); ++slot) {
    changed = changed || group_of_slot_[slot] != people[slot].group;
    group_of_slot_[slot] = people[slot].group;
  }
  if (changed) sort();
}

Span<std::uint32_t> Groups::members(std::uint32_t slot) const {
  assert(slot < run_of_slot_.size());
  const Run run = run_of_slot_[slot];
  return {members_.data() + run.begin, run.count};
}

void Groups::sort() {
  members_.clear();
  for (std::uint32_t slot = 0; slot < group_of_slot_.size(); ++slot)
    if (group_of_slot_[slot] != 0) members_.push_back(slot);
  std::stable_sort(members_.begin(), members_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return group_of_slot_[a] < group_of_slot_[b]; });

  run_of_slot_.assign(group_of_slot_.size(), {0, 0});
  for (std::uint32_t begin = 0, end = 0; begin < members_.size(); begin = end) {
    while (end < members_.size() && group_of_slot_[members_[end]] == group_of_slot_[members_[begin]]) ++end;
    for (std::uint32_t i = begin; i < end; ++i) run_of_slot_[members_[i]] = {begin, end - begin};
  }
}

}  // namespace dmrp::pedestrians
