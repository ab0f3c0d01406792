// SPDX-License-Identifier: MIT
// obstacles.hpp: the obstacles about the robot as convex shapes, and distances to them.
#pragma once

#include <dmrp/ext/obstacle_clusters.h>

#include <cmath>
#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

// A point, a segment or a convex polygon, enlarged by a radius. Moves at constant velocity.
struct Obstacle {
  const Vec2* vertices = nullptr;  // counter-clockwise; owned by an ObstacleSet
  std::uint32_t vertex_count = 0;  // 1: a point; 2: a segment
  double radius_m = 0.0;
  Vec2 velocity = {0.0, 0.0};           // m/s
  Vec2 center = {0.0, 0.0};             // of a circle that contains the vertices ...
  double reach_m = 0.0;                 // ... of this radius
  Vec2 lower = {-HUGE_VAL, -HUGE_VAL};  // of a box that contains them; the whole plane where nobody sets it
  Vec2 upper = {HUGE_VAL, HUGE_VAL};
  bool is_agent = false;  // a tracked robot or person
  bool is_robot = false;  // a tracked robot
};

// How far the obstacle will have moved.
Vec2 displacement(const Obstacle& obstacle, double ahead_s);

// The signed distance between two outlines and its derivatives.
struct Separation {
  double distance_m = 0.0;     // negative: the depth of the overlap
  Vec2 gradient = {0.0, 0.0};  // with respect to the robot's position; points away from the obstacle
  double gradient_theta = 0.0;
};

class ObstacleSet {
 public:
  // Collects the clusters (`clusters` may be NULL), then the agents of the observation, each in their order. Agents
  // slower than `slow_m_s` get velocity 0. Valid until the next gather().
  void gather(const Observation& now, const dmrp_obstacle_cluster_list* clusters, double slow_m_s = standing_m_s);
  void clear();

  const std::vector<Obstacle>& all() const { return obstacles_; }

 private:
  std::vector<Vec2> vertices_;
  std::vector<Obstacle> obstacles_;
};

// A cheap lower bound of separation().distance_m over all headings of the robot.
double least_distance(const Footprint& footprint, Vec2 robot, const Obstacle& obstacle, double ahead_s);

// Between the robot at a pose `ahead_s` from now and the obstacle moved to that time.
Separation separation(const Footprint& footprint, const Pose& robot, const Obstacle& obstacle, double ahead_s);

}  // namespace dmrp::controllers
