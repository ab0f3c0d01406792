// SPDX-License-Identifier: MIT
// shortest_way.hpp: the shortest ways of a world's robots from their starts through their goals among the static shapes.
//
// A robot is the disc of its footprint's radius, and may touch. A start or goal nearer to a wall than that counts as
// moved to free space, away from the nearest wall, and the move counts as a part of the way. Between two such points the
// straight way counts as free if it comes no nearer to a wall than its ends.
#pragma once

#include <algorithm>
#include <array>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <memory>

#include "metrics/outcome/static_shapes.hpp"
#include "metrics/outcome/tangent_graph.hpp"

namespace dmrp::metrics {

// One object for all trials of a metric: what it computed stays while the static shapes are the same.
class ShortestTours {
 public:
  void begin(const World& world) {
    if (shapes_ != nullptr && shapes_->are_those_of(world)) return;
    graphs_.clear();
    lengths_m_.clear();
    shapes_ = std::make_unique<StaticShapes>(world);
  }

  // NaN if there is no way.
  double length_m(const Robot& robot) {
    double sum_m = 0.0;
    Vec2 at = toolkit::position(robot.start);
    for (const Goal& goal : robot.goals()) {
      const Vec2 next = toolkit::position(goal.pose);
      sum_m += kept_length_m(at, next, robot.footprint->radius_m);
      at = next;
    }
    return sum_m;
  }

  // Assumes v_max all the way.
  double least_time_s(const Robot& robot) { return length_m(robot) / robot.limits->v_max; }

 private:
  static constexpr std::size_t most_kept = 100'000;

  double kept_length_m(Vec2 from, Vec2 to, double radius_m) {
    const std::array<double, 5> key = {from.x, from.y, to.x, to.y, radius_m};
    const auto kept = lengths_m_.find(key);
    if (kept != lengths_m_.end()) return kept->second;
    if (lengths_m_.size() == most_kept) lengths_m_.clear();
    return lengths_m_[key] = leg_length_m(from, to, radius_m);
  }

  double leg_length_m(Vec2 from, Vec2 to, double radius_m) {
    if (!toolkit::contains(shapes_->border(), from) || !toolkit::contains(shapes_->border(), to)) return undefined;
    auto& graph = graphs_[radius_m];
    if (graph == nullptr) graph = std::make_unique<TangentGraph>(*shapes_, radius_m);
    const FreeSpace& space = graph->space();
    const double kept_m = std::min(space.clearance_m(from), space.clearance_m(to));
    if (from == to || (kept_m > touching_m && space.is_clear({from, to}, kept_m))) return toolkit::distance(from, to);
    Vec2 free_from = from;
    Vec2 free_to = to;
    if (!space.move_clear(free_from) || !space.move_clear(free_to)) return undefined;
    return toolkit::distance(from, free_from) + graph->length_m(free_from, free_to) + toolkit::distance(free_to, to);
  }

  std::unique_ptr<StaticShapes> shapes_;
  std::map<double, std::unique_ptr<TangentGraph>> graphs_;  // by radius
  std::map<std::array<double, 5>, double> lengths_m_;       // by ends and radius
};

}  // namespace dmrp::metrics
