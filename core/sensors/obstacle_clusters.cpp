// SPDX-License-Identifier: MIT
#include "core/sensors/obstacle_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::core {
namespace {

constexpr std::int32_t none = -1;

// What is nowhere farther than this from its longest chord is straight: so are all cells that a straight line crosses.
constexpr double straight_cells = 1.25;

// Polygons may lie this far within the hull of their cells.
constexpr double flat_cells = 0.5;

struct Offset {
  std::int64_t column;
  std::int64_t row;
};

// The places before a cell, in row-major order, whose distance is at most three cells: two tolerances.
constexpr std::array<Offset, 14> neighbors_before = {{{-3, 0},
                                                      {-2, 0},
                                                      {-1, 0},
                                                      {-2, -1},
                                                      {-1, -1},
                                                      {0, -1},
                                                      {1, -1},
                                                      {2, -1},
                                                      {-2, -2},
                                                      {-1, -2},
                                                      {0, -2},
                                                      {1, -2},
                                                      {2, -2},
                                                      {0, -3}}};

std::int64_t floor_of_quotient(std::int64_t dividend, std::int64_t divisor) {
  return dividend >= 0 ? dividend / divisor : -((-dividend + divisor - 1) / divisor);
}

template <class Cell>
std::int64_t dot(const Cell& a, const Cell& b) {
  return a.column * b.column + a.row * b.row;
}

template <class Cell>
std::int64_t cross(const Cell& a, const Cell& b) {
  return a.column * b.row - a.row * b.column;
}

template <class Cell>
Cell between(const Cell& from, const Cell& to) {
  return {to.column - from.column, to.row - from.row};
}

}  // namespace

const dmrp_obstacle_cluster_list& ObstacleClusters::derive(const dmrp_costmap& costmap,
                                                           std::span<const dmrp_agent> agents) {
  vertices_.clear();
  clusters_.clear();
  collect_cells(costmap, agents);
  unite_neighbors();
  group_components();
  forget_cells();

  // vertices have moved while they came to be
  const dmrp_vec2* vertex = vertices_.data();
  for (dmrp_obstacle_cluster& cluster : clusters_) {
    cluster.vertices = vertex;
    vertex += cluster.vertex_count;
  }
  list_.struct_size = sizeof(list_);
  list_.count = static_cast<std::uint32_t>(clusters_.size());
  list_.stride = sizeof(dmrp_obstacle_cluster);
  list_.t_ns = costmap.t_ns;
  list_.tolerance_m = tolerance_cells * costmap.resolution_m;
  list_.clusters = clusters_.data();
  return list_;
}

void ObstacleClusters::collect_cells(const dmrp_costmap& costmap, std::span<const dmrp_agent> agents) {
  const auto width = static_cast<std::int64_t>(costmap.width);
  const auto height = static_cast<std::int64_t>(costmap.height);
  resolution_m_ = costmap.resolution_m;
  origin_ = costmap.origin;
  const auto places = static_cast<std::size_t>((width + 2 * border) * (height + 2 * border));
  if (stride_ != width + 2 * border || index_.size() != places) {
    stride_ = width + 2 * border;
    index_.assign(places, none);
  }

  near_.clear();
  const dmrp_vec2 upper = costmap.origin + resolution_m_ * dmrp_vec2{double(width), double(height)};
  for (const dmrp_agent& agent : agents) {
    const dmrp_vec2 at = toolkit::position(agent.pose);
    const dmrp_vec2 inside = {std::clamp(at.x, costmap.origin.x, upper.x), std::clamp(at.y, costmap.origin.y, upper.y)};
    if (toolkit::distance(at, inside) <= agent.radius_m + agent_margin_m) near_.push_back(agent);
  }
  const auto is_agent = [&](dmrp_vec2 center) {
    return std::any_of(near_.begin(), near_.end(), [&](const dmrp_agent& agent) {
      const double reach_m = agent.radius_m + agent_margin_m;
      return toolkit::squared_distance(toolkit::position(agent.pose), center) <= reach_m * reach_m;
    });
  };

  found_.clear();
  const std::uint8_t* const begin = costmap.costs;
  const std::uint8_t* const end = begin + width * height;
  for (const std::uint8_t* cost = begin; cost < end; ++cost) {
    cost = static_cast<const std::uint8_t*>(std::memchr(cost, DMRP_COST_LETHAL, static_cast<std::size_t>(end - cost)));
    if (cost == nullptr) break;
    const Cell cell = {(cost - begin) % width, (cost - begin) / width};
    if (is_agent(center_of(cell))) continue;
    index_at(cell.column, cell.row) = static_cast<std::int32_t>(found_.size());
    found_.push_back(cell);
  }
}

