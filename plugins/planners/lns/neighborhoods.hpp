// SPDX-License-Identifier: MIT
// neighborhoods.hpp: which robots of a plan to plan again together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// Chooses one of a few ways at random and shares the work, not the draws, by the gain that each way brought for its work
// lately (after Li et al. 2021: adaptive LNS): a way whose sets take ten times the work is drawn a tenth as often.
template <std::size_t count>
class AdaptiveChoice {
 public:
  std::size_t draw(toolkit::Stream& random) {
    double sum_of_gains = 0;
    for (const Past& past : pasts_) sum_of_gains += past.gain / past.work;
    std::array<double, count> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Past& past = pasts_[i];
      const double share = least_share + (sum_of_gains > 0 ? past.gain / past.work / sum_of_gains : 0.0);
      sum += weights[i] = share * past.draws / past.work;
    }
    double at = random.uniform() * sum;
    for (drawn_ = 0; drawn_ + 1 < count && (at -= weights[drawn_]) >= 0;) ++drawn_;
    return drawn_;
  }

  std::size_t drawn() const { return drawn_; }

  // What the way that was drawn last brought.
  void learn(std::int64_t gain, std::int64_t work) {
    Past& past = pasts_[drawn_];
    past.gain = memory * past.gain + static_cast<double>(gain);
    past.work = memory * past.work + static_cast<double>(std::max<std::int64_t>(work, 1));
    past.draws = memory * past.draws + 1.0;
  }

 private:
  struct Past {
    double gain = 1.0;
    double work = 1.0;
    double draws = 1.0;
  };
  static constexpr double memory = 0.99;      // what is left of a result at the next draw
  static constexpr double least_share = 0.2;  // of the work for each way, so that none dies out

  std::array<Past, count> pasts_{};
  std::size_t drawn_ = 0;
};

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
