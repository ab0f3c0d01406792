// SPDX-License-Identifier: MIT
#include "controllers/dwa/wave_front.hpp"

#include <algorithm>
#include <limits>

namespace dmrp::controllers::dwa {

void Terrain::read(const CostmapView& map, std::uint8_t highest_free_cost) {
  stride_ = map.width() + 2;
  const std::size_t size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(map.height() + 2);
  marks_.resize(size);
  std::fill_n(marks_.begin(), stride_, blocked);
  for (std::int32_t row = 0; row < map.height(); ++row) {
    const std::uint8_t* costs = map.costs() + row * map.width();
    std::uint16_t* marks = marks_.data() + (row + 1) * stride_;
    marks[0] = blocked;
    for (std::int32_t column = 0; column < map.width(); ++column)
      marks[column + 1] = costs[column] > highest_free_cost ? blocked : unreached;
    marks[stride_ - 1] = blocked;
  }
  std::fill_n(marks_.end() - stride_, stride_, blocked);
  requested_count_ = 0;
}

void Terrain::request(std::int32_t first_column, std::int32_t last_column, std::int32_t first_row,
                      std::int32_t last_row) {
  const std::int32_t rows = static_cast<std::int32_t>(marks_.size()) / stride_;
  // marks_ has a border of one cell
  const std::int32_t first = std::max(1, first_column + 1);
  const std::int32_t last = std::min(stride_ - 2, last_column + 1);
  for (std::int32_t row = std::max(1, first_row + 1); row <= std::min(rows - 2, last_row + 1); ++row) {
    std::uint16_t* marks = marks_.data() + row * stride_;
    for (std::int32_t column = first; column <= last; ++column) {
      if (marks[column] != unreached) continue;
      marks[column] = requested;
      ++requested_count_;
    }
  }
}

void Terrain::request(std::int32_t index) {
  std::uint16_t& mark = marks_[static_cast<std::size_t>(index)];
  requested_count_ += mark == unreached;
  mark = requested;
}

std::int32_t Terrain::nearest_free(std::int32_t index, std::int32_t reach) const {
  if (index < 0 || is_free(index)) return index;
  const std::int32_t column = index % stride_;
  const std::int32_t row = index / stride_;
  const std::int32_t rows = static_cast<std::int32_t>(marks_.size()) / stride_;
  std::int32_t nearest = -1;
  std::int32_t nearest_squared = std::numeric_limits<std::int32_t>::max();
  for (std::int32_t r = std::max(1, row - reach); r <= std::min(rows - 2, row + reach); ++r) {
    for (std::int32_t c = std::max(1, column - reach); c <= std::min(stride_ - 2, column + reach); ++c) {
      const std::int32_t squared = (r - row) * (r - row) + (c - column) * (c - column);
      if (squared < nearest_squared && is_free(r * stride_ + c)) {
        nearest = r * stride_ + c;
        nearest_squared = squared;
      }
    }
  }
  return nearest;
}

void WaveFront::begin(const Terrain& terrain, bool everywhere) {
  stride_ = terrain.stride();
  distances_ = terrain.marks();
  queue_.resize(distances_.size());
  queued_ = 0;
  missing_ = everywhere || terrain.requested_count() == 0 ? -1 : terrain.requested_count();
}

void WaveFront::seed(std::int32_t index) {
  const std::uint16_t mark = cells(index);
  if (mark <= Terrain::blocked) return;
  missing_ -= mark == Terrain::requested;
  distances_[static_cast<std::size_t>(index)] = 0;
  queue_[queued_++] = index;
}

void WaveFront::spread() {
  std::uint16_t* distances = distances_.data();
  std::int32_t* queue = queue_.data();
  std::size_t queued = queued_;
  std::int32_t missing = missing_;
  const std::int32_t offsets[4] = {1, -1, stride_, -stride_};
  for (std::size_t next = 0; next < queued && missing != 0; ++next) {
    const std::int32_t from = queue[next];
    const auto distance = static_cast<std::uint16_t>(distances[from] + 1);
    for (const std::int32_t offset : offsets) {
      const std::uint16_t mark = distances[from + offset];
      if (mark <= Terrain::blocked) continue;
      missing -= mark == Terrain::requested;
      distances[from + offset] = distance;
      queue[queued++] = from + offset;
    }
  }
  queued_ = queued;
  missing_ = missing;
}

}  // namespace dmrp::controllers::dwa
