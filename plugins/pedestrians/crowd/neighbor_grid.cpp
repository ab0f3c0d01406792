// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/neighbor_grid.hpp"

#include <cassert>
#include <cmath>

namespace dmrp::pedestrians {

void NeighborGrid::start(Vec2 lower, Vec2 upper, double cell_m) {
  assert(lower.x <= upper.x && lower.y <= upper.y && cell_m > 0.0);
  lower_ = lower;
  cells_per_m_ = 1.0 / cell_m;
  const auto count = [&](double extent_m) {
    return std::max(static_cast<std::int32_t>(std::ceil(extent_m * cells_per_m_)), 1);
  };
  columns_ = count(upper.x - lower.x);
  rows_ = count(upper.y - lower.y);
  begins_.assign(cell(0, rows_) + 1, 0);
  sorted_.clear();
  positions_.clear();
  found_.clear();
}

void NeighborGrid::build(const std::vector<Body>& bodies) {
  // count the bodies of every cell, one entry further on
  std::fill(begins_.begin(), begins_.end(), 0u);
  cell_of_body_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::size_t at = cell(column_of(bodies[i].position.x), row_of(bodies[i].position.y));
    cell_of_body_[i] = static_cast<std::uint32_t>(at);
    ++begins_[at + 1];
  }
  for (std::size_t c = 1; c < begins_.size(); ++c) begins_[c] += begins_[c - 1];

  // insert every body at its cell's begin and advance that; afterwards each begin is the end of its cell
  sorted_.resize(bodies.size());
  positions_.resize(bodies.size());
  found_.resize(bodies.size() + 1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::uint32_t place = begins_[cell_of_body_[i]]++;
    sorted_[place] = bodies[i];
    positions_[place] = bodies[i].position;
  }
  for (std::size_t c = begins_.size() - 1; c > 0; --c) begins_[c] = begins_[c - 1];
  begins_[0] = 0;
}

}  // namespace dmrp::pedestrians
