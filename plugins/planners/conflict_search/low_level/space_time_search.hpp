// SPDX-License-Identifier: MIT
// space_time_search.hpp: the low level over single steps: nodes are (location, time, leg). Slower and simpler than safe
// intervals, which are tested against it.
#pragma once

#include "planners/conflict_search/low_level/focal_list.hpp"
#include "planners/conflict_search/low_level/low_level.hpp"

namespace dmrp::planners {

class SpaceTimeSearch {
 public:
  explicit SpaceTimeSearch(const GridGraph& graph) : graph_(graph) {}

  // After the last constraint and the last move of the others, times are not distinguished: of two ways to be somewhere
  // then the search keeps the earlier one, even if it has more conflicts.
  LowLevelResult search(const LowLevelRequest& request, StopSignal& stop, LowLevelPath& found);

  std::int64_t expanded() const { return expanded_; }

 private:
  using Id = FocalList::Id;
  static constexpr Id none = FocalList::none;

  struct Node {
    std::uint64_t key;  // place, time and leg; of nodes with equal keys only the best one is kept
    Id parent;
    Location location;
    std::int32_t t;
    std::int32_t leg;
    std::int32_t f;
    std::int32_t conflicts;
    std::int32_t turns;
    std::uint8_t heading = GridGraph::no_direction;
    bool waited_at_end = false;  // its last step is a wait at the end of the tour; the path cannot end here then
    bool is_open = false;
    bool is_fresh = false;
    bool is_end = false;  // comes to rest here; `conflicts` include those of resting
  };
  struct Slot {
    std::uint32_t epoch = 0;
    Id node = none;
  };

  void reset(const LowLevelRequest& request);
  void expand(Id id);
  void offer(Node node);
  void offer_end(Id id);
  bool can_keep_landmarks(Location location, std::int32_t t) const;
  void open(const Node& node);
  void close(Id id);
  Id& slot_of(std::uint64_t key);
  void grow_slots();
  void extract(Id id, LowLevelPath& found) const;

  const GridGraph& graph_;
  const LowLevelRequest* request_ = nullptr;
  std::int32_t horizon_ = 0;  // from here on times are not distinguished
  FocalList focal_;
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;  // open addressing by key
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
