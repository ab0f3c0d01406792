// SPDX-License-Identifier: MIT
#include "controllers/mppi/critics.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <limits>

namespace dmrp::controllers::mppi {

namespace {

constexpr auto pi = static_cast<float>(toolkit::pi);

// Adds weight times value, raised to the power, to the samples of a block.
void add(const Weight& weight, int block, const Lanes& values, Costs& costs) {
  const Lanes cost = weight.weight * values;
  Lanes product = cost;
  for (int i = 1; i < weight.power; ++i) product *= cost;
  Eigen::Map<Lanes>(costs.data() + block * lanes) += product;
}

// The difference of two angles that are less than a few turns apart, in [-pi, pi].
float turn(float from, float to) {
  const float difference = to - from;
  const float turns = difference / (2.0f * pi);
  const auto nearest = static_cast<std::int32_t>(turns + (turns < 0.0f ? -0.5f : 0.5f));
  return difference - static_cast<float>(nearest) * 2.0f * pi;
}

// The velocities of a sample at a step: those now, then its controls.
const Lanes& velocities(const Field& controls, int block, int step, const Lanes& now) {
  return step == 0 ? now : controls.row(block, step - 1);
}

// The squared distances of the samples' poses from a point.
auto squared_distances(const Batch& batch, int block, int step, float x, float y) {
  return (batch.x.row(block, step) - x).square() + (batch.y.row(block, step) - y).square();
}

// Where the path leads through obstacles, trajectories aim at its first free point after them.
std::size_t target_point(const Scene& scene, int offset) {
  const std::size_t last = scene.path_x.size() - 1;
  std::size_t index = std::min(static_cast<std::size_t>(scene.furthest + offset), last);
  while (index + 1 < last && !scene.path_free[index]) ++index;
  return index;
}

}  // namespace

int furthest_reached(const Batch& batch, const Scene& scene) {
  const int count = static_cast<int>(scene.path_x.size());
  int furthest = 0;
  for (int s = 0; s < batch.samples() && furthest + 1 < count; ++s) {
    const float x = batch.x.at(s, batch.steps - 1);
    const float y = batch.y.at(s, batch.steps - 1);
    float least = std::numeric_limits<float>::infinity();
    int nearest = furthest;
    for (int i = furthest; i < count; ++i) {
      const float dx = scene.path_x[static_cast<std::size_t>(i)] - x;
      const float dy = scene.path_y[static_cast<std::size_t>(i)] - y;
      const float squared = dx * dx + dy * dy;
      if (squared < least) {
        least = squared;
        nearest = i;
      }
    }
    furthest = nearest;
  }
  return furthest;
}

// How far the speed leaves its limits, integrated over time.
void add_constraint(const Batch& batch, const Model& model, const Weight& weight, Costs& costs) {
  const Limits& limits = model.limits;
  const float fastest = model.holonomic ? std::hypot(limits.v_max, limits.v_y_max) : limits.v_max;
  const float slowest = model.holonomic ? -std::hypot(limits.v_min, limits.v_y_max) : limits.v_min;
  const Lanes now_x = Lanes::Constant(batch.now.v_x);
  const Lanes now_y = Lanes::Constant(batch.now.v_y);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes sums = Lanes::Zero();
    for (int i = 0; i < batch.steps; ++i) {
      const Lanes& v_x = velocities(batch.v_x, block, i, now_x);
      Lanes speed = v_x;
      if (model.holonomic) {
        speed = (v_x.square() + velocities(batch.v_y, block, i, now_y).square()).sqrt();
        speed = speed.binaryExpr(v_x, [](float size, float sign) { return std::copysign(size, sign); });
      }
      sums += model.step_s * ((speed - fastest).max(0.0f) + (slowest - speed).max(0.0f));
    }
    add(weight, block, sums, costs);
  }
}

// The distance driven backward.
void add_prefer_forward(const Batch& batch, const Model& model, const Weight& weight, float threshold_m,
                        const Scene& scene, Costs& costs) {
  if (scene.goal_distance_m < threshold_m) return;
  const Lanes now = Lanes::Constant(batch.now.v_x);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes sums = Lanes::Zero();
    for (int i = 0; i < batch.steps; ++i) sums += model.step_s * (-velocities(batch.v_x, block, i, now)).max(0.0f);
    add(weight, block, sums, costs);
  }
}

