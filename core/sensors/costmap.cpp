// SPDX-License-Identifier: MIT
#include "core/sensors/costmap.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::core {
namespace {

// Hits are marked this far behind the surface: otherwise a wall along the lattice would alternate between two rows.
constexpr double behind_surface_m = 1e-4;

// Lines end this far inside the window, in cells, so that rounding cannot move them outside.
constexpr double inset_cells = 1e-9;

// Fraction bits of a cell position in fixed point: precise enough for inset_cells on the longest line, with enough
// integer bits for the largest window.
constexpr int fraction_bits = 44;

// Rows of the stamp are a multiple of this length, so that the compiler can vectorise.
constexpr std::int64_t vector_bytes = 16;

// The cost function of costmap_2d, including its truncation.
std::uint8_t cost_at(double distance_m, double inscribed_radius_m, const CostmapSettings& settings) {
  if (distance_m == 0.0) return DMRP_COST_LETHAL;
  if (distance_m <= inscribed_radius_m) return DMRP_COST_INSCRIBED;
  if (distance_m > settings.inflation_radius_m) return DMRP_COST_FREE;
  const double share = std::exp(-settings.cost_scaling * (distance_m - inscribed_radius_m));
  return static_cast<std::uint8_t>((DMRP_COST_INSCRIBED - 1) * share);
}

// Sets each of `vector_bytes` costs to the larger of both.
void keep_larger(std::uint8_t* costs, const std::uint8_t* others) {
  std::array<std::uint8_t, vector_bytes> mine;
  std::array<std::uint8_t, vector_bytes> theirs;
  std::memcpy(mine.data(), costs, vector_bytes);
  std::memcpy(theirs.data(), others, vector_bytes);
  for (std::size_t i = 0; i < vector_bytes; ++i) mine[i] = std::max(mine[i], theirs[i]);
  std::memcpy(costs, mine.data(), vector_bytes);
}

// The number of drop-outs in a row whose probability is at most 1e-6.
std::uint8_t misses_to_clear(double share) {
  std::uint8_t count = 1;
  for (double chance = share; chance > 1e-6 && count < 255; chance *= share) ++count;
  return count;
}

// The first nonzero cell from `cell` on; `end` if there is none.
const std::uint8_t* next_lethal(const std::uint8_t* cell, const std::uint8_t* end) {
  std::uint64_t cells = 0;
  while (end - cell >= std::ptrdiff_t{sizeof(cells)}) {
    std::memcpy(&cells, cell, sizeof(cells));
    if (cells != 0) break;
    cell += sizeof(cells);
  }
  while (cell < end && *cell == 0) ++cell;
  return cell;
}

// The point where a line from inside the square [least, most]^2 leaves it, or `to`.
dmrp_vec2 clip_to_square(dmrp_vec2 from, dmrp_vec2 to, double least, double most) {
  const auto fraction = [least, most](double start, double end) {
    if (end < least) return (start - least) / (start - end);
    return end > most ? (most - start) / (end - start) : 1.0;
  };
  return toolkit::lerp(from, to, std::min(fraction(from.x, to.x), fraction(from.y, to.y)));
}

}  // namespace

LocalCostmap::LocalCostmap(const CostmapSettings& settings, double inscribed_radius_m, double dropout_share)
    : settings_(settings),
      side_(std::max(1L, std::lround(settings.window_m / settings.resolution_m))),
      misses_to_clear_(misses_to_clear(dropout_share)) {
  assert(dropout_share >= 0.0 && dropout_share < 1.0);
  const auto cells = static_cast<std::size_t>(side_ * side_);
  lethal_.resize(cells);
  rolled_.resize(cells);
  costs_.resize(cells);
  make_stamp(inscribed_radius_m);

  costmap_.struct_size = sizeof(costmap_);
  costmap_.width = static_cast<std::uint32_t>(side_);
  costmap_.height = costmap_.width;
  costmap_.resolution_m = settings.resolution_m;
  costmap_.inscribed_radius_m = inscribed_radius_m;
  costmap_.inflation_radius_m = settings.inflation_radius_m;
  costmap_.cost_scaling = settings.cost_scaling;
  costmap_.costs = costs_.data();
}

void LocalCostmap::make_stamp(double inscribed_radius_m) {
  const double furthest_m = std::max(inscribed_radius_m, settings_.inflation_radius_m);
  stamp_reach_ = static_cast<std::int64_t>(furthest_m / settings_.resolution_m + 1e-9);
  const std::int64_t width = 2 * stamp_reach_ + 1;
  stamp_stride_ = (width + vector_bytes - 1) / vector_bytes * vector_bytes;
  stamp_.assign(static_cast<std::size_t>(width * stamp_stride_), DMRP_COST_FREE);
  for (std::int64_t row = 0; row < width; ++row) {
    for (std::int64_t column = 0; column < width; ++column) {
      const double distance_m = settings_.resolution_m * std::hypot(static_cast<double>(row - stamp_reach_),
                                                                    static_cast<double>(column - stamp_reach_));
      stamp_[static_cast<std::size_t>(row * stamp_stride_ + column)] =
          cost_at(distance_m, inscribed_radius_m, settings_);
    }
  }
  canvas_.resize(static_cast<std::size_t>((side_ + 2 * stamp_reach_) * (side_ + stamp_stride_)));
}

