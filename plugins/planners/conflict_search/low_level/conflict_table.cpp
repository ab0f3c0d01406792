// SPDX-License-Identifier: MIT
#include "planners/conflict_search/low_level/conflict_table.hpp"

#include <cassert>
#include <limits>
#include <stdexcept>

namespace dmrp::planners {

ConflictTable::ConflictTable(const GridGraph& graph, std::size_t agent_count, std::int32_t expected_steps)
    : location_count_(static_cast<std::size_t>(graph.location_count())),
      next_(agent_count),
      resting_(location_count_, 0),
      resting_from_(location_count_, forever),
      paths_(agent_count) {
  if (agent_count >= std::numeric_limits<Link>::max()) throw std::length_error("more than 65534 robots");
  if (expected_steps > 0) grow(expected_steps + 1);
}

void ConflictTable::set(std::int32_t agent, PathView path) {
  const auto index = static_cast<std::size_t>(agent);
  if (paths_[index].data() == path.data() && paths_[index].size() == path.size()) return;
  take_out(agent);
  if (static_cast<std::int32_t>(path.size()) > horizon_) grow(static_cast<std::int32_t>(path.size()));
  paths_[index] = path;
  put_in(agent);
}

void ConflictTable::put_in(std::int32_t agent) {
  const PathView path = paths_[static_cast<std::size_t>(agent)];
  if (path.empty()) return;
  std::vector<Link>& next = next_[static_cast<std::size_t>(agent)];
  next.resize(path.size());
  for (std::int32_t t = 0; t <= cost_of(path); ++t) {
    const auto step = static_cast<std::size_t>(t);
    Link& first = first_with_space(path[step], t);
    next[step] = is_passed(path[step], t) ? first : Link{0};
    first = static_cast<Link>(agent + 1);
    passed_[word(path[step], t)] |= std::uint64_t{1} << (t % 64);
  }
  resting_[static_cast<std::size_t>(path.back())] = static_cast<Link>(agent + 1);
  resting_from_[static_cast<std::size_t>(path.back())] = cost_of(path);
}

void ConflictTable::take_out(std::int32_t agent) {
  const PathView path = paths_[static_cast<std::size_t>(agent)];
  if (path.empty()) return;
  for (std::int32_t t = 0; t <= cost_of(path); ++t) {
    const auto step = static_cast<std::size_t>(t);
    Link& first = first_with_space(path[step], t);
    Link* link = &first;
    while (*link != agent + 1) link = &next_[*link - 1u][step];
    *link = next_[static_cast<std::size_t>(agent)][step];
    if (first == 0) passed_[word(path[step], t)] &= ~(std::uint64_t{1} << (t % 64));
  }
  resting_[static_cast<std::size_t>(path.back())] = 0;
  resting_from_[static_cast<std::size_t>(path.back())] = forever;
  paths_[static_cast<std::size_t>(agent)] = {};
}

void ConflictTable::grow(std::int32_t horizon) {
  horizon_ = std::max(2 * horizon_, (horizon + 63) / 64 * 64);
  passed_.assign(location_count_ * static_cast<std::size_t>(horizon_) / 64, 0);
  block_.assign(passed_.size(), 0);
  first_.assign(64, 0);
  for (std::size_t agent = 0; agent < paths_.size(); ++agent) put_in(static_cast<std::int32_t>(agent));
}

ConflictTable::Link& ConflictTable::first_with_space(Location location, std::int32_t t) {
  std::uint32_t& block = block_[word(location, t)];
  if (block == 0) {
    block = static_cast<std::uint32_t>(first_.size() / 64);
    first_.resize(first_.size() + 64);
  }
  return first_[std::size_t{block} * 64 + static_cast<std::size_t>(t % 64)];
}

std::int32_t ConflictTable::rest_from() const {
  std::int32_t from = 0;
  for (const PathView path : paths_) from = std::max(from, cost_of(path));
  return from;
}

std::int32_t ConflictTable::count_after(Location location, std::int32_t t) const {
  std::int32_t count = 0;
  for (t = next_passed(location, t + 1); t != forever; t = next_passed(location, t + 1))
    visit_passing(location, t, [&](std::int32_t) { ++count; });
  return count;
}

void ConflictTable::list(std::int32_t agent, PathView path, std::vector<Conflict>& out) const {
  assert(this->path(agent).empty());
  const auto add = [&](std::int32_t other, Location from, Location to, bool swap, std::int32_t t) {
    if (agent < other)
      out.push_back({agent, other, to, swap ? from : nowhere, t});
    else
      out.push_back({other, agent, swap ? from : to, swap ? to : nowhere, t});
  };
  const std::int32_t cost = cost_of(path);
  for (std::int32_t t = 0; t <= cost; ++t) {
    const Location to = path[static_cast<std::size_t>(t)];
    const Location from = t == 0 ? to : path[static_cast<std::size_t>(t - 1)];
    visit_at(from, to, t, [&](std::int32_t other, bool swap) { add(other, from, to, swap, t); });
  }
  for (std::int32_t t = next_passed(path.back(), cost + 1); t != forever; t = next_passed(path.back(), t + 1))
    visit_passing(path.back(), t, [&](std::int32_t other) { add(other, path.back(), path.back(), false, t); });
}

}  // namespace dmrp::planners
