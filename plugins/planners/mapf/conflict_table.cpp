// SPDX-License-Identifier: MIT
#include "conflict_table.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace dmrp::planners {

ConflictTable::ConflictTable(const GridGraph& graph, std::size_t agent_count)
    : location_count_(static_cast<std::size_t>(graph.location_count())),
      next_(agent_count),
      resting_(location_count_, 0),
      resting_from_(location_count_, std::numeric_limits<std::int32_t>::max()),
      paths_(agent_count) {
  if (agent_count >= std::numeric_limits<Link>::max()) throw std::length_error("more than 65534 robots");
}

void ConflictTable::set(std::int32_t agent, PathView path) {
  const auto who = static_cast<std::size_t>(agent);
  if (paths_[who].data() == path.data() && paths_[who].size() == path.size()) return;
  take_out(agent);
  paths_[who] = path;
  if (path.empty()) return;
  if (static_cast<std::int32_t>(path.size()) > row_count_) {
    row_count_ = static_cast<std::int32_t>(path.size());
    first_.resize(static_cast<std::size_t>(row_count_) * location_count_, 0);
  }
  next_[who].resize(path.size());
  for (std::size_t t = 0; t < path.size(); ++t) {
    Link& first = first_[cell(path[t], static_cast<std::int32_t>(t))];
    next_[who][t] = first;
    first = static_cast<Link>(agent + 1);
  }
  resting_[static_cast<std::size_t>(path.back())] = static_cast<Link>(agent + 1);
  resting_from_[static_cast<std::size_t>(path.back())] = cost_of(path);
}

void ConflictTable::take_out(std::int32_t agent) {
  const PathView path = paths_[static_cast<std::size_t>(agent)];
  if (path.empty()) return;
  for (std::size_t t = 0; t < path.size(); ++t) {
    Link* link = &first_[cell(path[t], static_cast<std::int32_t>(t))];
    while (*link != agent + 1) link = &next_[*link - 1u][t];
    *link = next_[static_cast<std::size_t>(agent)][t];
  }
  resting_[static_cast<std::size_t>(path.back())] = 0;
  resting_from_[static_cast<std::size_t>(path.back())] = std::numeric_limits<std::int32_t>::max();
}

std::int32_t ConflictTable::rest_from() const {
  std::int32_t from = 0;
  for (const PathView path : paths_) from = std::max(from, cost_of(path));
  return from;
}

std::int32_t ConflictTable::count_after(Location location, std::int32_t t) const {
  std::int32_t count = 0;
  for (std::int32_t later = t + 1; later < row_count_; ++later)
    visit_occupants(location, later, [&](std::int32_t) { ++count; });
  return count;
}

void ConflictTable::list(std::int32_t agent, PathView path, std::vector<Conflict>& out) const {
  const auto add = [&](std::int32_t other, Location from, Location to, bool swap, std::int32_t t) {
    if (agent < other)
      out.push_back({agent, other, to, swap ? from : nowhere, t});
    else
      out.push_back({other, agent, swap ? from : to, swap ? to : nowhere, t});
  };
  const auto length = static_cast<std::int32_t>(path.size());
  for (std::int32_t t = 0; t < length; ++t) {
    const Location to = path[static_cast<std::size_t>(t)];
    const Location from = t == 0 ? to : path[static_cast<std::size_t>(t - 1)];
    visit_at(from, to, t, [&](std::int32_t other, bool swap) { add(other, from, to, swap, t); });
  }
  for (std::int32_t t = length; t < row_count_; ++t)
    visit_occupants(path.back(), t, [&](std::int32_t other) { add(other, path.back(), path.back(), false, t); });
}

}  // namespace dmrp::planners
