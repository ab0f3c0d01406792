// SPDX-License-Identifier: MIT
#include "core/sensors/obstacle_clusters.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace dmrp::core {
namespace {

constexpr std::int32_t none = -1;

// Cells whose hull lies within this distance of its longest chord are straight. All cells that a straight line crosses
// satisfy this.
constexpr double straight_cells = 1.25;

// Polygons may lie this far inside the hull of their cells.
constexpr double flat_cells = 0.5;

// Offsets to the preceding cells, in row-major order, whose distance is at most three cells: two tolerances.
constexpr std::array<LatticeCell, 14> neighbors_before = {{{-3, 0},
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

}  // namespace

const dmrp_obstacle_cluster_list& ObstacleClusters::derive(const dmrp_costmap& costmap,
                                                           std::span<const dmrp_agent> agents) {
  assert(costmap.costs && costmap.resolution_m > 0.0);
  vertices_.clear();
  clusters_.clear();
  collect_cells(costmap, agents);
  unite_neighbors();
  group_components();
  clear_index();

  // vertices_ has been reallocated while it grew.
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
    const LatticeCell cell = {(cost - begin) % width, (cost - begin) / width};
    if (is_agent(center_of(cell))) continue;
    index_at(cell.column, cell.row) = static_cast<std::int32_t>(found_.size());
    found_.push_back(cell);
  }
}

// Builds the union-find forest of the cells; the root is the first cell of its component.
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

// Sorts the cells by component, keeping the order within, and clusters one component after the other.
void ObstacleClusters::group_components() {
  offsets_.assign(found_.size() + 1, 0);
  for (std::uint32_t i = 0; i < found_.size(); ++i) ++offsets_[root_of(i) + 1];
  for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
  cells_.resize(found_.size());
  for (std::uint32_t i = 0; i < found_.size(); ++i) cells_[offsets_[root_of(i)]++] = found_[i];

  // Now offsets_[i] is the end of the component of root i.
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
    find_hull(cells_in(range), hull_);
    if (hull_.size() == 1) {
      emit(hull_);
      continue;
    }
    const Chord chord = longest_chord(hull_);
    if (chord.deviation() <= straight_cells) {
      const Gap gap = gap_in(chord, range);
      if (gap.exists) {
        split(range, chord,
              [&](const LatticeCell& off) { return static_cast<double>(dot(chord.along, off)) <= gap.projection; });
      } else {
        emit(std::array<LatticeCell, 2>{
            {chord.from, {chord.from.column + chord.along.column, chord.from.row + chord.along.row}}});
      }
    } else if (hull_is_filled(range.end - range.begin)) {
      drop_flat_vertices(hull_, scratch_, flat_cells);
      emit(hull_);
    } else if (chord.left > straight_cells && chord.right > straight_cells) {
      split(range, chord, [&](const LatticeCell& off) { return cross(chord.along, off) > 0; });
    } else {
      const std::int64_t projection = dot(chord.along, between(chord.from, chord.farthest));
      split(range, chord, [&](const LatticeCell& off) { return dot(chord.along, off) <= projection; });
    }
  }
}

// The first part of a chord that no cell covers. Each cell is near the chord and covers more than half a cell on both
// sides, so all cells in the same whole cell of projection cover one stretch together.
ObstacleClusters::Gap ObstacleClusters::gap_in(const Chord& chord, Range range) {
  constexpr Stretch nothing = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  stretches_.assign(static_cast<std::size_t>(chord.length) + 1, nothing);
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const LatticeCell there = between(chord.from, cells_[i]);
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

// Whether every square between four cell centres that the hull overlaps has a lethal cell at one of its corners.
bool ObstacleClusters::hull_is_filled(std::size_t cell_count) const {
  if (doubled_area(hull_) > 8 * static_cast<std::int64_t>(cell_count))
    return false;  // a cell accounts for four squares
  const auto [lowest, highest] = std::minmax_element(
      hull_.begin(), hull_.end(), [](const LatticeCell& a, const LatticeCell& b) { return a.row < b.row; });
  for (std::int64_t row = lowest->row; row < highest->row; ++row)
    if (!row_is_filled(row)) return false;
  return true;
}

// Checks the squares between this row of centres and the next.
bool ObstacleClusters::row_is_filled(std::int64_t row) const {
  const ColumnRange columns = columns_beside(hull_, row);
  for (std::int64_t column = columns.first; column < columns.last; ++column) {
    const std::int32_t* const corner = cell_at(column, row);
    if (corner[0] == none && corner[1] == none && corner[stride_] == none && corner[stride_ + 1] == none) return false;
  }
  return true;
}

// Splits a range by `is_first(vector from the chord's beginning to the cell)`; both parts keep their order.
template <class IsFirst>
void ObstacleClusters::split(Range range, const Chord& chord, const IsFirst& is_first) {
  scratch_.clear();
  std::uint32_t middle = range.begin;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const LatticeCell cell = cells_[i];
    if (is_first(between(chord.from, cell))) {
      cells_[middle++] = cell;
    } else {
      scratch_.push_back(cell);
    }
  }
  std::copy(scratch_.begin(), scratch_.end(), cells_.begin() + middle);
  pending_.push_back({middle, range.end});
  pending_.push_back({range.begin, middle});
}

void ObstacleClusters::emit(std::span<const LatticeCell> vertices) {
  clusters_.push_back({static_cast<std::uint32_t>(vertices.size()), 0, nullptr});
  for (const LatticeCell& vertex : vertices) vertices_.push_back(center_of(vertex));
}

void ObstacleClusters::clear_index() {
  for (const LatticeCell& cell : found_) index_at(cell.column, cell.row) = none;
}

}  // namespace dmrp::core
