// SPDX-License-Identifier: MIT
// critics.hpp: the critics of nav2's MPPI controller. Each adds its costs to those of the samples.
//
// Names, weights and thresholds are nav2's (nav2_mppi_controller 1.4.2).
#pragma once

#include <cstdint>
#include <dmrp/cpp/parameters.hpp>
#include <functional>
#include <memory>
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

using Costs = std::vector<float>;  // of the samples

// What a critic scores, and the costs that it adds to.
struct CriticData {
  const Model& model;
  const Batch& batch;
  const Scene& scene;
  CostField& field;
  Costs& costs;
  bool all_collide = false;  // a critic has found that every trajectory collides
};

struct Critic {
  const char* name;
  std::function<void(CriticData&)> add;
  bool is_chosen = false;
};

using ParameterTable = std::vector<std::unique_ptr<ParamDefinition>>;

// All critics, in the order in which they add. Each declares its parameters as NAME_key in the table, which has to live
// as long as they do.
std::vector<Critic> all_critics(ParameterTable& table);

// The value of Scene::furthest for these trajectories.
int furthest_reached(const Batch& batch, const Scene& scene);

}  // namespace dmrp::controllers::mppi
