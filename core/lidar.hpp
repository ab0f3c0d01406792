// SPDX-License-Identifier: MIT
// lidar.hpp: a planar range scan without noise.
#pragma once

#include <dmrp/ext/lidar.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/settings.hpp"
#include "core/static_geometry.hpp"

namespace dmrp::core {

struct Disc {
  dmrp_vec2 center{};
  double radius_m = 0.0;
};

// Sees shapes, the border, and the bodies it is given. One serves all robots of a world, one scan at a time.
class Lidar {
 public:
  Lidar(const LidarSettings& settings, std::shared_ptr<const StaticGeometry> geometry);

  std::uint32_t beams() const { return settings_.beams; }

  // Fills `ranges` (beams() of them) as in dmrp_scan. `bodies` must not contain who carries the sensor.
  void scan(const dmrp_pose& sensor, std::span<const Disc> bodies, std::span<float> ranges);

  // The scan's head over ranges that stay the caller's.
  dmrp_scan describe(std::int64_t t_ns, std::span<const float> ranges) const;

 private:
  void see_segment(const dmrp_pose& sensor, const dmrp_segment& segment);
  void see_disc(const dmrp_pose& sensor, const Disc& disc);

  LidarSettings settings_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::vector<dmrp_vec2> directions_;  // of the beams, in the world frame
  std::vector<double> nearest_;
  std::vector<std::uint32_t> shapes_;
};

}  // namespace dmrp::core
