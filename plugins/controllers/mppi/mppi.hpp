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
  std::vector<mppi::Critic> all_critics = mppi::all_critics(PluginAccess::parameters(*this));
  Param<double> footprint_padding =
      param("footprint_padding", 0.01).unit("m").range(0.0, 0.5).doc("kept free around the footprint");
  Param<bool> include_dynamic_obstacles =
      param("include_dynamic_obstacles", false)
          .doc("departure: tracked agents continue at their velocity; off: they stay where they are");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  bool choose_critics();
  void read_limits(const dmrp::Limits& limits);
  void look(const Observation& now);
  void look_at_path(const Observation& now);
  bool optimize(const Observation& now);
  bool score();
  Command first_command(const Observation& now, int steps) const;
  void annotate(const Observation& now) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_obstacle_clusters* clusters_ = nullptr;
  mppi::Model model_;

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
