// SPDX-License-Identifier: MIT
#include "core/sensors/lidar.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <limits>

namespace dmrp::core {
namespace {

// Only beams in the angle range of a body can hit it; this slack allows for rounding.
constexpr double angle_slack_rad = 1e-6;

bool is_full_circle(const LidarSettings& settings) {
  return settings.field_of_view_rad > 2.0 * toolkit::pi - 1e-9;
}

// On a full circle the last beam does not repeat the first.
double increment_of(const LidarSettings& settings) {
  const std::uint32_t gaps = is_full_circle(settings) ? settings.beams : std::max(settings.beams, 2u) - 1;
  return settings.field_of_view_rad / gaps;
}

}  // namespace

Lidar::Lidar(const LidarSettings& settings, std::shared_ptr<const StaticGeometry> geometry)
    : settings_(settings),
      geometry_(std::move(geometry)),
      angle_min_(-0.5 * settings.field_of_view_rad),
      angle_increment_(increment_of(settings)),
      rays_(settings.beams),
      nearest_m_(settings.beams) {
  assert(geometry_ && settings.beams > 0);
  for (std::uint32_t i = 0; i < settings.beams; ++i)
    directions_.push_back(toolkit::from_angle(angle_min_ + i * angle_increment_));
}

dmrp_scan Lidar::describe(std::int64_t t_ns, std::span<const float> ranges) const {
  assert(ranges.size() == beams());
  dmrp_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.count = static_cast<std::uint32_t>(ranges.size());
  scan.t_ns = t_ns;
  scan.angle_min = angle_min_;
  scan.angle_increment = angle_increment_;
  scan.range_min = settings_.range_min_m;
  scan.range_max = settings_.range_max_m;
  scan.ranges = ranges.data();
  return scan;
}

void Lidar::scan(const dmrp_pose& sensor, std::span<const Disc> discs, std::span<const ConvexPolygon> polygons,
                 std::span<float> ranges) {
  assert(ranges.size() == beams());
  begin(sensor);
  for (const Disc& disc : discs)
    if (toolkit::distance(disc.center, origin_) - disc.radius_m <= settings_.range_max_m) scan_disc(disc);
  for (const ConvexPolygon& polygon : polygons) {
    const double distance_m = toolkit::distance(toolkit::PolygonView(polygon), origin_);
    if (distance_m <= settings_.range_max_m) scan_polygon(polygon, distance_m);
  }
  scan_shapes();

  for (std::uint32_t i = 0; i < settings_.beams; ++i) {
    const bool hit = nearest_m_[i] <= settings_.range_max_m;
    const double range = std::max(nearest_m_[i], settings_.range_min_m);
    ranges[i] = hit ? static_cast<float>(range) : std::numeric_limits<float>::infinity();
  }
}

// Starts every beam with its distance to the border.
void Lidar::begin(const dmrp_pose& sensor) {
  origin_ = toolkit::position(sensor);
  heading_ = sensor.theta;
  const toolkit::Rectangle border = geometry_->rectangle();
  const bool border_in_range = toolkit::depth(border, origin_) <= settings_.range_max_m;
  const dmrp_vec2 ahead = toolkit::from_angle(heading_);
  for (std::uint32_t i = 0; i < settings_.beams; ++i) {
    rays_[i] = {origin_, directions_[i].x * ahead + directions_[i].y * toolkit::perpendicular(ahead)};
    nearest_m_[i] = border_in_range ? toolkit::ray_to_border(rays_[i], border) : toolkit::ray_misses;
  }
}

// Nearer shapes first: the shapes that they hide are then skipped.
void Lidar::scan_shapes() {
  const dmrp_vec2 reach = {settings_.range_max_m, settings_.range_max_m};
  geometry_->shapes_near({origin_ - reach, origin_ + reach}, near_);
  by_distance_.clear();
  for (const std::uint32_t shape : near_) {
    const double distance_m = toolkit::distance(toolkit::bounds(geometry_->sdk_shapes()[shape]), origin_);
    if (distance_m <= settings_.range_max_m) by_distance_.emplace_back(distance_m, shape);
  }
  std::sort(by_distance_.begin(), by_distance_.end());
  for (const auto& [distance_m, index] : by_distance_) {
    const dmrp_shape& shape = geometry_->sdk_shapes()[index];
    if (shape.kind == DMRP_SHAPE_CIRCLE) {
      scan_disc({shape.center, shape.radius_m});
    } else {
      scan_polygon(toolkit::polygon_of(shape), distance_m);
    }
  }
}

void Lidar::scan_disc(const Disc& disc) {
  const double distance_m = toolkit::distance(disc.center, origin_);
  const auto cast = [&](std::uint32_t beam) { return toolkit::ray_to_circle(rays_[beam], disc.center, disc.radius_m); };
  if (distance_m <= disc.radius_m) return cast_beams(-toolkit::pi, 2.0 * toolkit::pi, 0.0, cast);
  const double half_width = std::asin(disc.radius_m / distance_m);
  const double middle = toolkit::bearing(origin_, disc.center) - heading_;
  cast_beams(middle - half_width, 2.0 * half_width, distance_m - disc.radius_m, cast);
}

// The bearings of the corners span the covered angles; from inside, all angles are covered.
void Lidar::scan_polygon(toolkit::PolygonView polygon, double distance_m) {
  const auto cast = [&](std::uint32_t beam) { return toolkit::ray_to_polygon(rays_[beam], polygon); };
  if (toolkit::contains(polygon, origin_)) return cast_beams(-toolkit::pi, 2.0 * toolkit::pi, 0.0, cast);
  const double first = toolkit::bearing(origin_, polygon[0]);
  double least = 0.0;
  double most = 0.0;
  for (const dmrp_vec2 corner : polygon) {
    const double turn = toolkit::difference(first, toolkit::bearing(origin_, corner));
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  cast_beams(first - heading_ + least, most - least, distance_m, cast);
}

// Casts the beams from angle `from` (in the sensor's frame) over `width` radians, except for beams with a known hit
// nearer than `distance_m`.
template <class Cast>
void Lidar::cast_beams(double from, double width, double distance_m, const Cast& cast) {
  const double turn = 2.0 * toolkit::pi;
  double start = std::fmod(from - angle_slack_rad - angle_min_, turn);
  if (start < 0.0) start += turn;
  const double end = start + width + 2.0 * angle_slack_rad;
  // A second turn for a body that spans the seam.
  for (const double offset : {0.0, turn}) {
    const double first = std::ceil(std::max(0.0, (start - offset) / angle_increment_));
    const double last = std::floor((end - offset) / angle_increment_);
    if (last < first) continue;
    const auto stop = static_cast<std::uint32_t>(std::min(last + 1.0, static_cast<double>(settings_.beams)));
    for (auto beam = static_cast<std::uint32_t>(std::min(first, static_cast<double>(settings_.beams))); beam < stop;
         ++beam)
      if (nearest_m_[beam] > distance_m) nearest_m_[beam] = std::min(nearest_m_[beam], cast(beam));
  }
}

}  // namespace dmrp::core
