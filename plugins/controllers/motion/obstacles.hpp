// SPDX-License-Identifier: MIT
// obstacles.hpp: what stands or moves about the robot, as shapes to measure distances to.
#ifndef DMRP_CONTROLLERS_MOTION_OBSTACLES_HPP
#define DMRP_CONTROLLERS_MOTION_OBSTACLES_HPP

#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers {

// A point, a segment or a convex polygon, grown by a radius. Moves at constant velocity.
struct Obstacle {
  const Vec2* vertices = nullptr;  // counter-clockwise; of an ObstacleSet
  std::uint32_t vertex_count = 0;  // 1: a point; 2: a segment
  double radius_m = 0.0;
  Vec2 velocity = {0.0, 0.0};  // m/s
  Vec2 center = {0.0, 0.0};    // of a circle that holds the vertices ...
  double reach_m = 0.0;        // ... of this radius
  bool is_agent = false;       // a robot or a person, told of by tracking
};

// Where the outlines come nearest.
struct Separation {
  double distance_m = 0.0;     // between the outlines; negative where they overlap, by how deep
  Vec2 gradient = {0.0, 0.0};  // of the distance, with respect to the robot's position: away from the obstacle
  double gradient_theta = 0.0;
};

class ObstacleSet {
 public:
  // The clusters (`clusters` may be NULL) and then the agents of the observation, in their order. Agents slower than
  // `standing_m_s` stand. Valid until the next gather().
  void gather(const Observation& now, const dmrp_obstacle_cluster_list* clusters, double standing_m_s = 0.05);
  void clear();

  const std::vector<Obstacle>& all() const { return obstacles_; }

 private:
  std::vector<Vec2> vertices_;
  std::vector<Obstacle> obstacles_;
};

// A lower bound of what separation() gives, for a robot of this footprint anywhere in its turn: cheap, for choosing.
double least_distance(const Footprint& footprint, Vec2 robot, const Obstacle& obstacle, double ahead_s);

// Between a robot of this footprint, where it would stand `ahead_s` from now, and the obstacle moved there by then.
Separation separation(const Footprint& footprint, const Pose& robot, const Obstacle& obstacle, double ahead_s);

}  // namespace dmrp::controllers

#endif
