// SPDX-License-Identifier: MIT
#include "controllers/mppi/critics.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <limits>

#include "controllers/mppi/critic_parameters.hpp"

namespace dmrp::controllers::mppi {

namespace {

constexpr auto pi = static_cast<float>(toolkit::pi);

// The difference of two angles that are less than a few turns apart, in [-pi, pi].
float turn(float from, float to) {
  const float difference = to - from;
  const float turns = difference / (2.0f * pi);
  const auto nearest = static_cast<std::int32_t>(turns + (turns < 0.0f ? -0.5f : 0.5f));
  return difference - static_cast<float>(nearest) * 2.0f * pi;
}

// The velocities of a sample at a step: those now, then its controls.
Lanes velocities(const Field& controls, int block, int step, float now) {
  return step == 0 ? Lanes(Lanes::Constant(now)) : controls.row(block, step - 1);
}

// The distances of the samples' poses from a point.
Lanes distances(const Batch& batch, int block, int step, float x, float y) {
  return ((batch.x.row(block, step) - x).square() + (batch.y.row(block, step) - y).square()).sqrt();
}

// How far the speed leaves its limits, integrated over time.
struct ConstraintCritic {
  Declare declare;
  Weight weight = declare.weight(4.0, "speeds beyond the limits");

  void add(CriticData& data) const {
    const Model& model = data.model;
    const Batch& batch = data.batch;
    const Limits& limits = model.limits;
    const float fastest = model.holonomic ? std::hypot(limits.v_max, limits.v_y_max) : limits.v_max;
    const float slowest = model.holonomic ? -std::hypot(limits.v_min, limits.v_y_max) : limits.v_min;
    weight.add_sums(data, [&](int block, int i) -> Lanes {
      const Lanes v_x = velocities(batch.v_x, block, i, batch.now.v_x);
      Lanes speed = v_x;
      if (model.holonomic) {
        speed = (v_x.square() + velocities(batch.v_y, block, i, batch.now.v_y).square()).sqrt();
        speed = speed.binaryExpr(v_x, [](float size, float sign) { return std::copysign(size, sign); });
      }
      return model.step_s * ((speed - fastest).max(0.0f) + (slowest - speed).max(0.0f));
    });
  }
};

// The mean cost of the cells that a trajectory passes.
struct CostCritic {
  Declare declare;
  Weight weight = declare.weight(3.81, "cells passed");
  Number critical_cost =
      declare.number("critical_cost", 300.0, 1000000.0, "cost of a pose in a cell of near_collision_cost or more");
  Param<int> near_collision_cost =
      declare.count("near_collision_cost", 253, 1, 253, "cells that cost this much are critical");
  Number collision_cost =
      declare.number("collision_cost", 1000000.0, 1000000000.0, "cost of a trajectory that collides");
  Number near_goal_distance =
      declare.goal_distance("near_goal_distance", 1.0, "nearer to the goal, only collisions and critical cells cost");
  Param<int> trajectory_point_step =
      declare.count("trajectory_point_step", 2, 1, 50, "poses from one that is checked to the next");

  void add(CriticData& data) const {
    const bool near_goal = data.scene.goal_distance_m < near_goal_distance;
    CostTable table{};
    for (std::size_t cost = 1; cost < table.size(); ++cost) {
      table[cost] = near_goal ? 0.0f : static_cast<float>(cost);
      if (static_cast<int>(cost) >= near_collision_cost) table[cost] = critical_cost;
    }
    data.field.set_table(table);
    const int points = (data.batch.steps - 1) / trajectory_point_step + 1;
    const float per_point = weight.factor / 254.0f / static_cast<float>(points);
    const float of_collision = collision_cost;
    bool any_is_free = false;
    for (int block = 0; block < data.batch.blocks; ++block) {
      const Lanes sums = data.field.sum(data.batch, block, trajectory_point_step, data.model.step_s);
      any_is_free |= (sums < in_contact).any();
      add_raised(data, block, per_point * (sums >= in_contact).select(of_collision, sums), weight.power);
    }
    data.all_collide |= !any_is_free;
  }
};

// How far a trajectory stays within the inflation radius of obstacles, and within the collision margin.
struct ObstaclesCritic {
  Declare declare;
  Param<int> power = declare.power("distances to obstacles");
  Number repulsion_weight =
      declare.number("repulsion_weight", 1.5, 10000.0, "weight of being within the inflation radius");
  Number critical_weight =
      declare.number("critical_weight", 20.0, 10000.0, "weight of being within the collision margin");
  Number collision_cost =
      declare.number("collision_cost", 100000.0, 1000000000.0, "cost of a trajectory that collides");
  Number collision_margin_distance = declare.number("collision_margin_distance", 0.1, 5.0, "the collision margin", "m");
  Number near_goal_distance =
      declare.goal_distance("near_goal_distance", 0.5, "nearer to the goal, the inflation radius costs nothing");

