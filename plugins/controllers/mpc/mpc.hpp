// SPDX-License-Identifier: MIT
// mpc.hpp: minimum-time model predictive control after ROS's mpc_local_planner.
//
// Rösmann, Makarow, Bertram: Online Motion Planning Based on Nonlinear Model Predictive Control with Non-Euclidean
// Rotation Groups, European Control Conference 2021. Parameters have the names of mpc_local_planner; the
// robot's limits come from the observation.
#pragma once

#include <optional>

#include "controllers/motion/drive_ability.hpp"
#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/guide.hpp"
#include "controllers/motion/path_ahead.hpp"
#include "controllers/motion/path_controller.hpp"
#include "controllers/mpc/feasibility.hpp"
#include "controllers/mpc/trajectory_optimizer.hpp"
#include "controllers/mpc/turn_in_place.hpp"

namespace dmrp::controllers {

class Mpc final : public PathController {
 public:
  static Descriptor describe();

  Param<int> grid_size_ref = param("grid_size_ref", 20).unit("1").range(2, 200).doc("states of a new trajectory");
  Param<double> dt_ref =
      param("dt_ref", 0.3).unit("s").range(0.01, 10.0).doc("time step that the grid adaptation aims at");
  Param<double> min_dt = param("min_dt", 0.0).unit("s").range(0.0, 1.0).doc("least time step");
  Param<double> max_dt = param("max_dt", 10.0).unit("s").range(0.1, 100.0).doc("greatest time step");
  Param<bool> ease_in_gaps =
      param("ease_in_gaps", true)
          .doc("departure: a way through a gap too narrow for min_obstacle_dist keeps as much as there is room for");
  Param<bool> make_room =
      param("make_room", true)
          .doc("departure: where its way is cut off, the robot waits on the right and within half of the distance");
  Param<double> dt_hyst_ratio = param("dt_hyst_ratio", 0.1)
                                    .unit("1")
                                    .range(0.0, 1.0)
                                    .doc("tolerated deviation of the time step, relative to dt_ref");
  Param<int> min_grid_size = param("min_grid_size", 2).unit("1").range(2, 200).doc("least number of states");
  Param<int> max_grid_size = param("max_grid_size", 50).unit("1").range(2, 200).doc("greatest number of states");
  Param<bool> warm_start = param("warm_start", true).doc("start from the rest of the last trajectory");
  Param<int> outer_ocp_iterations =
      param("outer_ocp_iterations", 5)
          .unit("1")
          .range(1, 100)
          .doc("maximum solutions per period; each begins by adapting the grid and the obstacles");
  Param<int> iterations =
      param("iterations", 100).unit("1").range(1, 1000).doc("maximum solver iterations per solution");
  Param<double> tol =
      param("tol", 1e-4).unit("1").range(1e-10, 1.0).doc("tolerance of the solver's optimality conditions");
  Param<double> min_obstacle_dist =
      param("min_obstacle_dist", 0.2).unit("m").range(0.0, 10.0).doc("kept free between the outlines");
  Param<double> force_inclusion_dist = param("force_inclusion_dist", 0.5)
                                           .unit("m")
                                           .range(0.0, 10.0)
                                           .doc("every obstacle closer to a state than this constrains it");
  Param<double> cutoff_dist = param("cutoff_dist", 2.5)
                                  .unit("m")
                                  .range(0.0, 100.0)
                                  .doc("beyond force_inclusion_dist and up to this, the closest obstacle on each side");
  Param<bool> enable_dynamic_obstacles =
      param("enable_dynamic_obstacles", true).doc("departure: predicts the motion of agents at constant velocity");
  Param<int> collision_check_no_poses = param("collision_check_no_poses", -1)
                                            .unit("1")
                                            .range(-1, 200)
                                            .doc("states whose footprint must be free on the costmap; -1: all");
  Param<double> max_global_plan_lookahead_dist =
      param("max_global_plan_lookahead_dist", 1.5).unit("m").range(0.2, 100.0).doc("length of the path planned along");
  Param<double> force_reinit_new_goal_dist = param("force_reinit_new_goal_dist", 1.0)
                                                 .unit("m")
                                                 .range(0.0, 100.0)
                                                 .doc("restarts if the end of the plan jumps farther");
  Param<double> force_reinit_new_goal_angular = param("force_reinit_new_goal_angular", 1.57)
                                                    .unit("rad")
                                                    .range(0.0, 3.2)
                                                    .doc("restarts if the end of the plan turns farther");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  // Where this cycle's trajectory ends.
  struct Target {
    mpc::State goal = {0.0, 0.0, 0.0};
    bool ends_at_rest = false;
    bool fixes_heading = true;
    bool is_guided = false;  // route_ comes from guide_, not from the path
  };
  // The input of one control cycle.
  struct Cycle {
    mpc::Surroundings around;
    const CostmapView& map;
  };

  void leave_out_wait(const mpc::Surroundings& around);
  Command first_command(const Observation& now) const;
  const std::vector<Obstacle>& gather_obstacles(const Observation& now, const CostmapView& map);
  std::optional<Target> choose_target(const Observation& now, const CostmapView& map, FootprintCheck& footprint);
  std::optional<Target> place_before_obstacle(const Cycle& cycle, Target target) const;
  void look_ahead(const Observation& now, const CostmapView& map, FootprintCheck& footprint);
  bool has_room(const Observation& now, const Pose& at) const;
  bool stands_at_wall(const Observation& now) const;
  void spread_guide(const Observation& now, const CostmapView& map, Vec2 to);
  void pose_problem(const Observation& now, const CostmapView& map, const Target& target);
  double share_in_gaps(const Observation& now, const CostmapView& map, Vec2 goal);
  mpc::OptimizerSettings optimizer_settings() const;
  std::optional<int> plan(const Cycle& cycle, const Target& target);
  bool rolls_out_nearer();
  bool can_continue() const;
  bool stands_short(const Observation& now) const;
  void annotate(int solver_iterations) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_obstacle_clusters* clusters_ = nullptr;

  // state from one control cycle to the next
  SteeringEstimate steering_;
  mpc::Trajectory trajectory_;  // the warm start; empty if there is none
  mpc::TurnInPlace turn_;

  // buffers, filled anew in every cycle
  PathAhead ahead_;
  ObstacleSet obstacle_set_;
  std::vector<Obstacle> obstacles_;
  Guide guide_;
  std::vector<Vec2> route_;  // to start a trajectory along
  mpc::Problem problem_;
  mpc::TrajectoryOptimizer optimizer_;
};

}  // namespace dmrp::controllers
