// SPDX-License-Identifier: MIT
// sipp_search.hpp: the best path of one robot among robots with known paths.
//
// A* over states (location, safe interval, leg of the tour), each with its earliest arrival (Phillips, Likhachev 2011).
// If there is no free path the search continues through the other robots, as in SIPPS (Li et al. 2022): a path may then
// use locations that they occupy, at a price for each robot. The search returns an earliest one of the cheapest paths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

class SippSearch {
 public:
  enum class Result { free, displacing, none, stopped };
  // Among labels of equal cost: the one with the fewest turns, or the one nearest to the goal, which takes less time.
  enum class Preference : std::uint8_t { straight, near };

  SippSearch(const GridGraph& graph, const SafeIntervals& others, Preference preference = Preference::straight)
      : graph_(graph),
        others_(others),
        preference_(preference),
        intervals_(static_cast<std::size_t>(graph.location_count())) {}

  // The agent itself must not be among the others. `prices` has the positive price of displacing each robot; if it is
  // empty no robot may be displaced. Result::displacing: the path conflicts with some robots. The robot stays at its
  // start for `delay` steps, or as long as it can if that is less. The path ends at `latest` or before; Result::none if
  // there is no such path.
  Result search(const Agent& agent, const TourTable& table, std::span<const std::int32_t> prices, std::int32_t delay,
                StopSignal& stop, std::vector<Location>& path, std::int32_t latest = forever);

  std::int64_t expanded() const { return expanded_; }

 private:
  static constexpr std::int32_t none = -1;

  // Intervals of a location: 2i is the gap before occupation i, 2i + 1 is occupation i.
  struct Label {
    Location location;
    std::int32_t interval;
    std::int32_t leg;
    std::int32_t t;      // of arrival
    std::int32_t price;  // so far
    std::int32_t parent;
    std::int32_t turns;      // so far
    std::int32_t displaced;  // the robot whose occupation this is, or -1
    std::int8_t heading;
    bool is_end;
  };
  // Smaller is better. Ties go to the later label, which is further along its path.
  struct OpenEntry {
    std::uint64_t price_and_steps;  // the least possible cost of the path
    std::uint64_t preference;
    std::int32_t label;
  };
  struct IsWorse {
    bool operator()(const OpenEntry& a, const OpenEntry& b) const {
      if (a.price_and_steps != b.price_and_steps) return a.price_and_steps > b.price_and_steps;
      if (a.preference != b.preference) return a.preference > b.preference;
      return a.label < b.label;
    }
  };
  // The best labels of an interval on a leg.
  struct State {
    std::int32_t expanded_t = forever;  // earliest so far; later labels are no cheaper
    std::int32_t generated_t = forever;
    std::int32_t generated_price = forever;
  };
  // The states of a location. Set at the first visit of a search. Locations with few states have them in a row from
  // `first` on, the others in blocks that are made at their first visit, whose indices are in blocks_ from `first` on.
  struct LocationStates {
    std::uint32_t epoch = 0;
    std::uint32_t first = 0;
  };
  static constexpr std::size_t block_size = 16;
  struct Task {
    const Agent& agent;
    const TourTable& table;
    std::span<const std::int32_t> prices;
    StopSignal& stop;
    std::int32_t rest_from;  // begin of the last goal's last gap
    std::int32_t latest;     // end of the path
  };
  // The data of an expanded label that all its successors use.
  struct Departure {
    std::int32_t label;
    std::int32_t leg;       // of the next step
    std::int32_t last_t;    // last departure
    std::int32_t follower;  // the robot that enters the location right after last_t, or -1
  };

  static bool is_at_last_goal(const Task& task, const Label& label) {
    return label.leg == task.agent.last_leg() && label.location == task.agent.last_goal();
  }
  static std::int32_t price_of(const Task& task, std::int32_t agent) {
    return task.prices[static_cast<std::size_t>(agent)];
  }
  void begin(const Task& task, std::int32_t delay);
  void expand(const Task& task, std::int32_t index);
  void wait(const Task& task, const Departure& departure);
  void move(const Task& task, const Departure& departure, Direction d, Location to);
  void generate(const Task& task, const Label& label);
  void generate_end(const Task& task, const Label& label);
  void start_displacing(const Task& task);
  void push(const Task& task, Label label);
  void push_open(const OpenEntry& entry);
  bool is_open_empty() const { return latest_.label == none && open_.empty(); }
  std::int32_t pop_open();
  State& state_of(const Task& task, const Label& label);
  void trace_back(std::int32_t last, std::vector<Location>& path) const;

  const GridGraph& graph_;
  const SafeIntervals& others_;
  const Preference preference_;
  std::vector<LocationStates> intervals_;
  std::vector<State> states_;          // the first block_size are not used
  std::vector<std::uint32_t> blocks_;  // where a block is in states_; 0: not made yet
  std::vector<Label> labels_;
  std::vector<OpenEntry> open_;  // a heap; without `latest_`, the best of the new entries, which is often expanded next
  OpenEntry latest_ = {0, 0, none};
  std::vector<std::int32_t> expanded_labels_;
  bool may_displace_ = false;  // false while a free path is still possible
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
