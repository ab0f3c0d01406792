// SPDX-License-Identifier: MIT
// safe_intervals.hpp: the positions of all robots over time: for each location a sorted list of occupations, with safe
// intervals between them. Paths are added and removed one by one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/mapf/problem.hpp"

namespace dmrp::planners {

// `agent` is at a location in the steps `from` to `to`, both included.
struct Occupation {
  std::int32_t from;
  std::int32_t to;
  std::int32_t agent;
};

// The safe intervals of a location are the gaps between its occupations. Gap i lies before occupation i and may be
// empty; the last gap has no occupation after it.
class SafeIntervals {
 public:
  explicit SafeIntervals(const GridGraph& graph) : lists_(static_cast<std::size_t>(graph.location_count())) {}

  // The path must have no vertex conflict with the paths already added.
  void add(std::int32_t agent, PathView path);
  // The path must have been added.
  void remove(PathView path);

  // Disjoint, by ascending time.
  std::span<const Occupation> occupations(Location location) const {
    const List& list = lists_[static_cast<std::size_t>(location)];
    return {pool_.data() + list.begin, list.count};
  }

  // The first occupation that ends at `t` or later; the number of occupations if there is none. So `t` lies in that
  // occupation, or in the gap before it.
  static std::size_t index_at(std::span<const Occupation> occupations, std::int32_t t) {
    // branch-free, because branches on this data are mispredicted
    const Occupation* first = occupations.data();
    std::size_t count = occupations.size();
    while (count > 1) {
      const std::size_t half = count / 2;
      first += first[half - 1].to < t ? half : 0;
      count -= half;
    }
    const auto index = static_cast<std::size_t>(first - occupations.data());
    return count == 1 && first->to < t ? index + 1 : index;
  }

  // The robots with which a move or wait that arrives at time t > 0 conflicts.
  void list_step_conflicts(Location from, Location to, std::int32_t t, std::vector<std::int32_t>& agents) const;

  // The robots with which a path conflicts, each once, by ascending time.
  void list_conflicts(PathView path, std::vector<std::int32_t>& agents) const;

 private:
  // A part of the pool: room for 2^(size_class + 2) occupations, of which `count` are in use.
  struct List {
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
    std::int32_t size_class = -1;
  };
  static std::size_t capacity(std::int32_t size_class) { return size_class < 0 ? 0 : std::size_t{4} << size_class; }

  // The robot at `location` at time t, or -1.
  std::int32_t agent_at(Location location, std::int32_t t) const;
  void insert(Location location, const Occupation& occupation);
  void erase(Location location, std::int32_t from);
  void grow(List& list);

  std::vector<List> lists_;
  std::vector<Occupation> pool_;
  std::vector<std::vector<std::uint32_t>> unused_;  // free parts of the pool, by size class
};

}  // namespace dmrp::planners
