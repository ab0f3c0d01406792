// SPDX-License-Identifier: MIT
// wave_front.hpp: distances over the free cells of the costmap's window, by breadth-first search from seeds. A front
// may end early, as soon as it has reached all that anybody will ask for.
#ifndef DMRP_CONTROLLERS_DWA_WAVE_FRONT_HPP
#define DMRP_CONTROLLERS_DWA_WAVE_FRONT_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "controllers/motion/costmap_view.hpp"

namespace dmrp::controllers::dwa {

// Where a front can spread: the window's cells, up to a highest cost, within a frame of blocked cells, so that no
// neighbour needs a bounds check.
class Terrain {
 public:
  static constexpr std::uint16_t blocked = 0xFFFD;
  static constexpr std::uint16_t unreached = 0xFFFE;
  static constexpr std::uint16_t wanted = 0xFFFF;  // unreached, and somebody will ask for it

  // Blocked above the one cost; close to an obstacle above the other, lower one.
  void read(const CostmapView& map, std::uint8_t highest_free_cost, std::uint8_t highest_easy_cost);

  // Fronts end once they have reached all free cells of this rectangle, and of those wanted before; columns and rows of
  // the costmap, the last ones included.
  void want(std::int32_t first_column, std::int32_t last_column, std::int32_t first_row, std::int32_t last_row);

  // As an index into marks(); -1 outside the window.
  std::int32_t index_of(const CostmapView& map, double x, double y) const {
    const std::int32_t column = map.column_of(x);
    const std::int32_t row = map.row_of(y);
    return map.contains(column, row) ? (row + 1) * stride_ + column + 1 : -1;
  }
  bool is_free(std::int32_t index) const { return index >= 0 && marks_[static_cast<std::size_t>(index)] > blocked; }

  // The free cell nearest to `index` within `reach` cells, itself first; -1 where there is none.
  std::int32_t nearest_free(std::int32_t index, std::int32_t reach) const;

  std::int32_t stride() const { return stride_; }
  std::int32_t wanted_count() const { return wanted_count_; }
  const std::vector<std::uint16_t>& marks() const { return marks_; }     // blocked, unreached or wanted
  const std::vector<std::uint8_t>& efforts() const { return efforts_; }  // what a step onto a cell counts

 private:
  std::int32_t stride_ = 0;
  std::int32_t wanted_count_ = 0;
  std::vector<std::uint16_t> marks_;
  std::vector<std::uint8_t> efforts_;
};

// A step onto a cell that is close to an obstacle counts as so many where efforts count.
inline constexpr std::uint8_t close_effort = 3;

// Steps from free cells to the nearest seed, over the four sides of cells. Keeps its buffers.
class WaveFront {
 public:
  // For what the terrain wants; for every free cell if it wants nothing in particular, or `everywhere` is set.
  void begin(const Terrain& terrain, bool everywhere = false);
  void seed(std::int32_t index);  // nothing where that is no free cell
  void spread();

  // The same with steps close to obstacles counted by their effort: the way back to the seeds keeps its distance where
  // it can. (The way that hugs an obstacle leaves a robot no room to turn away from it.)
  void spread_by_effort(const Terrain& terrain);

  bool reached(std::int32_t index) const { return index >= 0 && cells(index) < Terrain::blocked; }
  std::uint16_t cells(std::int32_t index) const { return distances_[static_cast<std::size_t>(index)]; }

 private:
  std::int32_t stride_ = 0;
  std::vector<std::uint16_t> distances_;
  std::vector<std::int32_t> queue_;  // breadth-first, from the seeds on
  std::size_t queued_ = 0;
  std::int32_t missing_ = 0;  // cells wanted and not reached yet; negative: every cell is wanted
  std::array<std::vector<std::int32_t>, close_effort + 1> rings_;  // cells by distance, modulo the number of rings
};

}  // namespace dmrp::controllers::dwa

#endif
