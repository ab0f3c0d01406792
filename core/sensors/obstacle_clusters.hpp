// SPDX-License-Identifier: MIT
// obstacle_clusters.hpp: covers the lethal cells of a costmap with a small number of convex shapes.
#pragma once

#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/observation.h>

#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <span>
#include <vector>

#include "core/sensors/cell_hull.hpp"

namespace dmrp::core {

// Connected cells (nearer than twice the tolerance) form one shape if that satisfies the guarantees of
// ext/obstacle_clusters.h, and are split otherwise: curves where they are farthest from the chord between their ends,
// as by Douglas and Peucker, others at gaps. Cells at most about a cell off a straight line become a segment.
//
// The geometry is exact, in whole cells. Components are ordered by their first cells, row by row. Buffers are kept: no
// allocation after the fullest costmap.
class ObstacleClusters {
 public:
  // The tolerance in cells. More than a cell's diagonal, so that a lethal cell covers the squares that meet at its
  // centre.
  static constexpr double tolerance_cells = 1.5;

  // Cells up to this far outside an agent's disc belong to the agent.
  static constexpr double agent_margin_m = 0.1;

  // The clusters of all lethal cells that do not belong to an agent. Valid until the next call.
  const dmrp_obstacle_cluster_list& derive(const dmrp_costmap& costmap, std::span<const dmrp_agent> agents);

 private:
  // A range of cells_: a part of a component, in row-major order.
  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
  };

  // A part of a chord without cells.
  struct Gap {
    bool exists;
    double projection;  // of its middle, times the chord's length
  };

  void collect_cells(const dmrp_costmap& costmap, std::span<const dmrp_agent> agents);
  void unite_neighbors();
  void group_components();
  std::uint32_t root_of(std::uint32_t cell);
  void cluster(Range range);
  Gap gap_in(const Chord& chord, Range range);
  bool hull_is_filled(std::size_t cell_count) const;
  bool row_is_filled(std::int64_t row) const;
  template <class IsFirst>
  void split(Range range, const Chord& chord, const IsFirst& is_first);
  void emit(std::span<const LatticeCell> vertices);
  void clear_index();

  std::span<const LatticeCell> cells_in(Range range) const {
    return std::span<const LatticeCell>(cells_).subspan(range.begin, range.end - range.begin);
  }
  dmrp_vec2 center_of(const LatticeCell& cell) const {
    return origin_ +
           resolution_m_ * dmrp_vec2{static_cast<double>(cell.column) + 0.5, static_cast<double>(cell.row) + 0.5};
  }
  const std::int32_t* cell_at(std::int64_t column, std::int64_t row) const {
    return &index_[static_cast<std::size_t>((row + border) * stride_ + column + border)];
  }
  std::int32_t& index_at(std::int64_t column, std::int64_t row) {
    return index_[static_cast<std::size_t>((row + border) * stride_ + column + border)];
  }

  static constexpr std::int64_t border = 3;  // cells: the distance of the farthest neighbour

  std::int64_t stride_ = 0;
  std::vector<std::int32_t>
      index_;                       // of the cell at each place of the window with a border, or none; reset after calls
  std::vector<LatticeCell> found_;  // row-major
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> offsets_;
  std::vector<LatticeCell> cells_;  // by component, in each row-major
  std::vector<Range> pending_;
  std::vector<LatticeCell> hull_;  // counter-clockwise
  std::vector<LatticeCell> scratch_;
  struct Stretch {
    double begin;
    double end;
  };
  std::vector<Stretch> stretches_;  // of a chord that its cells cover, by whole cells of projection
  std::vector<dmrp_agent> near_;

  dmrp_vec2 origin_{};
  double resolution_m_ = 0.0;
  std::vector<dmrp_vec2> vertices_;
  std::vector<dmrp_obstacle_cluster> clusters_;
  dmrp_obstacle_cluster_list list_{};
};

}  // namespace dmrp::core
