// SPDX-License-Identifier: MIT
// lidar.hpp: an exact planar laser scan; sensor_noise.hpp adds noise.
#pragma once

#include <dmrp/ext/lidar.h>

#include <cstdint>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/ray_cast.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

struct Disc {
  dmrp_vec2 center{};
  double radius_m = 0.0;
};

// Scans shapes, the border and the given bodies. One object serves all robots of a world, one scan at a time.
class Lidar {
 public:
  Lidar(const LidarSettings& settings, std::shared_ptr<const StaticGeometry> geometry);

  std::uint32_t beams() const { return settings_.beams; }
  double range_m() const { return settings_.range_max_m; }

  // Fills the beams() elements of `ranges` as in dmrp_scan. The bodies, discs and convex polygons, must not contain the
  // robot with the sensor.
  void scan(const dmrp_pose& sensor, std::span<const Disc> discs, std::span<const ConvexPolygon> polygons,
            std::span<float> ranges);

  // A dmrp_scan for ranges that the caller owns.
  dmrp_scan describe(std::int64_t t_ns, std::span<const float> ranges) const;

 private:
  void begin(const dmrp_pose& sensor);
  void scan_shapes();
  void scan_disc(const Disc& disc);
  void scan_polygon(toolkit::PolygonView polygon, double distance_m);
  template <class Cast>
  void cast_beams(double from, double width, double distance_m, const Cast& cast);

  LidarSettings settings_;
  std::shared_ptr<const StaticGeometry> geometry_;
  double angle_min_;
  double angle_increment_;
  std::vector<dmrp_vec2> directions_;  // of the beams, in the sensor's frame

  // Of the current scan.
  dmrp_vec2 origin_{};
  double heading_ = 0.0;
  std::vector<toolkit::Ray> rays_;
  std::vector<double> nearest_m_;
  std::vector<std::uint32_t> near_;
  std::vector<std::pair<double, std::uint32_t>> by_distance_;
};

}  // namespace dmrp::core