// The mean turning rate.
void add_twirling(const Batch& batch, const Weight& weight, const Scene& scene, Costs& costs) {
  if (scene.goal_distance_m < scene.goal_tolerance_m) return;
  const Lanes now = Lanes::Constant(batch.now.omega);
  const float share = 1.0f / static_cast<float>(batch.steps);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes sums = Lanes::Zero();
    for (int i = 0; i < batch.steps; ++i) sums += share * velocities(batch.omega, block, i, now).abs();
    add(weight, block, sums, costs);
  }
}

// The mean distance from the goal.
void add_goal(const Batch& batch, const Weight& weight, float threshold_m, const Scene& scene, Costs& costs) {
  if (!(scene.goal_distance_m < threshold_m)) return;
  const float share = 1.0f / static_cast<float>(batch.steps);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes sums = Lanes::Zero();
    for (int i = 0; i < batch.steps; ++i)
      sums += share * squared_distances(batch, block, i, scene.goal_x, scene.goal_y).sqrt();
    add(weight, block, sums, costs);
  }
}

// The mean deviation from the goal's heading.
void add_goal_angle(const Batch& batch, const Weight& weight, float threshold_m, const Scene& scene, Costs& costs) {
  if (!(scene.goal_distance_m < threshold_m) || std::isnan(scene.goal_theta)) return;
  const float share = 1.0f / static_cast<float>(batch.steps);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes sums = Lanes::Zero();
    for (int i = 0; i < batch.steps; ++i) {
      const Lanes& theta = batch.theta.row(block, i);
      for (int l = 0; l < lanes; ++l) sums[l] += share * std::abs(turn(theta[l], scene.goal_theta));
    }
    add(weight, block, sums, costs);
  }
}

// The distance of a trajectory's end from a point of the path somewhat beyond what the trajectories reach.
void add_path_follow(const Batch& batch, const Weight& weight, int offset_from_furthest, float threshold_m,
                     const Scene& scene, Costs& costs) {
  if (scene.path_x.size() < 2 || scene.goal_distance_m < threshold_m) return;
  const std::size_t target = target_point(scene, offset_from_furthest);
  for (int block = 0; block < batch.blocks; ++block)
    add(weight, block,
        squared_distances(batch, block, batch.steps - 1, scene.path_x[target], scene.path_y[target]).sqrt(), costs);
}

// How far the heading at a trajectory's end points away from the path, if the robot's heading now does.
void add_path_angle(const Batch& batch, const PathAngleSettings& settings, const Scene& scene, Costs& costs) {
  if (scene.path_x.empty() || scene.goal_distance_m < settings.threshold_m) return;
  const std::size_t target =
      std::min(static_cast<std::size_t>(scene.furthest + settings.offset_from_furthest), scene.path_x.size() - 1);
  const float to_x = scene.path_x[target];
  const float to_y = scene.path_y[target];
  const float along = scene.path_theta[target];
  // the angle between a heading and the way to the target; backward counts as forward where the mode says so
  const auto aside = [&](float x, float y, float theta) {
    const float way = std::atan2(to_y - y, to_x - x);
    const float ahead = std::abs(turn(theta, way));
    if (settings.mode == PathAngleMode::forward_preference) return ahead;
    if (settings.mode == PathAngleMode::no_directional_preference) return std::min(ahead, pi - ahead);
    return std::abs(turn(along, way)) > 0.5f * pi ? pi - ahead : ahead;
  };
  if (aside(0.0f, 0.0f, scene.theta) < settings.max_angle_rad) return;
  const int last = batch.steps - 1;
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes angles;
    for (int l = 0; l < lanes; ++l)
      angles[l] = aside(batch.x.row(block, last)[l], batch.y.row(block, last)[l], batch.theta.row(block, last)[l]);
    add(settings.weight, block, angles, costs);
  }
}

