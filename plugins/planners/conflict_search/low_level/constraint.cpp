// SPDX-License-Identifier: MIT
#include "planners/conflict_search/low_level/constraint.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::planners {

namespace {

bool avoids(PathView path, const Constraint& constraint) {
  const std::int32_t last = cost_of(path);
  for (std::int32_t t = constraint.t; t < constraint.until && t <= std::max(last, constraint.t); ++t)
    if (location_at(path, t) == constraint.location) return false;
  return true;
}

}  // namespace

std::uint64_t hash_of(const Constraint& c) {
  std::uint64_t hash = 0;
  for (const std::int32_t part : {c.location, c.from, c.t, c.until, static_cast<std::int32_t>(c.kind)}) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  return hash;
}

bool satisfies(PathView path, const Constraint& constraint) {
  switch (constraint.kind) {
    case Constraint::Kind::avoid_vertex:
      return avoids(path, constraint);
    case Constraint::Kind::avoid_move:
      return constraint.t > cost_of(path) || location_at(path, constraint.t) != constraint.location ||
             location_at(path, constraint.t - 1) != constraint.from;
    case Constraint::Kind::pass_vertex:
      return location_at(path, constraint.t) == constraint.location;
    case Constraint::Kind::finish_after:
      return cost_of(path) > constraint.t;
    case Constraint::Kind::finish_by:
      return cost_of(path) <= constraint.t;
  }
  return false;
}

void ConstraintTable::fill(const Agent& agent, std::span<const Constraint> constraints) {
  ++epoch_;
  entries_.clear();
  landmarks_.clear();
  constant_from_ = 0;
  finish_from_ = 0;
  finish_until_ = forever;
  for (const Constraint& c : constraints) {
    switch (c.kind) {
      case Constraint::Kind::avoid_vertex:
        if (c.location == agent.last_goal()) finish_from_ = std::max(finish_from_, c.until);
        [[fallthrough]];
      case Constraint::Kind::avoid_move:
        add_entry(c.location, {c.from, c.t, c.until, -1});
        constant_from_ = std::max(constant_from_, c.until == forever ? c.t : c.until);
        break;
      case Constraint::Kind::pass_vertex:
        landmarks_.push_back({c.t, c.location});
        constant_from_ = std::max(constant_from_, c.t + 1);
        break;
      case Constraint::Kind::finish_after:
        finish_from_ = std::max(finish_from_, c.t + 1);
        break;
      case Constraint::Kind::finish_by:
        finish_until_ = std::min(finish_until_, c.t);
        break;
    }
  }
  // The agent stays at the end of its path, so it must pass landmarks elsewhere before.
  for (const Landmark& landmark : landmarks_)
    if (landmark.location != agent.last_goal()) finish_from_ = std::max(finish_from_, landmark.t + 1);
  std::sort(landmarks_.begin(), landmarks_.end(),
            [](const Landmark& a, const Landmark& b) { return a.t != b.t ? a.t < b.t : a.location < b.location; });
  landmarks_.erase(
      std::unique(landmarks_.begin(), landmarks_.end(),
                  [](const Landmark& a, const Landmark& b) { return a.t == b.t && a.location == b.location; }),
      landmarks_.end());
  for (std::size_t i = 1; i < landmarks_.size(); ++i)
    if (landmarks_[i].t == landmarks_[i - 1].t) finish_from_ = forever;  // contradiction
}

bool ConstraintTable::narrow(Location location, std::int32_t t, std::int32_t& first, std::int32_t& end) const {
  assert(first <= t && t < end);
  bool is_allowed = true;
  std::int32_t allowed_again = 0;
  const auto forbid = [&](std::int32_t from, std::int32_t until) {
    if (t < from) {
      end = std::min(end, from);
    } else if (t >= until) {
      first = std::max(first, until);
    } else {
      is_allowed = false;
      allowed_again = std::max(allowed_again, until);
    }
  };
  if (constrains(location))
    for (std::int32_t i = first_[static_cast<std::size_t>(location)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next)
      if (const Entry& entry = entries_[static_cast<std::size_t>(i)]; entry.from == nowhere)
        forbid(entry.t, entry.until);
  for (const Landmark& landmark : landmarks_)
    if (landmark.location != location) forbid(landmark.t, landmark.t + 1);
  if (!is_allowed) end = allowed_again;
  return is_allowed;
}

void ConstraintTable::add_entry(Location location, const Entry& entry) {
  const auto at = static_cast<std::size_t>(location);
  if (epoch_of_.empty()) {
    epoch_of_.resize(location_count_, 0);
    first_.resize(location_count_, -1);
  }
  entries_.push_back(entry);
  entries_.back().next = epoch_of_[at] == epoch_ ? first_[at] : -1;
  epoch_of_[at] = epoch_;
  first_[at] = static_cast<std::int32_t>(entries_.size()) - 1;
}

}  // namespace dmrp::planners
