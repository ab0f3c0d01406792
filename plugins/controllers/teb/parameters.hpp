// SPDX-License-Identifier: MIT
// parameters.hpp: the parameters of the timed elastic band, by their upstream names and with upstream's defaults.
#ifndef DMRP_CONTROLLERS_TEB_PARAMETERS_HPP
#define DMRP_CONTROLLERS_TEB_PARAMETERS_HPP

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/teb/tuning.hpp"

namespace dmrp::controllers::teb {

class ParameterTable : public LocalController {
 public:
  // trajectory
  Param<double> dt_ref = param("dt_ref", 0.3).unit("s").range(0.05, 2.0).doc("wanted time between two poses");
  Param<double> dt_hysteresis =
      param("dt_hysteresis", 0.1).unit("s").range(0.005, 1.0).doc("how far times may be off before poses come or go");
  Param<std::int64_t> min_samples = param("min_samples", 3).unit("1").range(3, 100).doc("poses at least");
  Param<std::int64_t> max_samples = param("max_samples", 500).unit("1").range(10, 2000).doc("poses at most");
  Param<double> max_global_plan_lookahead_dist = param("max_global_plan_lookahead_dist", 3.0)
                                                     .unit("m")
                                                     .range(0.5, 100.0)
                                                     .doc("length of the path planned along, inside the costmap");
  Param<double> global_plan_viapoint_sep = param("global_plan_viapoint_sep", -0.1)
                                               .unit("m")
                                               .range(-1.0, 100.0)
                                               .doc("distance of via-points along the path; negative: none");
  Param<double> force_reinit_new_goal_dist = param("force_reinit_new_goal_dist", 1.0)
                                                 .unit("m")
                                                 .range(0.0, 100.0)
                                                 .doc("a local goal that jumps farther makes the band anew");
  Param<double> force_reinit_new_goal_angular = param("force_reinit_new_goal_angular", 1.5707963267948966)
                                                    .unit("rad")
                                                    .range(0.0, 3.2)
                                                    .doc("one that turns farther does, too");
  Param<std::int64_t> feasibility_check_no_poses = param("feasibility_check_no_poses", 5)
                                                       .unit("1")
                                                       .range(0, 100)
                                                       .doc("how many poses are checked against the costmap");
  Param<std::int64_t> control_look_ahead_poses = param("control_look_ahead_poses", 1)
                                                     .unit("1")
                                                     .range(1, 100)
                                                     .doc("the command leads from the first pose to this one");

  // obstacles
  Param<double> min_obstacle_dist =
      param("min_obstacle_dist", 0.5).unit("m").range(0.0, 10.0).doc("kept between the footprint and obstacles");
  Param<double> inflation_dist = param("inflation_dist", 0.6)
                                     .unit("m")
                                     .range(0.0, 15.0)
                                     .doc("nearer than this to obstacles costs a little; above min_obstacle_dist");
  Param<double> dynamic_obstacle_inflation_dist =
      param("dynamic_obstacle_inflation_dist", 0.6).unit("m").range(0.0, 15.0).doc("the same for obstacles that move");
  Param<bool> include_dynamic_obstacles =
      param("include_dynamic_obstacles", true).doc("foresees the motion of agents at constant velocity");
  Param<double> obstacle_association_force_inclusion_factor =
      param("obstacle_association_force_inclusion_factor", 1.5)
          .unit("1")
          .range(0.0, 100.0)
          .doc("times min_obstacle_dist: a pose keeps away from all obstacles nearer than this");
  Param<double> obstacle_association_cutoff_factor =
      param("obstacle_association_cutoff_factor", 5.0)
          .unit("1")
          .range(1.0, 100.0)
          .doc("times min_obstacle_dist: and from the nearest on the left and on the right within this");