// The mean distance between points of a trajectory and points of the path after the same way driven.
void add_path_align(const Batch& batch, const PathAlignSettings& settings, const Scene& scene, Costs& costs) {
  if (scene.goal_distance_m < settings.threshold_m) return;
  const int segments = scene.furthest;
  // not while the robot first turns to the path ...
  if (segments < std::max(settings.offset_from_furthest, 1)) return;
  // ... nor where obstacles are on a good part of it
  float occupied = 0.0f;
  for (int i = 0; i < segments; ++i) {
    if (!scene.path_free[static_cast<std::size_t>(i)]) occupied += 1.0f;
    if (occupied > 2.0f && occupied / static_cast<float>(segments) > settings.max_path_occupancy_ratio) return;
  }
  const auto farthest = static_cast<float>(segments - 1);
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes driven = Lanes::Zero(), sums = driven, counts = driven;
    for (int i = settings.point_step; i < batch.steps; i += settings.point_step) {
      const Lanes& x = batch.x.row(block, i);
      const Lanes& y = batch.y.row(block, i);
      const Lanes& theta = batch.theta.row(block, i);
      const int before = i - settings.point_step;
      driven += ((x - batch.x.row(block, before)).square() + (y - batch.y.row(block, before)).square()).sqrt();
      const Lanes point = (driven / path_spacing_m + 0.5f).min(farthest);
      Lanes free, dx, dy, aside;
      for (int l = 0; l < lanes; ++l) {
        const auto at = static_cast<std::size_t>(static_cast<std::int32_t>(point[l]));
        free[l] = scene.path_free[at] ? 1.0f : 0.0f;
        dx[l] = scene.path_x[at] - x[l];
        dy[l] = scene.path_y[at] - y[l];
        aside[l] = settings.use_path_orientations ? turn(scene.path_theta[at], theta[l]) : 0.0f;
      }
      sums += free * (dx.square() + dy.square() + aside.square()).sqrt();
      counts += free;
    }
    sums /= counts.max(1.0f);
    add(settings.weight, block, sums, costs);
  }
}

// The mean cost of the cells that a trajectory passes.
bool add_cost(const Batch& batch, const Model& model, const CostSettings& settings, CostField& field,
              const Scene& scene, Costs& costs) {
  const bool near_goal = scene.goal_distance_m < settings.near_goal_distance_m;
  CostTable table{};
  for (std::size_t cost = 1; cost < table.size(); ++cost) {
    table[cost] = near_goal ? 0.0f : static_cast<float>(cost);
    if (static_cast<int>(cost) >= settings.near_collision_cost) table[cost] = settings.critical_cost;
  }
  field.set_table(table);
  const int points = (batch.steps - 1) / settings.point_step + 1;
  const Weight per_point = {settings.weight.weight / 254.0f / static_cast<float>(points), settings.weight.power};
  bool any_is_free = false;
  for (int block = 0; block < batch.blocks; ++block) {
    const Lanes sums = field.sum(batch, block, settings.point_step, model.step_s);
    any_is_free |= (sums < in_contact).any();
    add(per_point, block, (sums >= in_contact).select(settings.collision_cost, sums), costs);
  }
  return any_is_free;
}

// How far a trajectory stays within the inflation radius of obstacles, and within the collision margin.
bool add_obstacles(const Batch& batch, const Model& model, const ObstaclesSettings& settings, CostField& field,
                   const Scene& scene, Costs& costs) {
  const bool near_goal = scene.goal_distance_m < settings.near_goal_distance_m;
  CostTable margins{}, repulsions{};
  for (std::size_t cost = 1; cost < DMRP_COST_INSCRIBED; ++cost) {
    const double gap_m = field.distance_of(static_cast<std::uint8_t>(cost)) - field.inscribed_radius_m();
    margins[cost] = std::max(settings.collision_margin_distance_m - static_cast<float>(gap_m), 0.0f);
    if (!near_goal) repulsions[cost] = static_cast<float>(field.inflation_radius_m() - gap_m);
  }
  std::vector<Lanes> critical(static_cast<std::size_t>(batch.blocks));
  std::vector<Lanes> repulsive(static_cast<std::size_t>(batch.blocks));
  field.set_table(margins);
  bool any_is_free = false;
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes& sums = critical[static_cast<std::size_t>(block)];
    sums = field.sum(batch, block, 1, model.step_s);
    any_is_free |= (sums < in_contact).any();
  }
  field.set_table(repulsions);
  float least = std::numeric_limits<float>::infinity();
  for (int block = 0; block < batch.blocks; ++block) {
    Lanes& sums = repulsive[static_cast<std::size_t>(block)];
    sums = field.sum(batch, block, 1, model.step_s);
    least = std::min(least, sums.minCoeff());
  }
  for (std::size_t block = 0; block < critical.size(); ++block) {
    const auto collides = critical[block] >= in_contact;
    const Lanes raw = collides.select(settings.collision_cost, critical[block]);
    const Lanes beyond = collides.select(0.0f, (repulsive[block] - least) / static_cast<float>(batch.steps));
    add({1.0f, settings.power}, static_cast<int>(block),
        settings.critical_weight * raw + settings.repulsion_weight * beyond, costs);
  }
  return any_is_free;
}

}  // namespace dmrp::controllers::mppi
