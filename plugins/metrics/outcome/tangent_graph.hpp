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
      : space_(shapes, radius_m),
        arcs_(FreeArcs(space_).take()),
        legs_(2 * arcs_.size()),
        has_legs_(2 * arcs_.size()) {}

  const FreeSpace& space() const { return space_; }

  // From one free point to another; NaN if there is no way.
  double length_m(Vec2 from, Vec2 to) {
    if (space_.is_clear({from, to})) return toolkit::distance(from, to);
    to_ = to;
    reached_.assign(legs_.size(), {});
    queue_.clear();
    for (std::uint32_t side = 0; side < legs_.size(); ++side) {
      Tangent tangent;
      if (joins({from, 0.0, 0.0}, circle_of(side), tangent) && arcs_[side / 2].contains(tangent.in))
        queue(leg_to(side, tangent, 0.0), 0.0, Kind::first);
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      const Step step = queue_.back();
      queue_.pop_back();
      if (step.kind == Kind::last) {
        if (space_.is_clear({step.at, to})) return step.length_m;
        continue;
      }
      if (is_beaten(step.side, step.on_side_m, step.length_m - step.on_side_m, 0.0)) continue;
      if (step.kind == Kind::first && !space_.is_clear({from, step.at})) continue;
      turn(step);
    }
    return undefined;
  }

 private:
  // Side 2 i of arc i is the way round it counter-clockwise, 2 i + 1 clockwise. Lengths on a side run in its direction.
  static constexpr std::uint32_t no_side = no_arc;
  static constexpr double rounding_m = 1e-9;

  struct Circle {
    Vec2 center;
    double radius_m;
    double turn;  // 1 counter-clockwise, -1 clockwise, 0 a point
  };

  // A straight line from a circle to another.
  struct Tangent {
    Vec2 out, in;  // unit vectors from the circles' centres to its ends
    double length_m;
  };

  // A tangent from a side to another, or the passage to the piece of the circle that goes on.
  struct Leg {
    double leaves_m;  // on the side that it leaves
    double length_m;
    double enters_m;  // on the side `to`
    Vec2 at;          // where it ends
    std::uint32_t to;
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

  // The best that reaches a side: all places from on_side_m on are reached with a length of offset_m + their place on
  // the side.
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

  // The one tangent that leaves `a` and enters `b` in their directions: at its ends each circle lies on the side to
  // which it turns.
  static bool joins(const Circle& a, const Circle& b, Tangent& tangent) {
    const Vec2 apart = b.center - a.center;
    const double across_m = b.turn * b.radius_m - a.turn * a.radius_m;
    const double squared = toolkit::squared_norm(apart);
    const double squared_length = squared - across_m * across_m;
    if (!(squared_length > 0.0)) return false;
    tangent.length_m = std::sqrt(squared_length);
    const Vec2 along = (tangent.length_m * apart - across_m * toolkit::perpendicular(apart)) / squared;
    tangent.out = -a.turn * toolkit::perpendicular(along);
    tangent.in = -b.turn * toolkit::perpendicular(along);
    return true;
  }

  // Along a tangent that ends on the arc of this side.
  Leg leg_to(std::uint32_t side, const Tangent& tangent, double leaves_m) const {
    const Arc& arc = arcs_[side / 2];
    return {leaves_m, tangent.length_m, place_on(side, tangent.in), arc.center + arc.radius_m * tangent.in, side};
  }

  // Whether something reaches the side before this place with an offset that is less than this by `margin_m`.
  bool is_beaten(std::uint32_t side, double on_side_m, double offset_m, double margin_m) const {
    return reached_[side].on_side_m <= on_side_m && reached_[side].offset_m < offset_m - margin_m;
  }

  void reach(const Step& step) {
    const double offset_m = step.length_m - step.on_side_m;
    if (offset_m < reached_[step.side].offset_m) reached_[step.side] = {step.on_side_m, offset_m};
  }

  // `length_m`: to where the leg begins.
  void queue(const Leg& leg, double length_m, Kind kind) {
    const double reached_m = length_m + leg.length_m;
    // ways of the same length, of which a lattice of racks has many, are followed once
    if (is_beaten(leg.to, leg.enters_m, reached_m - leg.enters_m, -rounding_m)) return;
    const Step step = {reached_m + toolkit::distance(leg.at, to_), reached_m, leg.to, kind, leg.enters_m, leg.at};
    if (kind == Kind::leg) reach(step);
    push(step);
  }

  void push(const Step& step) {
    queue_.push_back(step);
    std::push_heap(queue_.begin(), queue_.end(), later);
  }

  void turn(const Step& step) {
    reach(step);
    const double offset_m = step.length_m - step.on_side_m;
    for (const Leg& leg : legs_of(step.side))
      if (leg.leaves_m >= step.on_side_m - rounding_m) queue(leg, offset_m + leg.leaves_m, Kind::leg);
    Tangent last;
    const Arc& arc = arcs_[step.side / 2];
    if (!joins(circle_of(step.side), {to_, 0.0, 0.0}, last) || !arc.contains(last.out)) return;
    const double leaves_m = place_on(step.side, last.out);
    if (leaves_m < step.on_side_m - rounding_m) return;
    const double length_m = offset_m + leaves_m + last.length_m;
    push({length_m, length_m, no_side, Kind::last, 0.0, arc.center + arc.radius_m * last.out});
  }

  const std::vector<Leg>& legs_of(std::uint32_t side) {
    if (!has_legs_[side]) find_legs(side);
    return legs_[side];
  }

  // All clear legs that leave a side.
  void find_legs(std::uint32_t side) {
    has_legs_[side] = 1;
    const Arc& arc = arcs_[side / 2];
    const Circle circle = circle_of(side);
    for (std::uint32_t to = 0; to < legs_.size(); ++to) {
      Tangent tangent;
      if (to / 2 == side / 2 || !joins(circle, circle_of(to), tangent) || !arc.contains(tangent.out) ||
          !arcs_[to / 2].contains(tangent.in))
        continue;
      const Leg leg = leg_to(to, tangent, place_on(side, tangent.out));
      if (space_.is_clear({arc.center + arc.radius_m * tangent.out, leg.at})) legs_[side].push_back(leg);
    }
    const std::uint32_t next = side % 2 == 0 ? arc.next : arc.previous;
    if (next == no_arc) return;
    const Vec2 end = arc.center + arc.radius_m * (side % 2 == 0 ? arc.to : arc.from);
    legs_[side].push_back({length_of(side), 0.0, 0.0, end, 2 * next + side % 2});
  }

  FreeSpace space_;
  std::vector<Arc> arcs_;
  std::vector<std::vector<Leg>> legs_;  // by side, from when they are first needed
  std::vector<std::uint8_t> has_legs_;  // by side
  Vec2 to_ = {0.0, 0.0};
  std::vector<Reached> reached_;  // by side
  std::vector<Step> queue_;       // a heap
};

}  // namespace dmrp::metrics
