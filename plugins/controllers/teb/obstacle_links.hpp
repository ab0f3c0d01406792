// SPDX-License-Identifier: MIT
// obstacle_links.hpp: which poses of a band keep away from which obstacles, and which are drawn to which via-points.
#ifndef DMRP_CONTROLLERS_TEB_OBSTACLE_LINKS_HPP
#define DMRP_CONTROLLERS_TEB_OBSTACLE_LINKS_HPP

#include <cstdint>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/teb/timed_elastic_band.hpp"

namespace dmrp::controllers::teb {

struct ObstacleLink {
  std::uint32_t pose = 0;
  std::uint32_t obstacle = 0;
  double ahead_s = 0.0;     // when the robot is there; 0 for what counts as standing
  bool is_dynamic = false;  // foreseen where it will be by then
  double start_m = 0.0;     // how far the robot is from it now, of what stands; large where that is of no concern
};

struct ViaPointLink {
  std::uint32_t pose = 0;
  std::uint32_t point = 0;
};

// Of all poses but the ends. Standing obstacles, upstream's rule: all that are nearer to the pose than
// min_obstacle_dist times the force inclusion factor, and the nearest on the left and on the right within
// min_obstacle_dist times the cutoff factor. Moving ones: every pose for which they could count. Ordered by pose.
class ObstacleLinker {
 public:
  void link(const TimedElasticBand& band, const Footprint& footprint, const std::vector<Obstacle>& obstacles,
            const BandTuning& tuning, std::vector<ObstacleLink>& links);

 private:
  std::vector<double> start_m_;  // of each obstacle
};

// How much farther from an obstacle than the robot is now a pose must be, for each metre between the two: a robot that
// is too near already leaves gradually. It cannot jump, and where it must not drive backward it has to go past first.
inline constexpr double leaving_slope = 0.3;

// Each via-point to the pose nearest to it, unless that is an end of the band.
void link_via_points(const TimedElasticBand& band, const std::vector<Vec2>& points, std::vector<ViaPointLink>& links);

}  // namespace dmrp::controllers::teb

#endif
