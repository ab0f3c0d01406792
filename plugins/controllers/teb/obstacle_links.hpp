// SPDX-License-Identifier: MIT
// obstacle_links.hpp: associates the poses of a band with obstacles and via-points.
#pragma once

#include <cstdint>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

struct ObstacleLink {
  std::uint32_t pose = 0;
  std::uint32_t obstacle = 0;
  double ahead_s = 0.0;     // when the robot reaches the pose; 0 for static obstacles
  bool is_dynamic = false;  // predicted for that time
  double start_m = 0.0;     // the robot's current distance from a static obstacle; large if it does not matter
  double goal_m = 0.0;      // likewise its distance at the goal where it stops
};

struct ViaPointLink {
  std::uint32_t pose = 0;
  std::uint32_t point = 0;
};

// Links all poses except the ends; ordered by pose. Static obstacles by upstream's rule: all obstacles closer to the
// pose than min_obstacle_dist times the force inclusion factor, and the closest one on the left and on the right within
// min_obstacle_dist times the cutoff factor. Dynamic obstacles: all poses that they could affect.
class ObstacleLinker {
 public:
  void link(const TimedElasticBand& band, bool stops_at_goal, const Footprint& footprint,
            const std::vector<Obstacle>& obstacles, const Parameters& parameters, std::vector<ObstacleLink>& links);

 private:
  void measure_from(const Pose& pose, const Footprint& footprint, const std::vector<Obstacle>& obstacles,
                    double wanted_m, std::vector<double>& distances_m) const;

  std::vector<double> start_m_;  // of each obstacle
  std::vector<double> goal_m_;
};

// The required distance from an obstacle that the robot is too close to already: it grows from the current distance by
// this slope per metre between the robot and the pose. The robot cannot jump away, and if it must not drive backward,
// it has to pass the obstacle first. Likewise before a goal that is too close to an obstacle.
inline constexpr double easing_slope = 0.3;

// Links each via-point to the closest pose, unless that is an end of the band.
void link_via_points(const TimedElasticBand& band, const std::vector<Vec2>& points, std::vector<ViaPointLink>& links);

}  // namespace dmrp::controllers::teb