void LocalCostmap::reset() {
  is_placed_ = false;
  field_is_fresh_ = false;
  std::fill(lethal_.begin(), lethal_.end(), std::uint8_t{0});
  std::fill(costs_.begin(), costs_.end(), std::uint8_t{DMRP_COST_FREE});
}

void LocalCostmap::update(const dmrp_pose& sensor, const dmrp_scan& scan) {
  assert(toolkit::is_finite(toolkit::position(sensor)) && (scan.ranges || scan.count == 0));
  roll_to(toolkit::position(sensor));

  aim_beams(sensor, scan);
  // In cells from the window's lower left corner.
  const dmrp_vec2 corner = {static_cast<double>(column_), static_cast<double>(row_)};
  const dmrp_vec2 origin = toolkit::position(sensor) / settings_.resolution_m - corner;
  if (misses_to_clear_ > 1) {
    // Before clearing: obstacles that hide others must still be present.
    for (std::uint32_t beam = 0; beam < scan.count; ++beam)
      if (std::isinf(scan.ranges[beam]))
        count_miss_along(origin, origin + settings_.raytrace_range_m * cells_per_metre_[beam]);
  }
  for (std::uint32_t beam = 0; beam < scan.count; ++beam) {
    if (misses_to_clear_ > 1 && std::isinf(scan.ranges[beam])) continue;
    const double range_m = std::min(static_cast<double>(scan.ranges[beam]), settings_.raytrace_range_m);
    clear_along(origin, origin + range_m * cells_per_metre_[beam]);
  }
  for (std::uint32_t beam = 0; beam < scan.count; ++beam) {
    const double range_m = static_cast<double>(scan.ranges[beam]);
    if (range_m < settings_.obstacle_range_m) mark(origin + (range_m + behind_surface_m) * cells_per_metre_[beam]);
  }
  inflate();
  costmap_.t_ns = scan.t_ns;
  costmap_.origin = {static_cast<double>(column_) * settings_.resolution_m,
                     static_cast<double>(row_) * settings_.resolution_m};
  field_is_fresh_ = false;
}

void LocalCostmap::aim_beams(const dmrp_pose& sensor, const dmrp_scan& scan) {
  if (scan.count != directions_.size() || scan.angle_min != angle_min_ || scan.angle_increment != angle_increment_) {
    angle_min_ = scan.angle_min;
    angle_increment_ = scan.angle_increment;
    directions_.clear();
    for (std::uint32_t beam = 0; beam < scan.count; ++beam)
      directions_.push_back(toolkit::from_angle(angle_min_ + beam * angle_increment_));
    cells_per_metre_.resize(scan.count);
  }
  const dmrp_vec2 ahead = toolkit::from_angle(sensor.theta) / settings_.resolution_m;
  for (std::size_t beam = 0; beam < directions_.size(); ++beam)
    cells_per_metre_[beam] = directions_[beam].x * ahead + directions_[beam].y * toolkit::perpendicular(ahead);
}

// Cells that leave the window are discarded.
void LocalCostmap::roll_to(dmrp_vec2 center) {
  const auto lattice = [&](double metres) {
    return static_cast<std::int64_t>(std::floor(metres / settings_.resolution_m)) - side_ / 2;
  };
  const std::int64_t columns = is_placed_ ? lattice(center.x) - column_ : side_;
  const std::int64_t rows = is_placed_ ? lattice(center.y) - row_ : side_;
  column_ = lattice(center.x);
  row_ = lattice(center.y);
  is_placed_ = true;
  if (columns == 0 && rows == 0) return;

  std::fill(rolled_.begin(), rolled_.end(), std::uint8_t{0});
  const std::int64_t kept = side_ - std::abs(columns);
  if (kept > 0) {
    for (std::int64_t row = std::max<std::int64_t>(0, -rows); row < std::min(side_, side_ - rows); ++row) {
      const std::uint8_t* const source = lethal_.data() + (row + rows) * side_ + std::max<std::int64_t>(0, columns);
      std::memcpy(rolled_.data() + row * side_ + std::max<std::int64_t>(0, -columns), source,
                  static_cast<std::size_t>(kept));
    }
  }
  std::swap(lethal_, rolled_);
}

