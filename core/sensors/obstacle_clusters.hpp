// SPDX-License-Identifier: MIT
// obstacle_clusters.hpp: the lethal cells of a costmap as few convex shapes.
#pragma once

#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/observation.h>

#include <algorithm>
#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <span>
#include <vector>

namespace dmrp::core {

// Cells that hang together (nearer than twice the tolerance) are taken as one shape where that keeps the promises of
// ext/obstacle_clusters.h, and are split where it does not: curves where they are farthest from the chord between their
// ends, as Douglas and Peucker do, the rest at gaps. What is at most a cell off a straight line becomes a segment.
//
// Geometry is exact, in whole cells; what hangs together comes in the order of its first cells, row by row. Keeps its
// buffers: no allocation once it has seen the fullest costmap.
class ObstacleClusters {
 public:
  // Of the costmap's tolerance: one and a half cells. More than a cell's diagonal, so that a lethal cell accounts for
  // the squares that meet at its centre.
  static constexpr double tolerance_cells = 1.5;

  // Cells up to this far outside an agent's disc are the agent.
  static constexpr double agent_margin_m = 0.1;

  // The clusters of all lethal cells but those that the agents account for. Valid until the next call.
  const dmrp_obstacle_cluster_list& derive(const dmrp_costmap& costmap, std::span<const dmrp_agent> agents);

 private:
  struct Cell {
    std::int64_t column;
    std::int64_t row;
  };

  // Of cells_: some of those that hang together, in row-major order.
  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
  };

  // Between the two vertices of the hull that are farthest from each other, in cells.
  struct Chord {
    Cell from;
    Cell along;  // from there to the other end
    double length;
    double left;  // how far the hull reaches on either side
    double right;
    Cell farthest;  // the vertex that does

    double deviation() const { return std::max(left, right); }
  };

  // A stretch of a chord without cells.
  struct Gap {
    bool exists;
    double projection;  // of its middle, times the chord's length
  };

  void collect_cells(const dmrp_costmap& costmap, std::span<const dmrp_agent> agents);
  void unite_neighbors();
  void group_components();
  std::uint32_t root_of(std::uint32_t cell);
  void cluster(Range range);
  void find_hull(Range range);
  Chord longest_chord() const;
  Gap gap_in(const Chord& chord, Range range);
  bool hull_is_filled(std::size_t cell_count) const;
  bool row_is_filled(std::int64_t row) const;
  void drop_flat_vertices();
  template <class IsFirst>
  void split(Range range, const Chord& chord, const IsFirst& is_first);
  void emit(std::span<const Cell> vertices);
  void forget_cells();

  dmrp_vec2 center_of(const Cell& cell) const {
    return origin_ +
           resolution_m_ * dmrp_vec2{static_cast<double>(cell.column) + 0.5, static_cast<double>(cell.row) + 0.5};
  }
  const std::int32_t* cell_at(std::int64_t column, std::int64_t row) const {
    return &index_[static_cast<std::size_t>((row + border) * stride_ + column + border)];
  }
  std::int32_t& index_at(std::int64_t column, std::int64_t row) {
    return index_[static_cast<std::size_t>((row + border) * stride_ + column + border)];
  }

  static constexpr std::int64_t border = 3;  // cells: no neighbour is farther

  std::int64_t stride_ = 0;
  std::vector<std::int32_t> index_;  // by place, with a border: a cell's index, or none; all none between calls
  std::vector<Cell> found_;          // row-major
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> offsets_;
  std::vector<Cell> cells_;  // by component, in each row-major
  std::vector<Range> pending_;
  std::vector<Cell> hull_;  // counter-clockwise
  std::vector<Cell> set_aside_;
  struct Stretch {
    double begin;
    double end;
  };
  std::vector<Stretch> stretches_;  // of a chord that its cells account for, by whole cells of projection
  std::vector<dmrp_agent> near_;

  dmrp_vec2 origin_{};
  double resolution_m_ = 0.0;
  std::vector<dmrp_vec2> vertices_;
  std::vector<dmrp_obstacle_cluster> clusters_;
  dmrp_obstacle_cluster_list list_{};
};

}  // namespace dmrp::core