  void add(CriticData& data) const {
    CostField& field = data.field;
    const Batch& batch = data.batch;
    const bool near_goal = data.scene.goal_distance_m < near_goal_distance;
    CostTable margins{}, repulsions{};
    for (std::size_t cost = 1; cost < DMRP_COST_INSCRIBED; ++cost) {
      const double gap_m = field.distance_of(static_cast<std::uint8_t>(cost)) - field.inscribed_radius_m();
      margins[cost] = std::max(collision_margin_distance - static_cast<float>(gap_m), 0.0f);
      if (!near_goal) repulsions[cost] = static_cast<float>(field.inflation_radius_m() - gap_m);
    }
    std::vector<Lanes> critical(static_cast<std::size_t>(batch.blocks));
    std::vector<Lanes> repulsive(critical.size());
    const auto sum = [&](const CostTable& table, std::vector<Lanes>& sums) {
      field.set_table(table);
      for (int block = 0; block < batch.blocks; ++block)
        sums[static_cast<std::size_t>(block)] = field.sum(batch, block, 1, data.model.step_s);
    };
    sum(margins, critical);
    sum(repulsions, repulsive);
    float least = std::numeric_limits<float>::infinity();
    for (const Lanes& sums : repulsive) least = std::min(least, sums.minCoeff());
    const float of_collision = collision_cost, of_margin = critical_weight, of_inflation = repulsion_weight;
    bool any_is_free = false;
    for (std::size_t block = 0; block < critical.size(); ++block) {
      const auto collides = critical[block] >= in_contact;
      any_is_free |= (critical[block] < in_contact).any();
      const Lanes raw = collides.select(of_collision, critical[block]);
      const Lanes beyond = collides.select(0.0f, (repulsive[block] - least) / static_cast<float>(batch.steps));
      add_raised(data, static_cast<int>(block), of_margin * raw + of_inflation * beyond, power);
    }
    data.all_collide |= !any_is_free;
  }
};

// The mean distance from the goal.
struct GoalCritic {
  Declare declare;
  Weight weight = declare.weight(5.0, "the mean distance to the goal");
  Number threshold_to_consider = declare.nearer_than(1.4);

  void add(CriticData& data) const {
    const Scene& scene = data.scene;
    if (!(scene.goal_distance_m < threshold_to_consider)) return;
    const float share = 1.0f / static_cast<float>(data.batch.steps);
    weight.add_sums(data, [&](int block, int i) -> Lanes {
      return share * distances(data.batch, block, i, scene.goal_x, scene.goal_y);
    });
  }
};

// The mean deviation from the goal's heading.
struct GoalAngleCritic {
  Declare declare;
  Weight weight = declare.weight(3.0, "the deviation from the goal heading");
  Number threshold_to_consider = declare.nearer_than(0.5);