  // optimisation
  Param<std::int64_t> no_inner_iterations =
      param("no_inner_iterations", 5).unit("1").range(1, 100).doc("of the solver, in each outer one");
  Param<std::int64_t> no_outer_iterations =
      param("no_outer_iterations", 4).unit("1").range(1, 100).doc("each resizes the band first");
  Param<double> penalty_epsilon =
      param("penalty_epsilon", 0.05).unit("1").range(0.0, 1.0).doc("how far inside a bound its penalty begins");
  Param<double> weight_max_vel_x = weight("weight_max_vel_x", 2.0, "of the speed limit");
  Param<double> weight_max_vel_theta = weight("weight_max_vel_theta", 1.0, "of the limit on turning");
  Param<double> weight_acc_lim_x = weight("weight_acc_lim_x", 1.0, "of the acceleration limit");
  Param<double> weight_acc_lim_theta = weight("weight_acc_lim_theta", 1.0, "of the angular acceleration limit");
  Param<double> weight_kinematics_nh = weight("weight_kinematics_nh", 1000.0, "of moving along arcs only");
  Param<double> weight_kinematics_forward_drive =
      weight("weight_kinematics_forward_drive", 1.0, "of driving forward; 1000 where the limits forbid backward");
  Param<double> weight_optimaltime = weight("weight_optimaltime", 1.0, "of the time it takes");
  Param<double> weight_shortest_path = weight("weight_shortest_path", 0.0, "of the length of the way");
  Param<double> weight_obstacle = weight("weight_obstacle", 50.0, "of min_obstacle_dist");
  Param<double> weight_inflation = weight("weight_inflation", 0.1, "of inflation_dist");
  Param<double> weight_dynamic_obstacle =
      weight("weight_dynamic_obstacle", 50.0, "of min_obstacle_dist from what moves");
  Param<double> weight_dynamic_obstacle_inflation =
      weight("weight_dynamic_obstacle_inflation", 0.1, "of dynamic_obstacle_inflation_dist");
  Param<double> weight_viapoint = weight("weight_viapoint", 1.0, "of the distance from via-points");
  Param<double> weight_prefer_rotdir = weight("weight_prefer_rotdir", 50.0, "of one turning direction, in recovery");
  Param<double> weight_adapt_factor = param("weight_adapt_factor", 2.0)
                                          .unit("1")
                                          .range(1.0, 100.0)
                                          .doc("the obstacles' weights grow by this from outer iteration to the next");
  Param<double> obstacle_cost_exponent = param("obstacle_cost_exponent", 1.0)
                                             .unit("1")
                                             .range(0.5, 10.0)
                                             .doc("power of the penalty on min_obstacle_dist, where obstacles stand");

  // homotopy classes
  Param<bool> enable_homotopy_class_planning =
      param("enable_homotopy_class_planning", true).doc("keeps a band for each way round the obstacles");
  Param<std::int64_t> max_number_classes =
      param("max_number_classes", 5).unit("1").range(1, 20).doc("ways kept at most");
  Param<double> selection_cost_hysteresis = param("selection_cost_hysteresis", 1.0)
                                                .unit("1")
                                                .range(0.0, 2.0)
                                                .doc("the cost of the way chosen last counts times this");
  Param<double> selection_prefer_initial_plan = param("selection_prefer_initial_plan", 0.95)
                                                    .unit("1")
                                                    .range(0.0, 1.0)
                                                    .doc("the cost of the way along the path counts times this");
  Param<double> selection_obst_cost_scale = param("selection_obst_cost_scale", 100.0)
                                                .unit("1")
                                                .range(0.0, 1000.0)
                                                .doc("of the obstacles' share in the cost, for choosing");
  Param<double> selection_viapoint_cost_scale = param("selection_viapoint_cost_scale", 1.0)
                                                    .unit("1")
                                                    .range(0.0, 100.0)
                                                    .doc("of the via-points' share in the cost, for choosing");
  Param<bool> selection_alternative_time_cost =
      param("selection_alternative_time_cost", false).doc("chooses by the duration, not by the sum of squared times");
  Param<double> switching_blocking_period = param("switching_blocking_period", 0.0)
                                                .unit("s")
                                                .range(0.0, 60.0)
                                                .doc("no other way is chosen for so long after the last change");
  Param<std::int64_t> roadmap_graph_no_samples =
      param("roadmap_graph_no_samples", 15).unit("1").range(1, 100).doc("points drawn to find ways through");
  Param<double> roadmap_graph_area_width = param("roadmap_graph_area_width", 6.0)
                                               .unit("m")
                                               .range(0.1, 20.0)
                                               .doc("width of the area between robot and goal they are drawn from");
  Param<double> roadmap_graph_area_length_scale = param("roadmap_graph_area_length_scale", 1.0)
                                                      .unit("1")
                                                      .range(0.5, 2.0)
                                                      .doc("its length, times the distance from robot to goal");
  Param<double> obstacle_heading_threshold = param("obstacle_heading_threshold", 0.45)
                                                 .unit("1")
                                                 .range(0.0, 1.0)
                                                 .doc("cosine to the goal's direction that every leg must exceed");
  Param<bool> viapoints_all_candidates =
      param("viapoints_all_candidates", true).doc("via-points draw all ways, not only the one along the path");
  Param<bool> delete_detours_backwards =
      param("delete_detours_backwards", true).doc("drops ways that begin backward, or take far longer than the best");
  Param<double> detours_orientation_tolerance = param("detours_orientation_tolerance", 1.5707963267948966)
                                                    .unit("rad")
                                                    .range(0.0, 3.2)
                                                    .doc("backward: farther aside from the best way's beginning");
  Param<double> length_start_orientation_vector = param("length_start_orientation_vector", 0.4)
                                                      .unit("m")
                                                      .range(0.01, 10.0)
                                                      .doc("as far on, a way's beginning is looked at");
  Param<double> max_ratio_detours_duration_best_duration =
      param("max_ratio_detours_duration_best_duration", 3.0)
          .unit("1")
          .range(1.0, 100.0)
          .doc("far longer: more than the best way's duration times this");

