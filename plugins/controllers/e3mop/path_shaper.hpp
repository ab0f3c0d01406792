// SPDX-License-Identifier: MIT
// path_shaper.hpp: turns a rough path into one with headings, curvatures and speeds: smoothing, spline, velocity
// profile.
#pragma once

#include <optional>
#include <vector>

#include "controllers/e3mop/free_space.hpp"
#include "controllers/e3mop/path_smoother.hpp"
#include "controllers/e3mop/spline_path.hpp"

namespace dmrp::controllers::e3mop {

// Equally spaced points: first the kept part of the last cycle's path, then the lattice path.
struct RoughPath {
  std::vector<Vec2> points;
  std::size_t kept = 1;          // the number of points that stay; 1: the robot's position alone
  double start_theta = 0.0;      // the direction in which the path starts
  std::optional<Vec2> path_end;  // the end of the global path, if the lattice path reaches it
};

struct ShapeSettings {
  SmoothingSettings smoothing;  // needed_m is set from the free space
  double point_spacing_m = 0.1;
};

// A robot below this speed may leave the path's start in another direction than its heading.
inline constexpr double slow_m_s = 0.1;

// Reuses its buffers.
class PathShaper {
 public:
  // Sets `path`. False if it collides so early that it is of no use.
  bool shape(const RoughPath& rough, const Observation& now, const ClearanceField& field, const FreeSpace& free_space,
             const ShapeSettings& settings, std::vector<PathPoint>& path);

 private:
  bool lay_last_leg(const RoughPath& rough, double spacing_m);
  std::optional<double> smooth(const RoughPath& rough, const Observation& now, const ClearanceField& field,
                               const FreeSpace& free_space, const ShapeSettings& settings);
  bool fit(const Observation& now, const FreeSpace& free_space, std::optional<double> start_theta, double needed_m,
           std::vector<PathPoint>& path);

  PathSmoother smoother_;
  SplinePath spline_;
  std::vector<Vec2> points_;  // that the spline interpolates
};

}  // namespace dmrp::controllers::e3mop