// A forest over the cells: roots are the first of their component.
void ObstacleClusters::unite_neighbors() {
  std::array<std::int64_t, neighbors_before.size()> steps;
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i] = neighbors_before[i].row * stride_ + neighbors_before[i].column;
  parents_.resize(found_.size());
  for (std::uint32_t i = 0; i < found_.size(); ++i) {
    parents_[i] = i;
    std::uint32_t root = i;
    const std::int32_t* const place = cell_at(found_[i].column, found_[i].row);
    for (const std::int64_t step : steps) {
      if (place[step] == none) continue;
      const std::uint32_t other = root_of(static_cast<std::uint32_t>(place[step]));
      if (other == root) continue;
      parents_[std::max(root, other)] = std::min(root, other);
      root = std::min(root, other);
    }
  }
}

std::uint32_t ObstacleClusters::root_of(std::uint32_t cell) {
  while (parents_[cell] != cell) {
    parents_[cell] = parents_[parents_[cell]];
    cell = parents_[cell];
  }
  return cell;
}

// Sorts the cells by component, the order within kept, and clusters one component after the other.
void ObstacleClusters::group_components() {
  offsets_.assign(found_.size() + 1, 0);
  for (std::uint32_t i = 0; i < found_.size(); ++i) ++offsets_[root_of(i) + 1];
  for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
  cells_.resize(found_.size());
  for (std::uint32_t i = 0; i < found_.size(); ++i) cells_[offsets_[root_of(i)]++] = found_[i];

  // now offsets_[i] is where the component of root i ends
  std::uint32_t begin = 0;
  for (std::uint32_t i = 0; i < found_.size(); ++i) {
    if (offsets_[i] == begin) continue;
    cluster({begin, offsets_[i]});
    begin = offsets_[i];
  }
}

void ObstacleClusters::cluster(Range range) {
  pending_.assign(1, range);
  while (!pending_.empty()) {
    range = pending_.back();
    pending_.pop_back();
    find_hull(range);
    if (hull_.size() == 1) {
      emit(hull_);
      continue;
    }
    const Chord chord = longest_chord();
    if (chord.deviation() <= straight_cells) {
      const Gap gap = gap_in(chord, range);
      if (gap.exists) {
        split(range, chord,
              [&](const Cell& off) { return static_cast<double>(dot(chord.along, off)) <= gap.projection; });
      } else {
        emit(std::array<Cell, 2>{
            {chord.from, {chord.from.column + chord.along.column, chord.from.row + chord.along.row}}});
      }
    } else if (hull_is_filled(range.end - range.begin)) {
      drop_flat_vertices();
      emit(hull_);
    } else if (chord.left > straight_cells && chord.right > straight_cells) {
      split(range, chord, [&](const Cell& off) { return cross(chord.along, off) > 0; });
    } else {
      const std::int64_t projection = dot(chord.along, between(chord.from, chord.farthest));
      split(range, chord, [&](const Cell& off) { return dot(chord.along, off) <= projection; });
    }
  }
}

// Andrew's monotone chain, which the row-major order suits: up the right side, down the left.
void ObstacleClusters::find_hull(Range range) {
  hull_.clear();
  const auto extend = [&](const Cell& cell, std::size_t least) {
    while (hull_.size() > least &&
           cross(between(hull_[hull_.size() - 2], hull_.back()), between(hull_.back(), cell)) <= 0)
      hull_.pop_back();
    hull_.push_back(cell);
  };
  for (std::uint32_t i = range.begin; i < range.end; ++i) extend(cells_[i], 1);
  const std::size_t right_side = hull_.size();
  if (right_side == 1) return;
  for (std::uint32_t i = range.end - 1; i-- > range.begin;) extend(cells_[i], right_side);
  hull_.pop_back();  // the first again
}

ObstacleClusters::Chord ObstacleClusters::longest_chord() const {
  Chord chord{};
  std::int64_t longest = -1;
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    for (std::size_t j = i + 1; j < hull_.size(); ++j) {
      const Cell along = between(hull_[i], hull_[j]);
      if (dot(along, along) <= longest) continue;
      longest = dot(along, along);
      chord.from = hull_[i];
      chord.along = along;
    }
  }
  chord.length = std::sqrt(static_cast<double>(longest));
  chord.farthest = chord.from;
  for (const Cell& vertex : hull_) {
    const double off = static_cast<double>(cross(chord.along, between(chord.from, vertex))) / chord.length;
    if (std::abs(off) > chord.deviation()) chord.farthest = vertex;
    chord.left = std::max(chord.left, off);
    chord.right = std::max(chord.right, -off);
  }
  return chord;
}

