// SPDX-License-Identifier: MIT
// tangent_graph.hpp: the shortest ways of a disc's centre among static shapes, exact.
//
// A shortest way is made of straight legs and of arcs round corners, each leg tangent to the arcs that it joins: Liu and
// Arimoto, Path Planning Using a Tangent Graph for Mobile Robots Among Polygonal and Curved Obstacles, IJRR 11(4), 1992.
// A* searches them. The legs from an arc are computed when a search first turns round it, and kept for later searches.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "metrics/outcome/free_arcs.hpp"
#include "metrics/outcome/static_shapes.hpp"

namespace dmrp::metrics {

class TangentGraph {
 public:
  // The shapes must outlive this object.
  TangentGraph(const StaticShapes& shapes, double radius_m)
      : space_(shapes, radius_m), arcs_(FreeArcs(space_).take()), legs_(2 * arcs_.size()) {}

  const FreeSpace& space() const { return space_; }

  // From one free point to another; NaN if there is no way.
  double length_m(Vec2 from, Vec2 to) {
    if (space_.is_clear({from, to})) return toolkit::distance(from, to);
    to_ = to;
    reached_.assign(legs_.size(), {});
    queue_.clear();
    for (std::uint32_t side = 0; side < legs_.size(); ++side) {
      Leg leg;
      if (joins({from, 0.0, 0.0}, circle_of(side), leg) && enters(side, leg)) queue(leg, 0.0, Kind::first);
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      const Step step = queue_.back();
      queue_.pop_back();
      if (step.kind == Kind::last) {
        if (space_.is_clear({step.at, to})) return step.length_m;
        continue;
      }
      if (is_known(step)) continue;
      if (step.kind == Kind::first && !space_.is_clear({from, step.at})) continue;
      turn(step);
    }
    return undefined;
  }

 private:
  // Side 2 i of arc i is the way round it counter-clockwise, 2 i + 1 clockwise. Lengths on a side run in its direction.
  static constexpr std::uint32_t no_side = no_arc;

  struct Circle {
    Vec2 center;
    double radius_m;
    double turn;  // 1 counter-clockwise, -1 clockwise, 0 a point
  };

  // A straight leg from a side to another, or the passage to the side that goes on.
  struct Leg {
    Vec2 out, in;     // unit vectors from the circles' centres to the tangent points
    double leaves_m;  // on the side that it leaves
    double length_m;
    std::uint32_t to;  // side
    double enters_m;   // on that side
    Vec2 at;           // where it ends
  };

  enum class Kind : std::uint8_t { first, leg, last };  // first and last legs may prove to be blocked

  struct Step {
    double estimate_m;  // of the whole way
    double length_m;    // so far; with kind `last` that of the whole way
    std::uint32_t side;
    Kind kind;
    double on_side_m;
    Vec2 at;  // with kind `last` where the last leg begins
  };

  // What reached a side: all places from on_side_m on are reached with a length of offset_m + their place on the side.
  struct Reached {
    double on_side_m = std::numeric_limits<double>::infinity();
    double offset_m = std::numeric_limits<double>::infinity();
  };

  static bool later(const Step& a, const Step& b) {
    return std::tie(a.estimate_m, a.side, a.on_side_m, a.kind) > std::tie(b.estimate_m, b.side, b.on_side_m, b.kind);
  }

  Circle circle_of(std::uint32_t side) const {
    const Arc& arc = arcs_[side / 2];
    return {arc.center, arc.radius_m, side % 2 == 0 ? 1.0 : -1.0};
  }

  double length_of(std::uint32_t side) const { return arcs_[side / 2].radius_m * arcs_[side / 2].width_rad; }

  double place_on(std::uint32_t side, Vec2 direction) const {
    const Arc& arc = arcs_[side / 2];
    const double angle = arc.angle_to(direction);
    return arc.radius_m * (side % 2 == 0 ? angle : arc.width_rad - angle);
  }

