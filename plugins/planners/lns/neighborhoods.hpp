// SPDX-License-Identifier: MIT
// neighborhoods.hpp: which robots of a plan to plan again together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "planners/lns/adaptive_choice.hpp"
#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// A plan without conflicts that is being improved.
struct ImprovingPlan {
  SafeIntervals occupied;
  std::vector<std::vector<Location>> paths;
};

// Five rules, chosen adaptively:
//
//   agent    a robot that loses much time, and those that it meets on random shorter ways
//   map      robots that pass near a random junction
//   random   any robots
//   delay    robots drawn by the steps that they lose
//   goal     robots whose shortest ways cross the place where another one rests, and that one, planned last
//
// The number of robots is chosen likewise, from 4 to 64 (Phan et al.: Adaptive anytime multi-agent path finding using
// bandit-based large neighborhood search, AAAI 2024), except for `goal`, which takes up to 32. Where robots hold each
// other up in narrow passages, small sets alone end in a plan that none of them improves.
//
// A robot loses the steps of its path beyond its cost alone.
class Neighborhoods {
 public:
  enum class Rule : std::uint8_t { agent, map, random, delay, goal };
  static constexpr std::size_t rule_count = 5;
  static constexpr std::array<std::size_t, 5> sizes = {4, 8, 16, 32, 64};
  static constexpr std::size_t robots_around_goal = 32;
  static constexpr std::size_t most_robots = sizes.back();

  Neighborhoods(const Problem& problem, const std::vector<TourTable>& tables, const ImprovingPlan& plan,
                toolkit::Stream& random);

  // Draws a rule and a size, and by them a set of robots in random order.
  void draw(std::vector<std::int32_t>& agents);

  // The result of the last set: the steps saved, and the work.
  void learn(std::int64_t gain, std::int64_t work);

  std::int32_t lost(std::int32_t agent) const;

 private:
  void add(std::int32_t agent, std::vector<std::int32_t>& agents);
  void add_around_agent(std::size_t size, std::vector<std::int32_t>& agents);
  void walk(std::int32_t agent, std::size_t size, std::vector<std::int32_t>& agents);
  void add_around_junction(std::size_t size, std::vector<std::int32_t>& agents);
  void add_any(std::size_t size, std::vector<std::int32_t>& agents);
  void add_by_delay(std::size_t size, std::vector<std::int32_t>& agents);
  std::int32_t add_around_goal(std::size_t size, std::vector<std::int32_t>& agents);
  void follow_shortest_way(std::int32_t agent);
  std::int32_t most_delayed();

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  const ImprovingPlan& plan_;
  toolkit::Stream& random_;
  std::vector<Location> junctions_;  // with more than two neighbors; if there are none, all starts
  AdaptiveChoice<rule_count> rule_;
  AdaptiveChoice<sizes.size()> size_;
  std::vector<bool> is_tabu_;  // by agent: begun with since all others were
  std::vector<bool> is_in_;    // by agent: in the set being drawn
  std::vector<bool> is_seen_;  // by location; scratch
  std::vector<Location> queue_;
  std::vector<std::int32_t> resting_;  // by location: the robot that ends there, or -1
  std::vector<Location> way_;          // scratch
};

}  // namespace dmrp::planners