// The first stretch of a chord that none of the cells accounts for. Each accounts for more than half a cell both ways,
// being near the chord, so that all in the same whole cell of projection account for one stretch together.
ObstacleClusters::Gap ObstacleClusters::gap_in(const Chord& chord, Range range) {
  constexpr Stretch nothing = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  stretches_.assign(static_cast<std::size_t>(chord.length) + 1, nothing);
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const Cell there = between(chord.from, cells_[i]);
    const double at = static_cast<double>(dot(chord.along, there)) / chord.length;
    const double off = static_cast<double>(cross(chord.along, there)) / chord.length;
    const double reach = std::sqrt(tolerance_cells * tolerance_cells - off * off);
    Stretch& stretch = stretches_[std::min(static_cast<std::size_t>(at), stretches_.size() - 1)];
    stretch.begin = std::min(stretch.begin, at - reach);
    stretch.end = std::max(stretch.end, at + reach);
  }
  double reached = 0.0;
  for (const Stretch& stretch : stretches_) {
    if (stretch.end < stretch.begin) continue;
    if (stretch.begin > reached) return {true, 0.5 * (reached + stretch.begin) * chord.length};
    reached = std::max(reached, stretch.end);
  }
  return {false, 0.0};
}

// Whether each square between four cell centres that the hull has a part of has a lethal cell at one of them.
bool ObstacleClusters::hull_is_filled(std::size_t cell_count) const {
  std::int64_t doubled_area = 0;
  for (std::size_t i = 0; i < hull_.size(); ++i) doubled_area += cross(hull_[i], hull_[(i + 1) % hull_.size()]);
  if (doubled_area > 8 * static_cast<std::int64_t>(cell_count)) return false;  // a cell accounts for four squares
  const auto [lowest, highest] =
      std::minmax_element(hull_.begin(), hull_.end(), [](const Cell& a, const Cell& b) { return a.row < b.row; });
  for (std::int64_t row = lowest->row; row < highest->row; ++row)
    if (!row_is_filled(row)) return false;
  return true;
}

// Of the squares between this row of centres and the next: no vertex lies between, so the hull's sides are straight.
bool ObstacleClusters::row_is_filled(std::int64_t row) const {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Cell& one = hull_[i];
    const Cell& other = hull_[(i + 1) % hull_.size()];
    const Cell& low = one.row < other.row ? one : other;
    const Cell& high = one.row < other.row ? other : one;
    if (low.row > row || high.row <= row) continue;
    const Cell along = between(low, high);
    for (const std::int64_t at : {row, row + 1}) {
      const std::int64_t aside = along.column * (at - low.row);
      first = std::min(first, low.column + floor_of_quotient(aside, along.row));
      last = std::max(last, low.column - floor_of_quotient(-aside, along.row));
    }
  }
  for (std::int64_t column = first; column < last; ++column) {
    const std::int32_t* const corner = cell_at(column, row);
    if (corner[0] == none && corner[1] == none && corner[stride_] == none && corner[stride_ + 1] == none) return false;
  }
  return true;
}

// From each vertex that stays to the farthest one with all between at most flat_cells off: the cells are then no
// farther from the polygon, which is a part of the hull.
void ObstacleClusters::drop_flat_vertices() {
  set_aside_.assign(hull_.begin(), hull_.end());
  set_aside_.push_back(hull_.front());
  hull_.clear();
  const auto is_flat = [&](std::size_t first, std::size_t last) {
    const Cell along = between(set_aside_[first], set_aside_[last]);
    const double most = flat_cells * std::sqrt(static_cast<double>(dot(along, along)));
    for (std::size_t i = first + 1; i < last; ++i) {
      const Cell off = between(set_aside_[first], set_aside_[i]);
      if (dot(along, off) < 0 || dot(along, off) > dot(along, along)) return false;
      if (std::abs(static_cast<double>(cross(along, off))) > most) return false;
    }
    return true;
  };
  for (std::size_t first = 0; first + 1 < set_aside_.size();) {
    hull_.push_back(set_aside_[first]);
    std::size_t last = first + 1;
    while (last + 1 < set_aside_.size() && is_flat(first, last + 1)) ++last;
    first = last;
  }
}

// `is_first(cell seen from the chord's beginning)` tells the parts apart; both keep their order.
template <class IsFirst>
void ObstacleClusters::split(Range range, const Chord& chord, const IsFirst& is_first) {
  set_aside_.clear();
  std::uint32_t middle = range.begin;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const Cell cell = cells_[i];
    if (is_first(between(chord.from, cell))) {
      cells_[middle++] = cell;
    } else {
      set_aside_.push_back(cell);
    }
  }
  std::copy(set_aside_.begin(), set_aside_.end(), cells_.begin() + middle);
  pending_.push_back({middle, range.end});
  pending_.push_back({range.begin, middle});
}

void ObstacleClusters::emit(std::span<const Cell> vertices) {
  clusters_.push_back({static_cast<std::uint32_t>(vertices.size()), 0, nullptr});
  for (const Cell& vertex : vertices) vertices_.push_back(center_of(vertex));
}

void ObstacleClusters::forget_cells() {
  for (const Cell& cell : found_) index_at(cell.column, cell.row) = none;
}

}  // namespace dmrp::core
