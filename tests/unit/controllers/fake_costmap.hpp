// SPDX-License-Identifier: MIT
// fake_costmap.hpp: a costmap with lethal cells at given points, inflated according to the contract.
#pragma once

#include <dmrp/ext/local_costmap.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dmrp::test {

class FakeCostmap {
 public:
  // Starts at the world's origin; for a robot with a radius of 0.25 m.
  explicit FakeCostmap(std::uint32_t side_cells) : side_(side_cells), costs_(side_cells * side_cells, DMRP_COST_FREE) {}

  // Marks a lethal cell and inflates it.
  void mark(double x, double y) {
    const int column = static_cast<int>(x / resolution_m);
    const int row = static_cast<int>(y / resolution_m);
    for (int r = std::max(0, row - reach); r <= std::min(static_cast<int>(side_) - 1, row + reach); ++r) {
      for (int c = std::max(0, column - reach); c <= std::min(static_cast<int>(side_) - 1, column + reach); ++c) {
        std::uint8_t& cost = costs_[static_cast<std::size_t>(r) * side_ + static_cast<std::size_t>(c)];
        cost = std::max(cost, cost_at(resolution_m * std::hypot(r - row, c - column)));
      }
    }
  }

  dmrp_costmap c() const {
    return {sizeof(dmrp_costmap), side_, side_, 0, 0, resolution_m, {0.0, 0.0}, 0.25, 0.55, 5.0, costs_.data()};
  }

  static constexpr double resolution_m = 0.05;

 private:
  static constexpr int reach = 11;
  static std::uint8_t cost_at(double distance_m) {
    if (distance_m == 0.0) return DMRP_COST_LETHAL;
    if (distance_m < 0.25 - 1e-9) return DMRP_COST_INSCRIBED;
    if (distance_m > 0.55 + 1e-9) return DMRP_COST_FREE;
    return static_cast<std::uint8_t>(252.0 * std::exp(-5.0 * (distance_m - 0.25)));
  }

  std::uint32_t side_;
  std::vector<std::uint8_t> costs_;
};

}  // namespace dmrp::test
