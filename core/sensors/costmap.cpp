// SPDX-License-Identifier: MIT
#include "core/sensors/costmap.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>
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

// No line that has a cell passes its middle farther away, in cells: half of a diagonal, and rounding.
constexpr double cell_reach = 0.7072;

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

// The point where a line from inside the square [least, most]^2 leaves it, or `to`.
dmrp_vec2 clip_to_square(dmrp_vec2 from, dmrp_vec2 to, double least, double most) {
  const auto fraction = [least, most](double start, double end) {
    if (end < least) return (start - least) / (start - end);
    return end > most ? (most - start) / (end - start) : 1.0;
  };
  return toolkit::lerp(from, to, std::min(fraction(from.x, to.x), fraction(from.y, to.y)));
}

// The cells of a line: one in every column that it crosses, or in every row if it is steep.
class CellLine {
 public:
  CellLine(dmrp_vec2 from, dmrp_vec2 to, std::int64_t side) {
    to = clip_to_square(from, to, inset_cells, static_cast<double>(side) - inset_cells);
    const dmrp_vec2 way = to - from;
    by_columns_ = std::abs(way.x) >= std::abs(way.y);
    start_ = by_columns_ ? from.x : from.y;
    aside_ = by_columns_ ? from.y : from.x;
    const double end = by_columns_ ? to.x : to.y;
    slope_ = end == start_ ? 0.0 : (by_columns_ ? way.y / way.x : way.x / way.y);
    low_ = std::min(start_, end);
    high_ = std::max(start_, end);
    first_ = static_cast<std::int64_t>(low_);
    last_ = static_cast<std::int64_t>(high_);
  }

  bool has(std::int64_t column, std::int64_t row) const {
    const std::int64_t major = by_columns_ ? column : row;
    const std::int64_t minor = by_columns_ ? row : column;
    if (major < first_ || major > last_) return false;
    if (major > first_ && major < last_) return minor == between(major);
    const double middle = std::clamp(static_cast<double>(major) + 0.5, low_, high_);
    return minor == minor_at(middle) || (major == first_ && minor == minor_at(low_)) ||
           (major == last_ && minor == minor_at(high_));
  }

 private:
  std::int64_t minor_at(double at) const { return static_cast<std::int64_t>(aside_ + slope_ * (at - start_)); }

  // Between the ends from middle to middle in fixed point.
  std::int64_t between(std::int64_t major) const {
    const double unit = static_cast<double>(std::int64_t{1} << fraction_bits);
    const auto step = static_cast<std::int64_t>(slope_ * unit);
    const auto second =
        static_cast<std::int64_t>((aside_ + slope_ * (static_cast<double>(first_) + 1.5 - start_)) * unit);
    return (second + (major - first_ - 1) * step) >> fraction_bits;
  }

  bool by_columns_;
  double start_, aside_, slope_, low_, high_;
  std::int64_t first_, last_;
};

}  // namespace

LocalCostmap::LocalCostmap(const CostmapSettings& settings, double inscribed_radius_m, double dropout_share)
    : settings_(settings),
      side_(std::max(1L, std::lround(settings.window_m / settings.resolution_m))),
      misses_to_clear_(misses_to_clear(dropout_share)) {
  assert(dropout_share >= 0.0 && dropout_share < 1.0);
  const auto cells = static_cast<std::size_t>(side_ * side_);
  lethal_.resize(cells);
  scans_.resize(cells);
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
  cells_.clear();
  std::fill(costs_.begin(), costs_.end(), std::uint8_t{DMRP_COST_FREE});
}

void LocalCostmap::update(const dmrp_pose& sensor, const dmrp_scan& scan) {
  assert(toolkit::is_finite(toolkit::position(sensor)) && (scan.ranges || scan.count == 0));
  bool has_changed = roll_to(toolkit::position(sensor));

  aim_beams(sensor, scan);
  // In cells from the window's lower left corner.
  const dmrp_vec2 corner = {static_cast<double>(column_), static_cast<double>(row_)};
  const dmrp_vec2 origin = toolkit::position(sensor) / settings_.resolution_m - corner;
  if (misses_to_clear_ > 1) {
    // Before clearing: obstacles that hide others must still be present.
    for (std::uint32_t beam = 0; beam < scan.count; ++beam)
      if (std::isinf(scan.ranges[beam]))
        count_miss_along(origin, origin + settings_.raytrace_range_m * cells_per_metre_[beam]);
    has_changed |= drop_free_cells();
  }
  // A scan clears along its beams, and then marks. Most of what it would clear it marks again, so the marks come first.
  if (++scan_ == 0) {
    std::fill(scans_.begin(), scans_.end(), std::uint8_t{0});
    scan_ = 1;
  }
  for (std::uint32_t beam = 0; beam < scan.count; ++beam) {
    const double range_m = static_cast<double>(scan.ranges[beam]);
    if (range_m < settings_.obstacle_range_m)
      has_changed |= mark(origin + (range_m + behind_surface_m) * cells_per_metre_[beam]);
  }
  has_changed |= clear(origin, sensor, scan);
  if (has_changed) inflate();
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

// Cells that leave the window are discarded. Returns whether the window moved.
bool LocalCostmap::roll_to(dmrp_vec2 center) {
  const auto lattice = [&](double metres) {
    return static_cast<std::int64_t>(std::floor(metres / settings_.resolution_m)) - side_ / 2;
  };
  const std::int64_t columns = is_placed_ ? lattice(center.x) - column_ : side_;
  const std::int64_t rows = is_placed_ ? lattice(center.y) - row_ : side_;
  column_ = lattice(center.x);
  row_ = lattice(center.y);
  is_placed_ = true;
  if (columns == 0 && rows == 0) return false;

  misses_.clear();
  for (const std::uint32_t cell : cells_) misses_.push_back(std::exchange(lethal_[cell], std::uint8_t{0}));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::int64_t column = cells_[i] % side_ - columns;
    const std::int64_t row = cells_[i] / side_ - rows;
    if (column < 0 || column >= side_ || row < 0 || row >= side_) continue;
    cells_[kept] = static_cast<std::uint32_t>(row * side_ + column);
    lethal_[cells_[kept++]] = misses_[i];
  }
  cells_.resize(kept);
  return true;
}

