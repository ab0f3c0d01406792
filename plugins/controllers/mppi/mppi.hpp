// SPDX-License-Identifier: MIT
// mppi.hpp: model predictive path integral control as in nav2.
//
// Parameters have the names of nav2, with '_' for the '.' between a critic and its parameter, and the values that nav2
// is shipped with (nav2_bringup 1.4.2). Limits come from the robot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "controllers/motion/path_controller.hpp"
#include "controllers/mppi/cost_field.hpp"
#include "controllers/mppi/critics.hpp"
#include "controllers/mppi/noise.hpp"
#include "controllers/mppi/optimizer.hpp"
#include "controllers/mppi/still_costmap.hpp"

namespace dmrp::controllers {

class Mppi final : public PathController {
 public:
  static Descriptor describe();

  // How much a critic counts, and the power to which its weighted cost is raised.
  struct CriticWeight {
    Param<int> power;
    Param<double> weight;

    operator mppi::Weight() const { return {static_cast<float>(*weight), power}; }
  };

  Param<int> batch_size = param("batch_size", 2000).unit("1").range(1, 100000).doc("number of sampled trajectories");
  Param<int> time_steps = param("time_steps", 56).unit("1").range(8, 256).doc("steps of a trajectory");
  Param<double> model_dt = param("model_dt", 0.05).unit("s").range(0.01, 0.5).doc("duration of a step");
  Param<int> iteration_count =
      param("iteration_count", 1).unit("1").range(1, 20).doc("times the samples are drawn and averaged in a cycle");
  Param<int> retry_attempt_limit =
      param("retry_attempt_limit", 1).unit("1").range(0, 10).doc("new attempts from rest if every trajectory collides");
  Param<double> vx_std =
      param("vx_std", 0.2).unit("m/s").range(0.0, 5.0).doc("standard deviation of sampled forward speeds");
  Param<double> vy_std =
      param("vy_std", 0.2).unit("m/s").range(0.0, 5.0).doc("standard deviation of sampled sideways speeds");
  Param<double> wz_std =
      param("wz_std", 0.4).unit("rad/s").range(0.0, 10.0).doc("standard deviation of sampled turning rates");
  Param<double> temperature = param("temperature", 0.3)
                                  .unit("1")
                                  .range(0.0001, 1000.0)
                                  .doc("how evenly samples are weighted; near 0 only the best counts");
  Param<double> gamma =
      param("gamma", 0.015).unit("1").range(0.0, 1000.0).doc("weight of the control cost against that of the critics");
  Param<bool> regenerate_noises = param("regenerate_noises", true).doc("draw other noise in every iteration");
  Param<double> prune_distance =
      param("prune_distance", 1.7).unit("m").range(0.1, 20.0).doc("length of the path considered");
  Param<bool> enforce_path_inversion =
      param("enforce_path_inversion", false).doc("consider the path only up to where it turns back");
  Param<bool> sample_forward =
      param("sample_forward", false).doc("departure: a robot that may not drive backward samples no speeds below zero");
  Param<double> inversion_xy_tolerance = param("inversion_xy_tolerance", 0.2)
                                             .unit("m")
                                             .range(0.0, 5.0)
                                             .doc("the path counts as turned back when this close to the point");
  Param<std::vector<std::string>> critics =
      param("critics",
            std::vector<std::string>{"ConstraintCritic", "CostCritic", "GoalCritic", "GoalAngleCritic",
                                     "PathAlignCritic", "PathFollowCritic", "PathAngleCritic", "PreferForwardCritic"})
          .doc("the critics that score trajectories");
  CriticWeight ConstraintCritic = critic_weight("ConstraintCritic", 4.0, "speeds beyond the limits");
  CriticWeight CostCritic = critic_weight("CostCritic", 3.81, "cells passed");
  Param<double> CostCritic_critical_cost = param("CostCritic_critical_cost", 300.0)
                                               .unit("1")
                                               .range(0.0, 1000000.0)
                                               .doc("cost of a pose in a cell of near_collision_cost or more");
  Param<int> CostCritic_near_collision_cost = param("CostCritic_near_collision_cost", 253)
                                                  .unit("1")
                                                  .range(1, 253)
                                                  .doc("cells that cost this much are critical");
  Param<double> CostCritic_collision_cost = param("CostCritic_collision_cost", 1000000.0)
                                                .unit("1")
                                                .range(0.0, 1000000000.0)
                                                .doc("cost of a trajectory that collides");
  Param<double> CostCritic_near_goal_distance = goal_distance(
      "CostCritic_near_goal_distance", 1.0, "nearer to the goal, only collisions and critical cells cost");
  Param<int> CostCritic_trajectory_point_step = param("CostCritic_trajectory_point_step", 2)
                                                    .unit("1")
                                                    .range(1, 50)
                                                    .doc("poses from one that is checked to the next");
  Param<int> ObstaclesCritic_cost_power =
      param("ObstaclesCritic_cost_power", 1).unit("1").range(1, 10).doc("power of the cost of distances to obstacles");
  Param<double> ObstaclesCritic_repulsion_weight = param("ObstaclesCritic_repulsion_weight", 1.5)
                                                       .unit("1")
                                                       .range(0.0, 10000.0)
                                                       .doc("weight of being within the inflation radius");
  Param<double> ObstaclesCritic_critical_weight = param("ObstaclesCritic_critical_weight", 20.0)
                                                      .unit("1")
                                                      .range(0.0, 10000.0)
                                                      .doc("weight of being within the collision margin");
  Param<double> ObstaclesCritic_collision_cost = param("ObstaclesCritic_collision_cost", 100000.0)
                                                     .unit("1")
                                                     .range(0.0, 1000000000.0)
                                                     .doc("cost of a trajectory that collides");
  Param<double> ObstaclesCritic_collision_margin_distance =
      param("ObstaclesCritic_collision_margin_distance", 0.1).unit("m").range(0.0, 5.0).doc("the collision margin");
  Param<double> ObstaclesCritic_near_goal_distance = goal_distance(
      "ObstaclesCritic_near_goal_distance", 0.5, "nearer to the goal, the inflation radius costs nothing");
  CriticWeight GoalCritic = critic_weight("GoalCritic", 5.0, "the mean distance to the goal");
  Param<double> GoalCritic_threshold_to_consider =
      goal_distance("GoalCritic_threshold_to_consider", 1.4, "it counts nearer to the goal than this");
  CriticWeight GoalAngleCritic = critic_weight("GoalAngleCritic", 3.0, "the deviation from the goal heading");
  Param<double> GoalAngleCritic_threshold_to_consider =
      goal_distance("GoalAngleCritic_threshold_to_consider", 0.5, "it counts nearer to the goal than this");
  CriticWeight PathAlignCritic = critic_weight("PathAlignCritic", 14.0, "the mean distance from the path");
  Param<double> PathAlignCritic_max_path_occupancy_ratio =
      param("PathAlignCritic_max_path_occupancy_ratio", 0.05)
          .unit("1")
          .range(0.0, 1.0)
          .doc("it counts if no greater share of the path is blocked");
  Param<int> PathAlignCritic_offset_from_furthest = param("PathAlignCritic_offset_from_furthest", 20)
                                                        .unit("1")
                                                        .range(0, 1000)
                                                        .doc("it counts if trajectories reach this point of the path");
  Param<int> PathAlignCritic_trajectory_point_step = param("PathAlignCritic_trajectory_point_step", 4)
                                                         .unit("1")
                                                         .range(1, 50)
                                                         .doc("poses from one that is compared to the next");
  Param<double> PathAlignCritic_threshold_to_consider =
      goal_distance("PathAlignCritic_threshold_to_consider", 0.5, "it counts farther from the goal than this");
  Param<bool> PathAlignCritic_use_path_orientations =
      param("PathAlignCritic_use_path_orientations", false).doc("headings count too");
  CriticWeight PathFollowCritic = critic_weight("PathFollowCritic", 5.0, "the distance to a point further on the path");
  Param<int> PathFollowCritic_offset_from_furthest = param("PathFollowCritic_offset_from_furthest", 5)
                                                         .unit("1")
                                                         .range(0, 1000)
                                                         .doc("that point is this many after the furthest reached");
  Param<double> PathFollowCritic_threshold_to_consider =
      goal_distance("PathFollowCritic_threshold_to_consider", 1.4, "it counts farther from the goal than this");
  CriticWeight PathAngleCritic = critic_weight("PathAngleCritic", 2.0, "heading away from the path");
  Param<int> PathAngleCritic_offset_from_furthest = param("PathAngleCritic_offset_from_furthest", 4)
                                                        .unit("1")
                                                        .range(0, 1000)
                                                        .doc("toward the point this many after the furthest reached");
  Param<double> PathAngleCritic_threshold_to_consider =
      goal_distance("PathAngleCritic_threshold_to_consider", 0.5, "it counts farther from the goal than this");
  Param<double> PathAngleCritic_max_angle_to_furthest = param("PathAngleCritic_max_angle_to_furthest", 1.0)
                                                            .unit("rad")
                                                            .range(0.0, 3.2)
                                                            .doc("it counts if the robot heads farther away than this");
  Param<int> PathAngleCritic_mode = param("PathAngleCritic_mode", 0)
                                        .unit("1")
                                        .range(0, 2)
                                        .doc("0: forward; 1: forward or backward; 2: as the path leads");
  CriticWeight PreferForwardCritic = critic_weight("PreferForwardCritic", 5.0, "driving backward");
  Param<double> PreferForwardCritic_threshold_to_consider =
      goal_distance("PreferForwardCritic_threshold_to_consider", 0.5, "it counts farther from the goal than this");
  CriticWeight TwirlingCritic = critic_weight("TwirlingCritic", 10.0, "the mean turning rate");
  Param<double> footprint_padding =
      param("footprint_padding", 0.01).unit("m").range(0.0, 0.5).doc("kept free around the footprint");
  Param<bool> include_dynamic_obstacles =
      param("include_dynamic_obstacles", false)
          .doc("departure: tracked agents continue at their velocity; off: they stay where they are");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  enum Critic : unsigned {
    constraint,
    cost,
    obstacles,
    goal,
    goal_angle,
    path_align,
    path_follow,
    path_angle,
    prefer_forward,
    twirling,
    critic_count
  };

