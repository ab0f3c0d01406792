// SPDX-License-Identifier: MIT
#include "planners/ecbs8/constraint.hpp"

#include <algorithm>

namespace dmrp::planners::ecbs8 {

ConstraintTable::ConstraintTable(const Graph& graph)
    : graph_(graph),
      epoch_of_(static_cast<std::size_t>(graph.location_count()), 0),
      first_(static_cast<std::size_t>(graph.location_count())) {}

void ConstraintTable::fill(const std::vector<Constraint>& constraints) {
  ++epoch_;
  entries_.clear();
  closed_for_good_.clear();
  static_from_ = 0;
  end_from_ = 0;
  for (const Constraint& constraint : constraints) {
    // A touch also forbids passing in the step after it.
    static_from_ = std::max(static_from_, constraint.until >= forever ? constraint.from : constraint.until + 2);
    if (constraint.use == Constraint::Use::end) {
      end_from_ = std::max(end_from_, constraint.until + 1);
      continue;
    }
    if (constraint.until >= forever) closed_for_good_.push_back(constraint);
    const auto at = static_cast<std::size_t>(constraint.location);
    entries_.push_back({constraint, epoch_of_[at] == epoch_ ? first_[at] : -1});
    first_[at] = static_cast<std::int32_t>(entries_.size()) - 1;
    epoch_of_[at] = epoch_;
  }
}

template <class Test>
bool ConstraintTable::any_entry(Location location, Test test) const {
  if (!has_entries(location)) return false;
  for (std::int32_t i = first_[static_cast<std::size_t>(location)]; i >= 0;
       i = entries_[static_cast<std::size_t>(i)].next)
    if (test(entries_[static_cast<std::size_t>(i)].constraint)) return true;
  return false;
}

bool ConstraintTable::forbids_being(Location location, std::int32_t t) const {
  return any_entry(location, [t](const Constraint& c) {
    return (c.use == Constraint::Use::at || c.use == Constraint::Use::touch) && c.from <= t && t <= c.until;
  });
}

bool ConstraintTable::forbids_passing(Location location, std::int32_t t) const {
  return any_entry(location, [t](const Constraint& c) {
    return c.use == Constraint::Use::touch && c.from <= t && t <= c.until + 1;
  });
}

bool ConstraintTable::forbids_edge(Location location, Location other, std::int32_t t) const {
  return any_entry(location, [other, t](const Constraint& c) {
    return c.use == Constraint::Use::edge && c.other == other && c.from <= t && t <= c.until;
  });
}

bool ConstraintTable::forbids_corner(Location location, std::int32_t t) const {
  return any_entry(
      location, [t](const Constraint& c) { return c.use == Constraint::Use::corner && c.from <= t && t <= c.until; });
}

bool ConstraintTable::allows(Location from, Location to, Direction d, std::int32_t t) const {
  if (forbids_being(to, t)) return false;
  if (d == Graph::no_direction) return true;
  if (!Graph::is_diagonal(d)) return !forbids_edge(std::min(from, to), std::max(from, to), t);
  const std::array<Location, 2> beside = graph_.beside(from, d);
  return !forbids_passing(beside[0], t) && !forbids_passing(beside[1], t) &&
         !forbids_corner(std::min({from, to, beside[0], beside[1]}), t);
}

std::int32_t ConstraintTable::rest_from(Location last_goal) const {
  std::int32_t from = end_from_;
  any_entry(last_goal, [&](const Constraint& c) {
    if (c.use == Constraint::Use::at || c.use == Constraint::Use::touch) from = std::max(from, c.until + 1);
    return false;
  });
  return from;
}

}  // namespace dmrp::planners::ecbs8
