// SPDX-License-Identifier: MIT
// cpp/path.hpp: a path as a span of waypoints, and what is said of it; the contract is in ../path.h.
#pragma once

#include <cstdint>
#include <limits>

#include "../path.h"
#include "span.hpp"

namespace dmrp {

using Waypoint = dmrp_waypoint;

// A waypoint whose later fields are absent; any heading unless `theta` says one.
inline Waypoint waypoint(double x, double y, std::int64_t t_ns, std::uint32_t goal_index,
                         double theta = std::numeric_limits<double>::quiet_NaN()) {
  Waypoint made{};
  made.x = x;
  made.y = y;
  made.theta = theta;
  made.t_ns = t_ns;
  made.goal_index = goal_index;
  return made;
}

// Valid as long as the waypoints of the dmrp_path.
class Path : public Span<Waypoint> {
 public:
  explicit Path(const dmrp_path& c, std::uint32_t update_flags = 0)
      : Span(c.waypoints, c.count, c.stride), flags_(c.flags), update_flags_(update_flags) {}

  // It ends before the goal that it leads to.
  bool is_partial() const { return (flags_ & DMRP_PATH_PARTIAL) != 0; }

  // In set_path(): it begins as the path before and ends elsewhere.
  bool continues() const { return (update_flags_ & DMRP_PATH_CONTINUES) != 0; }

 private:
  std::uint32_t flags_;
  std::uint32_t update_flags_;
};

// An array of paths. Valid as long as the array.
class Paths {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Path;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Path;

    explicit Iterator(Span<dmrp_path>::Iterator at) : at_(at) {}

    Path operator*() const { return Path(*at_); }
    Iterator& operator++() { return ++at_, *this; }
    Iterator operator++(int) { return Iterator(at_++); }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.at_ != b.at_; }

   private:
    Span<dmrp_path>::Iterator at_;
  };

  Paths(const dmrp_path* base, std::size_t count, std::size_t stride) : paths_(base, count, stride) {}

  std::size_t size() const { return paths_.size(); }
  bool empty() const { return paths_.empty(); }
  Path operator[](std::size_t index) const { return Path(paths_[index]); }
  Iterator begin() const { return Iterator(paths_.begin()); }
  Iterator end() const { return Iterator(paths_.end()); }

 private:
  Span<dmrp_path> paths_;
};

}  // namespace dmrp