  void add(CriticData& data) const {
    const float goal_theta = data.scene.goal_theta;
    if (!(data.scene.goal_distance_m < threshold_to_consider) || std::isnan(goal_theta)) return;
    const float share = 1.0f / static_cast<float>(data.batch.steps);
    weight.add_sums(data, [&](int block, int i) -> Lanes {
      const auto aside = [&](float theta) { return share * std::abs(turn(theta, goal_theta)); };
      return data.batch.theta.row(block, i).unaryExpr(aside);
    });
  }
};

// The mean distance between points of a trajectory and points of the path after the same way driven.
struct PathAlignCritic {
  Declare declare;
  Weight weight = declare.weight(14.0, "the mean distance from the path");
  Number max_path_occupancy_ratio =
      declare.number("max_path_occupancy_ratio", 0.05, 1.0, "it counts if no greater share of the path is blocked");
  Param<int> offset_from_furthest =
      declare.count("offset_from_furthest", 20, 0, 1000, "it counts if trajectories reach this point of the path");
  Param<int> trajectory_point_step =
      declare.count("trajectory_point_step", 4, 1, 50, "poses from one that is compared to the next");
  Number threshold_to_consider = declare.farther_than(0.5);
  Param<bool> use_path_orientations = declare.flag("use_path_orientations", false, "headings count too");

  // Not while the robot first turns to the path, nor where obstacles are on a good part of it.
  bool is_considered(const Scene& scene) const {
    if (scene.goal_distance_m < threshold_to_consider) return false;
    const int segments = scene.furthest;
    if (segments < std::max(*offset_from_furthest, 1)) return false;
    float occupied = 0.0f;
    for (int i = 0; i < segments; ++i) {
      if (!scene.path_free[static_cast<std::size_t>(i)]) occupied += 1.0f;
      if (occupied > 2.0f && occupied / static_cast<float>(segments) > max_path_occupancy_ratio) return false;
    }
    return true;
  }

  void add(CriticData& data) const {
    const Scene& scene = data.scene;
    const Batch& batch = data.batch;
    if (!is_considered(scene)) return;
    const auto farthest = static_cast<float>(scene.furthest - 1);
    const int step = trajectory_point_step;
    const bool with_headings = use_path_orientations;
    for (int block = 0; block < batch.blocks; ++block) {
      Lanes driven = Lanes::Zero(), sums = driven, counts = driven;
      for (int i = step; i < batch.steps; i += step) {
        const Lanes& x = batch.x.row(block, i);
        const Lanes& y = batch.y.row(block, i);
        const Lanes& theta = batch.theta.row(block, i);
        driven += ((x - batch.x.row(block, i - step)).square() + (y - batch.y.row(block, i - step)).square()).sqrt();
        const Lanes point = (driven / path_spacing_m + 0.5f).min(farthest);
        Lanes free, dx, dy, aside;
        for (int l = 0; l < lanes; ++l) {
          const auto at = static_cast<std::size_t>(static_cast<std::int32_t>(point[l]));
          free[l] = scene.path_free[at] ? 1.0f : 0.0f;
          dx[l] = scene.path_x[at] - x[l];
          dy[l] = scene.path_y[at] - y[l];
          aside[l] = with_headings ? turn(scene.path_theta[at], theta[l]) : 0.0f;
        }
        sums += free * (dx.square() + dy.square() + aside.square()).sqrt();
        counts += free;
      }
      weight.add(data, block, sums / counts.max(1.0f));
    }
  }
};

// The distance of a trajectory's end from a point of the path somewhat beyond what the trajectories reach. Where the
// path leads through obstacles, that is its first free point after them.
struct PathFollowCritic {
  Declare declare;
  Weight weight = declare.weight(5.0, "the distance to a point further on the path");
  Param<int> offset_from_furthest =
      declare.count("offset_from_furthest", 5, 0, 1000, "that point is this many after the furthest reached");
  Number threshold_to_consider = declare.farther_than(1.4);

  void add(CriticData& data) const {
    const Scene& scene = data.scene;
    if (scene.path_x.size() < 2 || scene.goal_distance_m < threshold_to_consider) return;
    const std::size_t last = scene.path_x.size() - 1;
    std::size_t target = std::min(static_cast<std::size_t>(scene.furthest + offset_from_furthest), last);
    while (target + 1 < last && !scene.path_free[target]) ++target;
    for (int block = 0; block < data.batch.blocks; ++block)
      weight.add(data, block,
                 distances(data.batch, block, data.batch.steps - 1, scene.path_x[target], scene.path_y[target]));
  }
};

// How far the heading at a trajectory's end points away from the path, if the robot's heading now does.
struct PathAngleCritic {
  enum Mode { forward_preference, no_directional_preference, consider_path_orientations };

