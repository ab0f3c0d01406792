// SPDX-License-Identifier: MIT
// sipp_search.hpp: the best path of one robot among robots that move on known paths.
//
// A* over states (location, safe interval, leg of the tour) with the earliest time of arrival (Phillips & Likhachev
// 2011). Where that finds no way the search goes on through the other robots, as in SIPPS (Li et al. 2022): a path
// may then take what they occupy, at a price a robot, and the cheapest path is found, of these an earliest.
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
  SippSearch(const GridGraph& graph, const SafeIntervals& others)
      : graph_(graph), others_(others), intervals_(static_cast<std::size_t>(graph.location_count())) {}

  enum class Result { free, displacing, none, stopped };

  // The agent itself must not be among the others. `prices` has what it costs to displace each robot, all positive;
  // if it is empty none may be. Result::displacing: the path has conflicts with some. The robot stays where it starts
  // for `delay` steps, or as long as it can if that is less.
  Result search(const Agent& agent, const TourTable& table, std::span<const std::int32_t> prices, std::int32_t delay,
                StopSignal& stop, std::vector<Location>& path);

  std::int64_t expanded() const { return expanded_; }

 private:
  static constexpr std::int32_t none = -1;

  // An interval of a location is a gap between occupations (2i before occupation i) or an occupation (2i + 1).
  struct Label {
    Location location;
    std::int32_t interval;
    std::int32_t leg;
    std::int32_t t;      // of arrival
    std::int32_t price;  // so far
    std::int32_t parent;
    std::int32_t turns;      // so far
    std::int32_t displaced;  // whose occupation this is, or -1
    std::int8_t heading;
    bool is_end;
  };
  // Smaller is better; of equals the later label, which is further on its way.
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
  // What is known of an interval on a leg.
  struct State {
    std::int32_t expanded_t = forever;  // earliest so far; later labels are no cheaper
    std::int32_t generated_t = forever;
    std::int32_t generated_price = forever;
  };
  // Where the states of a location begin, made when it is first seen in a search.
  struct LocationStates {
    std::uint32_t epoch = 0;
    std::uint32_t first = 0;
  };
  struct Task {
    const Agent& agent;
    const TourTable& table;
    std::span<const std::int32_t> prices;
    StopSignal& stop;
    std::int32_t rest_from;  // the last goal's last gap begins here
  };
  // The part of an expanded label that all its successors share.
  struct Departure {
    std::int32_t label;
    std::int32_t leg;       // of the next step
    std::int32_t last_t;    // last departure
    std::int32_t follower;  // who takes the location right after last_t, or -1
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
  std::vector<LocationStates> intervals_;
  std::vector<State> states_;
  std::vector<Label> labels_;
  std::vector<OpenEntry> open_;  // a heap, apart from the best of the latest: that is often the next to be expanded
  OpenEntry latest_ = {0, 0, none};
  std::vector<std::int32_t> expanded_labels_;
  bool may_displace_ = false;  // not as long as there may be a path that displaces nobody
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