  // The one leg that leaves `a` and enters `b` in their directions: at its ends each circle lies on the side to which
  // it turns.
  static bool joins(const Circle& a, const Circle& b, Leg& leg) {
    const Vec2 apart = b.center - a.center;
    const double across_m = b.turn * b.radius_m - a.turn * a.radius_m;
    const double squared = toolkit::squared_norm(apart);
    const double squared_length = squared - across_m * across_m;
    if (!(squared_length > 0.0)) return false;
    leg.length_m = std::sqrt(squared_length);
    const Vec2 along = (leg.length_m * apart - across_m * toolkit::perpendicular(apart)) / squared;
    leg.out = -a.turn * toolkit::perpendicular(along);
    leg.in = -b.turn * toolkit::perpendicular(along);
    return true;
  }

  // Whether the leg's end lies on the arc of `side`; it is then complete but for what it leaves.
  bool enters(std::uint32_t side, Leg& leg) const {
    const Arc& arc = arcs_[side / 2];
    if (!arc.contains(leg.in)) return false;
    leg.to = side;
    leg.enters_m = place_on(side, leg.in);
    leg.at = arc.center + arc.radius_m * leg.in;
    return true;
  }

  bool is_known(const Step& step) const {
    const Reached& reached = reached_[step.side];
    return reached.on_side_m <= step.on_side_m && reached.offset_m <= step.length_m - step.on_side_m;
  }

  // `length_m`: to where the leg begins.
  void queue(const Leg& leg, double length_m, Kind kind) {
    const double reached_m = length_m + leg.length_m;
    const Step step = {reached_m + toolkit::distance(leg.at, to_), reached_m, leg.to, kind, leg.enters_m, leg.at};
    if (is_known(step)) return;
    queue_.push_back(step);
    std::push_heap(queue_.begin(), queue_.end(), later);
  }

  void turn(const Step& step) {
    const double offset_m = step.length_m - step.on_side_m;
    if (offset_m < reached_[step.side].offset_m) reached_[step.side] = {step.on_side_m, offset_m};
    constexpr double rounding_m = 1e-9;
    for (const Leg& leg : legs_of(step.side))
      if (leg.leaves_m >= step.on_side_m - rounding_m) queue(leg, offset_m + leg.leaves_m, Kind::leg);
    Leg last;
    const Arc& arc = arcs_[step.side / 2];
    if (!joins(circle_of(step.side), {to_, 0.0, 0.0}, last) || !arc.contains(last.out)) return;
    const double leaves_m = place_on(step.side, last.out);
    if (leaves_m < step.on_side_m - rounding_m) return;
    const double length_m = offset_m + leaves_m + last.length_m;
    queue_.push_back({length_m, length_m, no_side, Kind::last, 0.0, arc.center + arc.radius_m * last.out});
    std::push_heap(queue_.begin(), queue_.end(), later);
  }

  const std::vector<Leg>& legs_of(std::uint32_t side) {
    if (legs_[side].empty()) find_legs(side);
    return legs_[side];
  }

  // All clear legs that leave a side. There is at least one, which leads nowhere if need be: so a side is looked at once.
  void find_legs(std::uint32_t side) {
    const Arc& arc = arcs_[side / 2];
    const Circle circle = circle_of(side);
    std::vector<Leg>& legs = legs_[side];
    for (std::uint32_t to = 0; to < legs_.size(); ++to) {
      Leg leg;
      if (to / 2 == side / 2 || !joins(circle, circle_of(to), leg) || !arc.contains(leg.out) || !enters(to, leg))
        continue;
      leg.leaves_m = place_on(side, leg.out);
      if (space_.is_clear({arc.center + arc.radius_m * leg.out, leg.at})) legs.push_back(leg);
    }
    add_passage(side);
  }

  // To the piece of the circle that goes on.
  void add_passage(std::uint32_t side) {
    const Arc& arc = arcs_[side / 2];
    const std::uint32_t next = side % 2 == 0 ? arc.next : arc.previous;
    const Vec2 end = side % 2 == 0 ? arc.to : arc.from;
    const std::uint32_t to = next == no_arc ? side : 2 * next + side % 2;
    legs_[side].push_back(
        {end, end, length_of(side), 0.0, to, next == no_arc ? length_of(side) : 0.0, arc.center + arc.radius_m * end});
  }

  FreeSpace space_;
  std::vector<Arc> arcs_;
  std::vector<std::vector<Leg>> legs_;  // by side; empty until they are needed
  Vec2 to_ = {0.0, 0.0};
  std::vector<Reached> reached_;  // by side
  std::vector<Step> queue_;       // a heap
};

}  // namespace dmrp::metrics
