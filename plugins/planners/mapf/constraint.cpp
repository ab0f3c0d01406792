// SPDX-License-Identifier: MIT
#include "constraint.hpp"

#include <algorithm>

namespace dmrp::planners {

ConstraintTable::ConstraintTable(const GridGraph& graph)
    : epoch_of_(static_cast<std::size_t>(graph.location_count()), 0),
      first_(static_cast<std::size_t>(graph.location_count()), -1) {}

void ConstraintTable::fill(const std::vector<Constraint>& constraints) {
  ++epoch_;
  entries_.clear();
  free_from_ = 0;
  for (const Constraint& constraint : constraints) {
    const auto location = static_cast<std::size_t>(constraint.location);
    const std::int32_t next = epoch_of_[location] == epoch_ ? first_[location] : -1;
    epoch_of_[location] = epoch_;
    first_[location] = static_cast<std::int32_t>(entries_.size());
    entries_.push_back({constraint.from, constraint.t, next});
    free_from_ = std::max(free_from_, constraint.t + 1);
  }
}

std::int32_t ConstraintTable::rest_from(Location location) const {
  std::int32_t from = 0;
  if (epoch_of_[static_cast<std::size_t>(location)] != epoch_) return from;
  for (std::int32_t i = first_[static_cast<std::size_t>(location)]; i >= 0;) {
    const Entry& entry = entries_[static_cast<std::size_t>(i)];
    if (entry.from == nowhere) from = std::max(from, entry.t + 1);
    i = entry.next;
  }
  return from;
}

}  // namespace dmrp::planners
