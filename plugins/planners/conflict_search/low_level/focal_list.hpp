// SPDX-License-Identifier: MIT
// focal_list.hpp: OPEN and FOCAL of a low-level search (Pearl, Kim 1982): OPEN orders nodes by f; FOCAL holds those
// whose f is within a factor of the least, in an order that the search chooses.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dmrp::planners {

// Nodes are indices. The list never removes closed nodes by itself: the caller of pop() says which are still open.
//
// The lower bound is the least f among the nodes counted as fresh, those that reached their place earlier than any
// other. The other nodes exist for their fewer conflicts; they do not affect the bound.
class FocalList {
 public:
  using Id = std::uint32_t;
  static constexpr Id none = ~Id{0};

  // Empties the list. No f will be below `least_f`.
  void reset(std::int32_t least_f, double suboptimality) {
    for (std::size_t i = 0; i < level_count_; ++i) {
      levels_[i].fresh = 0;
      levels_[i].waiting.clear();
    }
    level_count_ = 0;
    focal_.clear();
    least_f_ = least_f;
    bound_ = least_f;
    focal_bound_ = least_f - 1;
    suboptimality_ = suboptimality;
  }

  std::int32_t least_f() const { return least_f_; }
  // No path costs less.
  std::int32_t bound() const { return bound_; }
  // The largest f in FOCAL.
  std::int32_t focal_bound() const { return focal_bound_; }

  // Lower orders come first.
  void push(Id node, std::int32_t f, std::uint64_t order) {
    assert(f >= least_f_);
    if (f <= focal_bound_)
      push_focal({order, node});
    else
      level(f).waiting.push_back({order, node});
  }

  void add_fresh(std::int32_t f, std::int32_t count) { level(f).fresh += count; }

  // Raises the bound to the least f of a fresh node and fills FOCAL up to it. False if no fresh node is left.
  bool advance() {
    const auto level_of_bound = [this] { return static_cast<std::size_t>(bound_ - least_f_); };
    while (level_of_bound() < level_count_ && levels_[level_of_bound()].fresh == 0) ++bound_;
    if (level_of_bound() >= level_count_) return false;
    const auto last = static_cast<std::int32_t>(std::min(std::floor(suboptimality_ * bound_ + 1e-9), 1e9));
    while (focal_bound_ < last) {
      const auto next = static_cast<std::size_t>(++focal_bound_ - least_f_);
      if (next >= level_count_) continue;
      for (const Entry& entry : levels_[next].waiting) push_focal(entry);
      levels_[next].waiting.clear();
    }
    return true;
  }

  // Removes and returns the first open node of FOCAL; none if there is none.
  template <class IsOpen>
  Id pop(IsOpen is_open) {
    while (!focal_.empty()) {
      const Id node = focal_.front().node;
      std::pop_heap(focal_.begin(), focal_.end(), is_later);
      focal_.pop_back();
      if (is_open(node)) return node;
    }
    return none;
  }

 private:
  struct Entry {
    std::uint64_t order;
    Id node;
  };
  struct Level {  // nodes of one f
    std::int32_t fresh = 0;
    std::vector<Entry> waiting;  // not in FOCAL yet
  };

  static bool is_later(const Entry& a, const Entry& b) { return a.order > b.order; }

  void push_focal(const Entry& entry) {
    focal_.push_back(entry);
    std::push_heap(focal_.begin(), focal_.end(), is_later);
  }
  Level& level(std::int32_t f) {
    const auto i = static_cast<std::size_t>(f - least_f_);
    if (i >= levels_.size()) levels_.resize(i + 1);
    level_count_ = std::max(level_count_, i + 1);
    return levels_[i];
  }

  std::int32_t least_f_ = 0;
  std::int32_t bound_ = 0;
  std::int32_t focal_bound_ = 0;
  double suboptimality_ = 1;
  std::vector<Level> levels_;
  std::size_t level_count_ = 0;  // in use
  std::vector<Entry> focal_;     // a heap
};

}  // namespace dmrp::planners