  Declare declare;
  Weight weight = declare.weight(2.0, "heading away from the path");
  Param<int> offset_from_furthest =
      declare.count("offset_from_furthest", 4, 0, 1000, "toward the point this many after the furthest reached");
  Number threshold_to_consider = declare.farther_than(0.5);
  Number max_angle_to_furthest =
      declare.number("max_angle_to_furthest", 1.0, 3.2, "it counts if the robot heads farther away than this", "rad");
  Param<int> mode = declare.count("mode", 0, 0, 2, "0: forward; 1: forward or backward; 2: as the path leads");

  void add(CriticData& data) const {
    const Scene& scene = data.scene;
    if (scene.path_x.empty() || scene.goal_distance_m < threshold_to_consider) return;
    const std::size_t target =
        std::min(static_cast<std::size_t>(scene.furthest + offset_from_furthest), scene.path_x.size() - 1);
    const float to_x = scene.path_x[target];
    const float to_y = scene.path_y[target];
    const float along = scene.path_theta[target];
    // a robot that may not drive backward has to face its path
    const bool either = mode == no_directional_preference && data.model.limits.v_min != 0.0f;
    // the angle between a heading and the way to the target; backward counts as forward where the mode says so
    const auto aside = [&](float x, float y, float theta) {
      const float way = std::atan2(to_y - y, to_x - x);
      const float ahead = std::abs(turn(theta, way));
      if (either) return std::min(ahead, pi - ahead);
      return mode == consider_path_orientations && std::abs(turn(along, way)) > 0.5f * pi ? pi - ahead : ahead;
    };
    if (aside(0.0f, 0.0f, scene.theta) < max_angle_to_furthest) return;
    const Batch& batch = data.batch;
    const int last = batch.steps - 1;
    for (int block = 0; block < batch.blocks; ++block) {
      Lanes angles;
      for (int l = 0; l < lanes; ++l)
        angles[l] = aside(batch.x.row(block, last)[l], batch.y.row(block, last)[l], batch.theta.row(block, last)[l]);
      weight.add(data, block, angles);
    }
  }
};

// The distance driven backward.
struct PreferForwardCritic {
  Declare declare;
  Weight weight = declare.weight(5.0, "driving backward");
  Number threshold_to_consider = declare.farther_than(0.5);

  void add(CriticData& data) const {
    if (data.scene.goal_distance_m < threshold_to_consider) return;
    const Batch& batch = data.batch;
    weight.add_sums(data, [&](int block, int i) -> Lanes {
      return data.model.step_s * (-velocities(batch.v_x, block, i, batch.now.v_x)).max(0.0f);
    });
  }
};

// The mean turning rate.
struct TwirlingCritic {
  Declare declare;
  Weight weight = declare.weight(10.0, "the mean turning rate");

  void add(CriticData& data) const {
    const Batch& batch = data.batch;
    if (data.scene.goal_distance_m < data.scene.goal_tolerance_m) return;
    const float share = 1.0f / static_cast<float>(batch.steps);
    weight.add_sums(data, [&](int block, int i) -> Lanes {
      return share * velocities(batch.omega, block, i, batch.now.omega).abs();
    });
  }
};

template <class Scorer>
Critic make(ParameterTable& table, const char* name) {
  const std::shared_ptr<const Scorer> scorer(new Scorer{{table, name}});
  return {name, [scorer](CriticData& data) { scorer->add(data); }};
}

}  // namespace

std::vector<Critic> all_critics(ParameterTable& table) {
  return {make<ConstraintCritic>(table, "ConstraintCritic"),       make<CostCritic>(table, "CostCritic"),
          make<ObstaclesCritic>(table, "ObstaclesCritic"),         make<GoalCritic>(table, "GoalCritic"),
          make<GoalAngleCritic>(table, "GoalAngleCritic"),         make<PathAlignCritic>(table, "PathAlignCritic"),
          make<PathFollowCritic>(table, "PathFollowCritic"),       make<PathAngleCritic>(table, "PathAngleCritic"),
          make<PreferForwardCritic>(table, "PreferForwardCritic"), make<TwirlingCritic>(table, "TwirlingCritic")};
}

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

}  // namespace dmrp::controllers::mppi
