// SPDX-License-Identifier: MIT
// critics.hpp: the critics of nav2's MPPI controller. Each adds its costs to those of the samples.
//
// Names, weights and thresholds are nav2's (nav2_mppi_controller 1.4.2). `power` raises a critic's weighted cost.
#pragma once

#include <cstdint>
#include <vector>

#include "controllers/mppi/batch.hpp"
#include "controllers/mppi/cost_field.hpp"

namespace dmrp::controllers::mppi {

// What the critics know of a cycle. Points are relative to the robot's position now, axes as the world's.
struct Scene {
  float theta = 0.0f;  // the robot's heading
  // The path ahead, path_spacing_m apart; with the direction that it leads in, and whether it is free, at each point.
  std::vector<float> path_x;
  std::vector<float> path_y;
  std::vector<float> path_theta;
  std::vector<std::uint8_t> path_free;
  int furthest = 0;  // the furthest point of the path that some trajectory ends nearest to

  float goal_x = 0.0f;
  float goal_y = 0.0f;
  float goal_theta = 0.0f;  // NaN: any
  float goal_distance_m = 0.0f;
  float goal_tolerance_m = 0.0f;
};

inline constexpr float path_spacing_m = 0.05f;

struct Weight {
  float weight = 1.0f;
  int power = 1;
};

struct CostSettings {
  Weight weight = {3.81f, 1};
  float critical_cost = 300.0f;
  int near_collision_cost = 253;
  float collision_cost = 1e6f;
  float near_goal_distance_m = 1.0f;
  int point_step = 2;
};

struct ObstaclesSettings {
  int power = 1;
  float repulsion_weight = 1.5f;
  float critical_weight = 20.0f;
  float collision_cost = 1e5f;
  float collision_margin_distance_m = 0.1f;
  float near_goal_distance_m = 0.5f;
};

struct PathAlignSettings {
  Weight weight = {14.0f, 1};
  float max_path_occupancy_ratio = 0.05f;
  int offset_from_furthest = 20;
  int point_step = 4;
  float threshold_m = 0.5f;
  bool use_path_orientations = false;
};

enum class PathAngleMode { forward_preference, no_directional_preference, consider_path_orientations };

struct PathAngleSettings {
  Weight weight = {2.0f, 1};
  int offset_from_furthest = 4;
  float threshold_m = 0.5f;
  float max_angle_rad = 1.0f;
  PathAngleMode mode = PathAngleMode::forward_preference;
};

using Costs = std::vector<float>;  // of the samples

// The value of Scene::furthest for these trajectories.
int furthest_reached(const Batch& batch, const Scene& scene);

void add_constraint(const Batch& batch, const Model& model, const Weight& weight, Costs& costs);
void add_prefer_forward(const Batch& batch, const Model& model, const Weight& weight, float threshold_m,
                        const Scene& scene, Costs& costs);
void add_twirling(const Batch& batch, const Weight& weight, const Scene& scene, Costs& costs);
void add_goal(const Batch& batch, const Weight& weight, float threshold_m, const Scene& scene, Costs& costs);
void add_goal_angle(const Batch& batch, const Weight& weight, float threshold_m, const Scene& scene, Costs& costs);
void add_path_follow(const Batch& batch, const Weight& weight, int offset_from_furthest, float threshold_m,
                     const Scene& scene, Costs& costs);
void add_path_angle(const Batch& batch, const PathAngleSettings& settings, const Scene& scene, Costs& costs);
void add_path_align(const Batch& batch, const PathAlignSettings& settings, const Scene& scene, Costs& costs);

// These return false if every trajectory collides.
bool add_cost(const Batch& batch, const Model& model, const CostSettings& settings, CostField& field,
              const Scene& scene, Costs& costs);
bool add_obstacles(const Batch& batch, const Model& model, const ObstaclesSettings& settings, CostField& field,
                   const Scene& scene, Costs& costs);

}  // namespace dmrp::controllers::mppi
