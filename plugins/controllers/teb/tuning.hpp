// SPDX-License-Identifier: MIT
// tuning.hpp: the parameters of the timed elastic band, by their upstream names (teb_local_planner's TebConfig).
#ifndef DMRP_CONTROLLERS_TEB_TUNING_HPP
#define DMRP_CONTROLLERS_TEB_TUNING_HPP

#include <cstddef>

namespace dmrp::controllers::teb {

// How a band is kept and optimised. The initial values are upstream's.
struct BandTuning {
  double dt_ref = 0.3;         // s
  double dt_hysteresis = 0.1;  // s
  std::size_t min_samples = 3;
  std::size_t max_samples = 500;
  int no_inner_iterations = 5;
  int no_outer_iterations = 4;
  double penalty_epsilon = 0.05;  // how far inside a bound its penalty begins

  double min_obstacle_dist = 0.5;                // m, between the outlines
  double inflation_dist = 0.6;                   // m
  double dynamic_obstacle_inflation_dist = 0.6;  // m
  bool include_dynamic_obstacles = true;
  double obstacle_association_force_inclusion_factor = 1.5;
  double obstacle_association_cutoff_factor = 5.0;

  double weight_max_vel_x = 2.0;
  double weight_max_vel_theta = 1.0;
  double weight_acc_lim_x = 1.0;
  double weight_acc_lim_theta = 1.0;
  double weight_kinematics_nh = 1000.0;
  double weight_kinematics_forward_drive = 1.0;
  double weight_optimaltime = 1.0;
  double weight_shortest_path = 0.0;
  double weight_obstacle = 50.0;
  double weight_inflation = 0.1;
  double weight_dynamic_obstacle = 50.0;
  double weight_dynamic_obstacle_inflation = 0.1;
  double weight_viapoint = 1.0;
  double weight_prefer_rotdir = 50.0;
  double weight_adapt_factor = 2.0;
  double obstacle_cost_exponent = 1.0;
};

// How bands of several homotopy classes are found and chosen from.
struct ClassTuning {
  bool enable_homotopy_class_planning = true;
  std::size_t max_number_classes = 5;
  double selection_cost_hysteresis = 1.0;
  double selection_prefer_initial_plan = 0.95;
  double selection_obst_cost_scale = 100.0;
  double selection_viapoint_cost_scale = 1.0;
  bool selection_alternative_time_cost = false;
  double switching_blocking_period = 0.0;  // s
  std::size_t roadmap_graph_no_samples = 15;
  double roadmap_graph_area_width = 6.0;  // m
  double roadmap_graph_area_length_scale = 1.0;
  double obstacle_heading_threshold = 0.45;
  bool viapoints_all_candidates = true;
  bool delete_detours_backwards = true;
  double detours_orientation_tolerance = 1.57079632679489661923;  // rad
  double length_start_orientation_vector = 0.4;                   // m
  double max_ratio_detours_duration_best_duration = 3.0;
};

}  // namespace dmrp::controllers::teb

#endif
