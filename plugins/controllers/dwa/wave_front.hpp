// SPDX-License-Identifier: MIT
// wave_front.hpp: distances over the free cells of the costmap's window, by breadth-first search from seeds.
#ifndef DMRP_CONTROLLERS_DWA_WAVE_FRONT_HPP
#define DMRP_CONTROLLERS_DWA_WAVE_FRONT_HPP

#include <cstdint>
#include <vector>

#include "../motion/costmap_view.hpp"

namespace dmrp::controllers::dwa {

// Where a front can spread: the window's cells, up to a highest cost, within a frame of blocked cells, so that no
// neighbour needs a bounds check.
class Terrain {
 public:
  static constexpr std::uint16_t unreached = 0xFFFF;
  static constexpr std::uint16_t blocked = 0xFFFE;

  void read(const CostmapView& map, std::uint8_t highest_cost);

  // As an index into marks(); -1 outside the window.
  std::int32_t index_of(const CostmapView& map, double x, double y) const {
    const std::int32_t column = map.column_of(x);
    const std::int32_t row = map.row_of(y);
    return map.contains(column, row) ? (row + 1) * stride_ + column + 1 : -1;
  }
  bool is_free(std::int32_t index) const { return index >= 0 && marks_[static_cast<std::size_t>(index)] == unreached; }

  // The free cell nearest to `index` within `reach` cells, itself first; -1 where there is none.
  std::int32_t nearest_free(std::int32_t index, std::int32_t reach) const;

  std::int32_t stride() const { return stride_; }
  const std::vector<std::uint16_t>& marks() const { return marks_; }  // blocked or unreached

 private:
  std::int32_t stride_ = 0;
  std::vector<std::uint16_t> marks_;
};

// Steps from every free cell to the nearest seed, over the four sides of cells. Keeps its buffers.
class WaveFront {
 public:
  void begin(const Terrain& terrain);
  void seed(std::int32_t index);  // of a free cell
  void spread();

  bool reached(std::int32_t index) const { return index >= 0 && cells(index) < Terrain::blocked; }
  std::uint16_t cells(std::int32_t index) const { return distances_[static_cast<std::size_t>(index)]; }

 private:
  std::int32_t stride_ = 0;
  std::vector<std::uint16_t> distances_;
  std::vector<std::int32_t> queue_;
  std::size_t queued_ = 0;
};

}  // namespace dmrp::controllers::dwa

#endif
