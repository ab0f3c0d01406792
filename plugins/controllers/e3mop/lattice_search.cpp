// SPDX-License-Identifier: MIT
#include "controllers/e3mop/lattice_search.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

namespace dmrp::controllers::e3mop {

namespace {

// Initial sizes: more open states and path poses than any window observed needed.
constexpr std::size_t open_reserve = 16384;
constexpr std::size_t path_reserve = 1024;

}  // namespace

Ticks cost_to_go(std::int32_t distance, double resolution_m, double v_max) {
  return static_cast<Ticks>(distance * (ticks_per_s / GoalDistances::unit * resolution_m / v_max));
}

void LatticeSearch::reserve(const LatticeFrame& frame, SearchResult& result) {
  const std::size_t count = static_cast<std::size_t>(frame.cell_count()) * direction_count;
  if (nodes_.size() < count) nodes_.resize(count, Node{0, 0, -1, -1, false});
  open_.reserve(open_reserve);
  path_.reserve(path_reserve);
  result.poses.reserve(path_reserve);
}

void LatticeSearch::begin(const LatticeFrame& frame) {
  const std::size_t count = static_cast<std::size_t>(frame.cell_count()) * direction_count;
  if (nodes_.size() < count) nodes_.resize(count, Node{0, 0, -1, -1, false});
  if (++search_ == 0) {  // the counter has wrapped around
    std::fill(nodes_.begin(), nodes_.end(), Node{0, 0, -1, -1, false});
    search_ = 1;
  }
  open_.clear();
}

void LatticeSearch::offer(std::int32_t node, Ticks cost, Ticks to_go, std::int32_t parent, std::int16_t motion) {
  Node& known = nodes_[static_cast<std::size_t>(node)];
  if (known.search == search_ && known.cost <= cost) return;
  known = {search_, cost, parent, motion, false};
  open_.push_back({cost + to_go, to_go, node});
  std::push_heap(open_.begin(), open_.end(), [](const Open& a, const Open& b) {
    return a.total != b.total ? a.total > b.total : a.to_go > b.to_go;
  });
}

void LatticeSearch::find(const Pose& start, const SearchSpace& space, const SearchSettings& settings,
                         SearchResult& result) {
  result.found = false;
  result.expanded = 0;
  result.cost = 0;
  result.poses.clear();
  begin(space.frame);
  const std::int32_t center = space.frame.center_cell();
  const std::int32_t distance = space.goal.distance(center);
  if (distance == GoalDistances::infinite) return;

  // the robot's heading lies between two lattice headings: it may turn to either
  const int nearest = nearest_direction(start.theta);
  for (const int aside : {0, 1, -1}) {
    const int heading = (nearest + aside + direction_count) % direction_count;
    const double turn =
        std::abs(toolkit::difference(start.theta, directions()[static_cast<std::size_t>(heading)].theta));
    if (turn > std::atan2(1.0, 2.0)) continue;
    const auto cost = static_cast<Ticks>(std::ceil(turn / settings.omega_max * ticks_per_s));
    offer(center * direction_count + heading, cost, cost_to_go(distance, space.frame.resolution_m, settings.v_max), -1,
          -1);
  }

  Open nearest_to_goal = {0, INT32_MAX, -1};
  while (!open_.empty() && result.expanded < settings.max_expanded) {
    std::pop_heap(open_.begin(), open_.end(), [](const Open& a, const Open& b) {
      return a.total != b.total ? a.total > b.total : a.to_go > b.to_go;
    });
    const Open best = open_.back();
    open_.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(best.node)];
    if (node.expanded || node.cost + best.to_go < best.total) continue;
    if (space.goal.distance(best.node / direction_count) == 0) {
      result.found = true;
      result.cost = node.cost;
      trace(best.node, space, result);
      return;
    }
    if (best.to_go < nearest_to_goal.to_go) nearest_to_goal = best;
    node.expanded = true;
    ++result.expanded;
    expand(best.node, space, settings);
  }
  trace(nearest_to_goal.node, space, result);
}

void LatticeSearch::expand(std::int32_t node, const SearchSpace& space, const SearchSettings& settings) {
  const std::int32_t cell = node / direction_count;
  const std::int32_t column = space.frame.column_of(cell);
  const std::int32_t row = space.frame.row_of(cell);
  const std::int32_t exit = space.goal.exit_direction(cell);
  const Ticks cost = nodes_[static_cast<std::size_t>(node)].cost;
  const bool is_start = nodes_[static_cast<std::size_t>(node)].parent < 0;
  const Vec2 from = space.frame.point_of(cell);
  for (const Motion& motion : space.motions.from(node % direction_count)) {
    if (settings.pruning && exit >= 0 && (motion.dropped_for >> exit & 1)) continue;
    if (!space.frame.inside(column + motion.dx, row + motion.dy)) continue;
    const std::int32_t to_cell = space.frame.cell_at(column + motion.dx, row + motion.dy);
    const std::int32_t to = to_cell * direction_count + motion.to_heading;
    Ticks to_cost = cost + motion.cost;
    if (is_start && motion.kind == MotionKind::turn) to_cost += static_cast<Ticks>(settings.first_turn_s * ticks_per_s);
    const Node& known = nodes_[static_cast<std::size_t>(to)];
    if (known.search == search_ && known.cost <= to_cost) continue;
    const std::int32_t distance = space.goal.distance(to_cell);
    if (distance == GoalDistances::infinite || !is_clear(from, motion, space)) continue;
    offer(to, to_cost, cost_to_go(distance, space.frame.resolution_m, settings.v_max), node,
          static_cast<std::int16_t>(space.motions.index_of(motion)));
  }
}

bool LatticeSearch::is_clear(Vec2 from, const Motion& motion, const SearchSpace& space) {
  const DirectedPoint* sample = space.motions.samples().data() + motion.first_sample;
  for (std::uint32_t i = 0; i < motion.sample_count; ++i, ++sample)
    if (!space.free_space.is_free({from + sample->at, sample->heading})) return false;
  return true;
}

void LatticeSearch::trace(std::int32_t node, const SearchSpace& space, SearchResult& result) {
  path_.clear();
  for (std::int32_t at = node; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent) path_.push_back(at);
  std::reverse(path_.begin(), path_.end());
  result.poses.push_back({space.frame.center.x, space.frame.center.y,
                          directions()[static_cast<std::size_t>(path_.front() % direction_count)].theta});
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const Vec2 from = space.frame.point_of(path_[i - 1] / direction_count);
    const Motion& motion =
        space.motions.at(static_cast<std::size_t>(nodes_[static_cast<std::size_t>(path_[i])].motion));
    for (std::uint32_t k = 0; k < motion.sample_count; ++k) {
      const DirectedPoint& sample = space.motions.samples()[motion.first_sample + k];
      result.poses.push_back(pose_of({from + sample.at, sample.heading}));
    }
  }
}

}  // namespace dmrp::controllers::e3mop
