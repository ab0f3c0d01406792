// SPDX-License-Identifier: MIT
#include "planners/mapf/safe_intervals.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::planners {

namespace {

// Calls visit(location, from, to) for each stay of a path. The last one lasts forever.
template <class Visit>
void visit_stays(PathView path, Visit visit) {
  std::size_t from = 0;
  for (std::size_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[from]) continue;
    visit(path[from], static_cast<std::int32_t>(from), static_cast<std::int32_t>(t) - 1);
    from = t;
  }
  if (!path.empty()) visit(path[from], static_cast<std::int32_t>(from), forever);
}

}  // namespace

void SafeIntervals::add(std::int32_t agent, PathView path) {
  visit_stays(path, [&](Location location, std::int32_t from, std::int32_t to) {
    insert(location, {from, to, agent});
  });
}

void SafeIntervals::remove(PathView path) {
  visit_stays(path, [&](Location location, std::int32_t from, std::int32_t) { erase(location, from); });
}

std::int32_t SafeIntervals::agent_at(Location location, std::int32_t t) const {
  const auto there = occupations(location);
  const std::size_t i = index_at(there, t);
  return i < there.size() && there[i].from <= t ? there[i].agent : -1;
}

void SafeIntervals::list_step_conflicts(Location from, Location to, std::int32_t t,
                                        std::vector<std::int32_t>& agents) const {
  assert(t > 0);
  agents.clear();
  if (const std::int32_t there = agent_at(to, t); there >= 0) agents.push_back(there);
  if (from == to) return;
  const std::int32_t before = agent_at(to, t - 1);
  if (before >= 0 && before == agent_at(from, t)) agents.push_back(before);
}

void SafeIntervals::list_conflicts(PathView path, std::vector<std::int32_t>& agents) const {
  agents.clear();
  const auto note = [&](std::int32_t agent) {
    if (agent >= 0 && std::find(agents.begin(), agents.end(), agent) == agents.end()) agents.push_back(agent);
  };
  visit_stays(path, [&](Location location, std::int32_t from, std::int32_t to) {
    const auto there = occupations(location);
    for (std::size_t i = index_at(there, from); i < there.size() && there[i].from <= to; ++i) note(there[i].agent);
    if (from == 0) return;
    const std::int32_t before = agent_at(location, from - 1);
    if (before >= 0 && before == agent_at(path[static_cast<std::size_t>(from) - 1], from)) note(before);
  });
}

void SafeIntervals::insert(Location location, const Occupation& occupation) {
  List& list = lists_[static_cast<std::size_t>(location)];
  if (list.count == capacity(list.size_class)) grow(list);
  const auto first = pool_.begin() + list.begin;
  const auto end = first + list.count;
  auto at = end;
  while (at != first && (at - 1)->from > occupation.from) --at;
  std::copy_backward(at, end, end + 1);
  *at = occupation;
  ++list.count;
}

void SafeIntervals::erase(Location location, std::int32_t from) {
  List& list = lists_[static_cast<std::size_t>(location)];
  const auto end = pool_.begin() + list.begin + list.count;
  auto at = end - 1;
  while (at->from != from) --at;
  std::copy(at + 1, end, at);
  --list.count;
}

void SafeIntervals::grow(List& list) {
  const std::int32_t size_class = list.size_class + 1;
  const auto index = static_cast<std::size_t>(size_class);
  if (unused_.size() <= index) unused_.resize(index + 1);
  auto begin = static_cast<std::uint32_t>(pool_.size());
  if (unused_[index].empty()) {
    pool_.resize(pool_.size() + capacity(size_class));
  } else {
    begin = unused_[index].back();
    unused_[index].pop_back();
  }
  std::copy_n(pool_.begin() + list.begin, list.count, pool_.begin() + begin);
  if (list.size_class >= 0) unused_[index - 1].push_back(list.begin);
  list.begin = begin;
  list.size_class = size_class;
}

}  // namespace dmrp::planners