  CriticWeight critic_weight(const std::string& critic, double weight, const std::string& what) {
    return {
        param((critic + "_cost_power").c_str(), 1).unit("1").range(1, 10).doc(("power of the cost of " + what).c_str()),
        param((critic + "_cost_weight").c_str(), weight).unit("1").range(0.0, 10000.0).doc("weight of it")};
  }
  ParamBuilder<double> goal_distance(const char* key, double value_m, const char* doc) {
    return param(key, value_m).unit("m").range(0.0, 20.0).doc(doc);
  }
  bool choose_critics();
  bool has(Critic critic) const { return (chosen_ >> critic & 1u) != 0; }
  void read_limits(const dmrp::Limits& limits);
  void look(const Observation& now);
  void look_at_path(const Observation& now);
  bool optimize(const Observation& now);
  bool score();
  Command first_command(const Observation& now, int steps) const;
  void annotate(const Observation& now) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_obstacle_clusters* clusters_ = nullptr;
  unsigned chosen_ = 0;  // bit i: critic i
  mppi::Model model_;
  mppi::CostSettings cost_settings_;
  mppi::ObstaclesSettings obstacles_settings_;
  mppi::PathAlignSettings path_align_settings_;
  mppi::PathAngleSettings path_angle_settings_;

  // state from one control cycle to the next
  mppi::Noise noise_;
  mppi::Optimizer optimizer_;
  std::uint32_t cycle_ = 0;  // of the noise

  // buffers, filled anew in every cycle
  ObstacleSet obstacle_set_;
  std::vector<Obstacle> moving_;
  mppi::StillCostmap still_costmap_;
  mppi::CostField field_;
  mppi::Scene scene_;
  mppi::Batch batch_;
  mppi::Costs costs_;
};

}  // namespace dmrp::controllers
