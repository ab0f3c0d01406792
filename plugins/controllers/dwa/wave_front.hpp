// SPDX-License-Identifier: MIT
// wave_front.hpp: distances over the free cells of the costmap's window, by breadth-first search from seeds. A search
// may end early, as soon as it has reached all requested cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "controllers/motion/costmap_view.hpp"

namespace dmrp::controllers::dwa {

// The cells over which a front can spread: those of the window up to a maximum cost. A border of blocked cells
// surrounds them, so that the search needs no bounds check.
class Terrain {
 public:
  static constexpr std::uint16_t blocked = 0xFFFD;
  static constexpr std::uint16_t unreached = 0xFFFE;
  static constexpr std::uint16_t requested = 0xFFFF;  // unreached and requested

  // Cells above `highest_free_cost` are blocked.
  void read(const CostmapView& map, std::uint8_t highest_free_cost);

  // Requests all free cells of a rectangle, in addition to those requested before: fronts end once they have reached
  // the requested cells. Columns and rows of the costmap; the last ones are included.
  void request(std::int32_t first_column, std::int32_t last_column, std::int32_t first_row, std::int32_t last_row);

  void request(std::int32_t index);  // of a free cell

  // The index into marks(); -1 outside the window.
  std::int32_t index_of(const CostmapView& map, Vec2 point) const {
    const std::int32_t column = map.column_of(point.x);
    const std::int32_t row = map.row_of(point.y);
    return map.contains(column, row) ? (row + 1) * stride_ + column + 1 : -1;
  }
  bool is_free(std::int32_t index) const { return index >= 0 && marks_[static_cast<std::size_t>(index)] > blocked; }

  // The free cell nearest to `index` within `reach` cells, which may be `index` itself; -1 if there is none.
  std::int32_t nearest_free(std::int32_t index, std::int32_t reach) const;

  std::int32_t stride() const { return stride_; }
  std::int32_t requested_count() const { return requested_count_; }
  const std::vector<std::uint16_t>& marks() const { return marks_; }  // blocked, unreached or requested

 private:
  std::int32_t stride_ = 0;
  std::int32_t requested_count_ = 0;
  std::vector<std::uint16_t> marks_;
};

// The number of steps from each free cell to the nearest seed over the 4-connected grid. Reuses its buffers.
class WaveFront {
 public:
  // For the requested cells; for all free cells if none are requested or `everywhere` is set.
  void begin(const Terrain& terrain, bool everywhere = false);
  void seed(std::int32_t index);  // no effect if the cell is not free
  void spread();

  bool reached(std::int32_t index) const { return index >= 0 && cells(index) < Terrain::blocked; }
  std::uint16_t cells(std::int32_t index) const { return distances_[static_cast<std::size_t>(index)]; }

 private:
  std::int32_t stride_ = 0;
  std::vector<std::uint16_t> distances_;
  std::vector<std::int32_t> queue_;  // breadth-first, from the seeds on
  std::size_t queued_ = 0;
  std::int32_t missing_ = 0;  // requested cells not yet reached; negative: all cells are requested
};

}  // namespace dmrp::controllers::dwa