// Clears one cell in every column that the line crosses, or in every row if the line is steep.
void LocalCostmap::clear_along(dmrp_vec2 from, dmrp_vec2 to) {
  to = clip_to_square(from, to, inset_cells, static_cast<double>(side_) - inset_cells);
  const dmrp_vec2 way = to - from;
  const bool by_columns = std::abs(way.x) >= std::abs(way.y);
  const double start = by_columns ? from.x : from.y;
  const double end = by_columns ? to.x : to.y;
  const double aside = by_columns ? from.y : from.x;
  const double slope = end == start ? 0.0 : (by_columns ? way.y / way.x : way.x / way.y);
  const std::int64_t stride = by_columns ? 1 : side_;
  const std::int64_t cross_stride = by_columns ? side_ : 1;
  const double low = std::min(start, end);
  const double high = std::max(start, end);
  const auto first = static_cast<std::int64_t>(low);
  const auto last = static_cast<std::int64_t>(high);
  std::uint8_t* const cells = lethal_.data();
  const auto clear_at = [&](std::int64_t major, double at) {
    cells[major * stride + static_cast<std::int64_t>(aside + slope * (at - start)) * cross_stride] = 0;
  };
  // The ends first and last; between them from middle to middle in fixed point.
  const double unit = static_cast<double>(std::int64_t{1} << fraction_bits);
  const auto step = static_cast<std::int64_t>(slope * unit);
  auto minor = static_cast<std::int64_t>((aside + slope * (static_cast<double>(first) + 1.5 - start)) * unit);
  clear_at(first, low);
  clear_at(first, std::clamp(static_cast<double>(first) + 0.5, low, high));
  for (std::int64_t major = first + 1; major < last; ++major, minor += step)
    cells[major * stride + (minor >> fraction_bits) * cross_stride] = 0;
  clear_at(last, std::clamp(static_cast<double>(last) + 0.5, low, high));
  clear_at(last, high);
}

// Counts a miss of the nearest lethal cell on the line; cells behind it may be hidden.
void LocalCostmap::count_miss_along(dmrp_vec2 from, dmrp_vec2 to) {
  to = clip_to_square(from, to, inset_cells, static_cast<double>(side_) - inset_cells);
  const dmrp_vec2 way = to - from;
  const double steps = std::floor(std::max(std::abs(way.x), std::abs(way.y)));
  const dmrp_vec2 stride = way / std::max(std::max(std::abs(way.x), std::abs(way.y)), 1.0);
  for (double i = 0.0; i <= steps; ++i) {
    const dmrp_vec2 at = from + i * stride;
    std::uint8_t& cell =
        lethal_[static_cast<std::size_t>(static_cast<std::int64_t>(at.y) * side_ + static_cast<std::int64_t>(at.x))];
    if (cell == 0) continue;
    --cell;
    return;
  }
}

void LocalCostmap::mark(dmrp_vec2 point) {
  const double side = static_cast<double>(side_);
  if (!(point.x >= 0.0 && point.x < side && point.y >= 0.0 && point.y < side)) return;
  lethal_[static_cast<std::size_t>(static_cast<std::int64_t>(point.y) * side_ + static_cast<std::int64_t>(point.x))] =
      misses_to_clear_;
}

// The cost decreases with distance, so the maximum over all lethal cells is the cost of the nearest one: exact.
void LocalCostmap::inflate() {
  std::fill(canvas_.begin(), canvas_.end(), std::uint8_t{DMRP_COST_FREE});
  const std::int64_t canvas_stride = side_ + stamp_stride_;
  const std::int64_t stamp_stride = stamp_stride_;
  const std::int64_t stamp_rows = 2 * stamp_reach_ + 1;
  const std::uint8_t* const begin = lethal_.data();
  const std::uint8_t* const end = begin + lethal_.size();
  for (const std::uint8_t* cell = next_lethal(begin, end); cell < end; cell = next_lethal(cell + 1, end)) {
    // The canvas begins stamp_reach_ cells before the window on both axes.
    std::uint8_t* target = canvas_.data() + (cell - begin) / side_ * canvas_stride + (cell - begin) % side_;
    const std::uint8_t* source = stamp_.data();
    for (std::int64_t row = 0; row < stamp_rows; ++row) {
      for (std::int64_t i = 0; i < stamp_stride; i += vector_bytes) keep_larger(target + i, source + i);
      target += canvas_stride;
      source += stamp_stride;
    }
  }
  for (std::int64_t row = 0; row < side_; ++row) {
    std::memcpy(costs_.data() + row * side_, canvas_.data() + (row + stamp_reach_) * canvas_stride + stamp_reach_,
                static_cast<std::size_t>(side_));
  }
}

const dmrp_field& LocalCostmap::distance_field() {
  if (field_is_fresh_) return field_;
  const double cap_m = settings_.window_m;
  const std::vector<float>& distances =
      transform_.compute(costmap_.width, costmap_.height, settings_.resolution_m, lethal_.data(), cap_m);
  field_.struct_size = sizeof(field_);
  field_.width = costmap_.width;
  field_.height = costmap_.height;
  field_.t_ns = costmap_.t_ns;
  field_.resolution_m = settings_.resolution_m;
  field_.origin = costmap_.origin;
  field_.distance_max_m = cap_m;
  field_.distances_m = distances.data();
  field_is_fresh_ = true;
  return field_;
}

}  // namespace dmrp::core
