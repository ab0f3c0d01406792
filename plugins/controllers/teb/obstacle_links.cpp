// SPDX-License-Identifier: MIT
#include "controllers/teb/obstacle_links.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::controllers::teb {

namespace {

// A pose may move by this much before the next association.
constexpr double slack_m = 0.5;

// Obstacle links with this start distance ignore the start.
constexpr double ignored_m = 1e9;

// The closest obstacle on one side of a pose.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  std::uint32_t obstacle = 0;
  bool found() const { return distance_m < std::numeric_limits<double>::infinity(); }
};

bool is_farther(Vec2 from, const Obstacle& obstacle, double ahead_s, double reach_m) {
  const double all_m = reach_m + obstacle.reach_m + obstacle.radius_m;
  return toolkit::squared_distance(from, obstacle.center + ahead_s * obstacle.velocity) > all_m * all_m;
}

bool is_dynamic(const Obstacle& obstacle, const Parameters& parameters) {
  return parameters.include_dynamic_obstacles && obstacle.velocity != Vec2{0.0, 0.0};
}

// Moving obstacles closer to the outline than this may affect a pose.
double dynamic_reach(const Parameters& parameters) {
  return std::max(parameters.min_obstacle_dist, parameters.dynamic_obstacle_inflation_dist) + slack_m;
}

}  // namespace

void ObstacleLinker::link(const TimedElasticBand& band, bool stops_at_goal, const Footprint& footprint,
                          const std::vector<Obstacle>& obstacles, const Parameters& parameters,
                          std::vector<ObstacleLink>& links) {
  links.clear();
  const double wanted_m = parameters.min_obstacle_dist + parameters.penalty_epsilon;
  start_m_.assign(obstacles.size(), ignored_m);
  goal_m_.assign(obstacles.size(), ignored_m);
  if (parameters.ease_from_start) measure_from(band.pose(0), footprint, obstacles, wanted_m, start_m_);
  if (stops_at_goal && parameters.ease_to_goal)
    measure_from(band.pose(band.size() - 1), footprint, obstacles, wanted_m, goal_m_);
  const double forced_m = parameters.min_obstacle_dist * parameters.obstacle_association_force_inclusion_factor;
  const double cutoff_m = parameters.min_obstacle_dist * parameters.obstacle_association_cutoff_factor;
  const double dynamic_m = dynamic_reach(parameters);
  double ahead_s = 0.0;
  for (std::uint32_t i = 1; i + 1 < band.size(); ++i) {
    ahead_s += band.dt[i - 1];
    const Pose pose = band.pose(i);
    const Vec2 at = toolkit::position(pose);
    const Vec2 heading = toolkit::from_angle(pose.theta);
    Nearest left;
    Nearest right;
    for (std::uint32_t k = 0; k < obstacles.size(); ++k) {
      const Obstacle& obstacle = obstacles[k];
      if (is_dynamic(obstacle, parameters)) {
        if (!is_farther(at, obstacle, ahead_s, footprint.radius_m + dynamic_m))
          links.push_back({i, k, ahead_s, true, ignored_m, ignored_m});
        continue;
      }
      if (is_farther(at, obstacle, 0.0, footprint.radius_m + cutoff_m)) continue;
      const Separation apart = separation(footprint, pose, obstacle, 0.0);
      if (apart.distance_m < forced_m) {
        links.push_back({i, k, 0.0, false, start_m_[k], goal_m_[k]});
      } else if (apart.distance_m < cutoff_m) {
        // the gradient points away from the obstacle: to the right if the obstacle is on the left
        Nearest& side = toolkit::cross(heading, apart.gradient) < 0.0 ? left : right;
        if (apart.distance_m < side.distance_m) side = {apart.distance_m, k};
      }
    }
    for (const Nearest& side : {left, right})
      if (side.found())
        links.push_back({i, side.obstacle, 0.0, false, start_m_[side.obstacle], goal_m_[side.obstacle]});
  }
}

// Of the obstacles closer to the pose than `wanted_m`.
void ObstacleLinker::measure_from(const Pose& pose, const Footprint& footprint, const std::vector<Obstacle>& obstacles,
                                  double wanted_m, std::vector<double>& distances_m) const {
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    if (!is_farther(toolkit::position(pose), obstacles[k], 0.0, footprint.radius_m + wanted_m))
      distances_m[k] = separation(footprint, pose, obstacles[k], 0.0).distance_m;
}

void link_via_points(const TimedElasticBand& band, const std::vector<Vec2>& points, std::vector<ViaPointLink>& links) {
  links.clear();
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    std::uint32_t nearest = 0;
    double nearest_squared = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < band.size(); ++i) {
      const double squared = toolkit::squared_distance(band.position(i), points[k]);
      if (squared < nearest_squared) nearest = i, nearest_squared = squared;
    }
    if (nearest > 0 && nearest + 1 < band.size()) links.push_back({nearest, k});
  }
}

}  // namespace dmrp::controllers::teb