  // recovery
  Param<bool> shrink_horizon_backup =
      param("shrink_horizon_backup", true).doc("plans half as far for a while where no way is feasible");
  Param<double> shrink_horizon_min_duration =
      param("shrink_horizon_min_duration", 10.0).unit("s").range(0.0, 60.0).doc("for so long at least");
  Param<bool> oscillation_recovery =
      param("oscillation_recovery", true).doc("keeps to one turning direction after turning to and fro");
  Param<double> oscillation_v_eps =
      param("oscillation_v_eps", 0.1).unit("1").range(0.0, 1.0).doc("to and fro: mean speed below, of its limit");
  Param<double> oscillation_omega_eps =
      param("oscillation_omega_eps", 0.1).unit("1").range(0.0, 1.0).doc("and mean turning rate below, of its limit");
  Param<double> oscillation_recovery_min_duration = param("oscillation_recovery_min_duration", 10.0)
                                                        .unit("s")
                                                        .range(0.0, 60.0)
                                                        .doc("how long the direction is kept at least");
  Param<double> oscillation_filter_duration =
      param("oscillation_filter_duration", 10.0).unit("s").range(1.0, 60.0).doc("how far the commands are looked back");

 protected:
  BandTuning band_tuning() const;
  ClassTuning class_tuning() const;

 private:
  ParamBuilder<double> weight(const char* key, double value, const char* of_what) {
    return param(key, value).unit("1").range(0.0, 1e5).doc((std::string("weight ") + of_what).c_str());
  }
};

inline BandTuning ParameterTable::band_tuning() const {
  BandTuning tuning;
  tuning.dt_ref = dt_ref;
  tuning.dt_hysteresis = dt_hysteresis;
  tuning.min_samples = static_cast<std::size_t>(*min_samples);
  tuning.max_samples = static_cast<std::size_t>(*max_samples);
  tuning.no_inner_iterations = static_cast<int>(*no_inner_iterations);
  tuning.no_outer_iterations = static_cast<int>(*no_outer_iterations);
  tuning.penalty_epsilon = penalty_epsilon;
  tuning.min_obstacle_dist = min_obstacle_dist;
  tuning.inflation_dist = inflation_dist;
  tuning.dynamic_obstacle_inflation_dist = dynamic_obstacle_inflation_dist;
  tuning.include_dynamic_obstacles = include_dynamic_obstacles;
  tuning.obstacle_association_force_inclusion_factor = obstacle_association_force_inclusion_factor;
  tuning.obstacle_association_cutoff_factor = obstacle_association_cutoff_factor;
  tuning.weight_max_vel_x = weight_max_vel_x;
  tuning.weight_max_vel_theta = weight_max_vel_theta;
  tuning.weight_acc_lim_x = weight_acc_lim_x;
  tuning.weight_acc_lim_theta = weight_acc_lim_theta;
  tuning.weight_kinematics_nh = weight_kinematics_nh;
  tuning.weight_kinematics_forward_drive = weight_kinematics_forward_drive;
  tuning.weight_optimaltime = weight_optimaltime;
  tuning.weight_shortest_path = weight_shortest_path;
  tuning.weight_obstacle = weight_obstacle;
  tuning.weight_inflation = weight_inflation;
  tuning.weight_dynamic_obstacle = weight_dynamic_obstacle;
  tuning.weight_dynamic_obstacle_inflation = weight_dynamic_obstacle_inflation;
  tuning.weight_viapoint = weight_viapoint;
  tuning.weight_prefer_rotdir = weight_prefer_rotdir;
  tuning.weight_adapt_factor = weight_adapt_factor;
  tuning.obstacle_cost_exponent = obstacle_cost_exponent;
  return tuning;
}

inline ClassTuning ParameterTable::class_tuning() const {
  ClassTuning tuning;
  tuning.enable_homotopy_class_planning = enable_homotopy_class_planning;
  tuning.max_number_classes = static_cast<std::size_t>(*max_number_classes);
  tuning.selection_cost_hysteresis = selection_cost_hysteresis;
  tuning.selection_prefer_initial_plan = selection_prefer_initial_plan;
  tuning.selection_obst_cost_scale = selection_obst_cost_scale;
  tuning.selection_viapoint_cost_scale = selection_viapoint_cost_scale;
  tuning.selection_alternative_time_cost = selection_alternative_time_cost;
  tuning.switching_blocking_period = switching_blocking_period;
  tuning.roadmap_graph_no_samples = static_cast<std::size_t>(*roadmap_graph_no_samples);
  tuning.roadmap_graph_area_width = roadmap_graph_area_width;
  tuning.roadmap_graph_area_length_scale = roadmap_graph_area_length_scale;
  tuning.obstacle_heading_threshold = obstacle_heading_threshold;
  tuning.viapoints_all_candidates = viapoints_all_candidates;
  tuning.delete_detours_backwards = delete_detours_backwards;
  tuning.detours_orientation_tolerance = detours_orientation_tolerance;
  tuning.length_start_orientation_vector = length_start_orientation_vector;
  tuning.max_ratio_detours_duration_best_duration = max_ratio_detours_duration_best_duration;
  return tuning;
}

}  // namespace dmrp::controllers::teb

#endif