// Clears the cells on lines that this scan has not marked. Returns whether there were any.
bool LocalCostmap::clear(dmrp_vec2 from, const dmrp_pose& sensor, const dmrp_scan& scan) {
  for (const std::uint32_t cell : cells_)
    if (scans_[cell] != scan_ && is_cleared(cell % side_, cell / side_, from, sensor, scan)) lethal_[cell] = 0;
  return drop_free_cells();
}

// Returns whether there were any.
bool LocalCostmap::drop_free_cells() {
  return std::erase_if(cells_, [&](std::uint32_t cell) { return lethal_[cell] == 0; }) > 0;
}

// Whether the line of a beam has the cell. Only beams that point at it can.
bool LocalCostmap::is_cleared(std::int64_t column, std::int64_t row, dmrp_vec2 from, const dmrp_pose& sensor,
                              const dmrp_scan& scan) const {
  const dmrp_vec2 way = dmrp_vec2{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5} - from;
  const double distance = toolkit::norm(way);
  const double reached_m = (distance - cell_reach) * settings_.resolution_m;  // by every line that has the cell
  const auto clears = [&](std::int64_t beam) {
    const auto range_m = static_cast<double>(scan.ranges[beam]);
    if (misses_to_clear_ > 1 && std::isinf(range_m)) return false;
    const double cleared_m = std::min(range_m, settings_.raytrace_range_m);
    if (cleared_m < reached_m) return false;
    return CellLine(from, from + cleared_m * cells_per_metre_[static_cast<std::size_t>(beam)], side_).has(column, row);
  };
  const auto any_clears = [&](double first, double last) {
    for (auto beam = static_cast<std::int64_t>(first); static_cast<double>(beam) <= last; ++beam)
      if (clears(beam)) return true;
    return false;
  };
  const double count = scan.count;
  if (distance <= cell_reach || !(scan.angle_increment > 0.0)) return any_clears(0.0, count - 1.0);
  const double aside_rad = std::asin(cell_reach / distance);
  const double turn_rad = 2.0 * std::numbers::pi;
  double first_rad = std::atan2(way.y, way.x) - aside_rad - sensor.theta - scan.angle_min;
  first_rad -= turn_rad * (std::floor(first_rad / turn_rad) + 1.0);  // the arc may begin before beam 0
  for (; first_rad <= (count - 1.0) * scan.angle_increment; first_rad += turn_rad) {
    const double first = std::max(0.0, std::ceil(first_rad / scan.angle_increment));
    const double last = std::min(count - 1.0, std::floor((first_rad + 2.0 * aside_rad) / scan.angle_increment));
    if (any_clears(first, last)) return true;
  }
  return false;
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

// Returns whether the cell was free.
bool LocalCostmap::mark(dmrp_vec2 point) {
  const double side = static_cast<double>(side_);
  if (!(point.x >= 0.0 && point.x < side && point.y >= 0.0 && point.y < side)) return false;
  const auto cell =
      static_cast<std::uint32_t>(static_cast<std::int64_t>(point.y) * side_ + static_cast<std::int64_t>(point.x));
  scans_[cell] = scan_;
  if (std::exchange(lethal_[cell], misses_to_clear_) != 0) return false;
  cells_.push_back(cell);
  return true;
}

// The cost decreases with distance, so the maximum over all lethal cells is the cost of the nearest one: exact.
void LocalCostmap::inflate() {
  std::fill(canvas_.begin(), canvas_.end(), std::uint8_t{DMRP_COST_FREE});
  const std::int64_t canvas_stride = side_ + stamp_stride_;
  const std::int64_t stamp_stride = stamp_stride_;
  const std::int64_t stamp_rows = 2 * stamp_reach_ + 1;
  for (const std::uint32_t cell : cells_) {
    // The canvas begins stamp_reach_ cells before the window on both axes.
    std::uint8_t* target = canvas_.data() + cell / side_ * canvas_stride + cell % side_;
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
