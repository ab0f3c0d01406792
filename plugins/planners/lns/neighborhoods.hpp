// SPDX-License-Identifier: MIT
// neighborhoods.hpp: which robots of a plan to plan again together.
#pragma once

#include <array>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// A plan without conflicts that is being improved.
struct ImprovingPlan {
  SafeIntervals occupied;
  std::vector<std::vector<Location>> paths;
};

// Four rules, chosen at random by weights that follow the gain for the work spent (Li et al. 2021: adaptive LNS):
//
//   agent    a robot that loses much time, and those that it meets on random shorter ways
//   map      robots that pass near a random junction
//   random   any robots
//   delay    robots drawn by the steps that they lose
//
// A robot loses the steps of its path beyond its cost alone.
class Neighborhoods {
 public:
  enum class Rule : std::uint8_t { agent, map, random, delay };
  static constexpr std::size_t rule_count = 4;

  Neighborhoods(const Problem& problem, const std::vector<TourTable>& tables, const ImprovingPlan& plan,
                toolkit::Stream& random);

  // Draws a rule, and by it a set of at most `size` robots in random order.
  void draw(std::size_t size, std::vector<std::int32_t>& agents);

  // The result of the last set: the steps saved, and the work.
  void learn(std::int64_t gain, std::int64_t work);

  std::int32_t lost(std::int32_t agent) const;

 private:
  Rule draw_rule();
  void add(std::int32_t agent, std::vector<std::int32_t>& agents);
  void add_around_agent(std::size_t size, std::vector<std::int32_t>& agents);
  void walk(std::int32_t agent, std::size_t size, std::vector<std::int32_t>& agents);
  void add_around_junction(std::size_t size, std::vector<std::int32_t>& agents);
  void add_any(std::size_t size, std::vector<std::int32_t>& agents);
  void add_by_delay(std::size_t size, std::vector<std::int32_t>& agents);
  std::int32_t most_delayed();

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  const ImprovingPlan& plan_;
  toolkit::Stream& random_;
  std::vector<Location> junctions_;         // with more than two neighbors; if there are none, all starts
  std::array<double, rule_count> weights_;  // steps saved for each unit of work, a moving average
  Rule rule_ = Rule::agent;
  std::vector<bool> is_tabu_;  // by agent: begun with since all others were
  std::vector<bool> is_in_;    // by agent: in the set being drawn
  std::vector<bool> is_seen_;  // by location; scratch
  std::vector<Location> queue_;
};

}  // namespace dmrp::planners
