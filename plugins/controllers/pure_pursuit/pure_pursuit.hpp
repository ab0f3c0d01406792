// SPDX-License-Identifier: MIT
// pure_pursuit.hpp: regulated pure pursuit.
//
// Macenski, Singh, Martin, Gines: Regulated pure pursuit for robot path tracking, Autonomous Robots 47 (2023).
// Parameters have the names of nav2; the limits of speeds and accelerations come from the robot.
//
// Drives beside the published differential one:
// - Ackermann: arcs no tighter than the steering allows; never turns in place, also not at the goal, so it cannot reach
//   a goal heading that its path does not lead to
// - holonomic: straight to the look-ahead point, while it turns to face it
#pragma once

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/path_controller.hpp"

namespace dmrp::controllers {

class PurePursuit final : public PathController {
 public:
  static Descriptor describe();

  Param<double> lookahead_dist =
      param("lookahead_dist", 0.6).unit("m").range(0.05, 10.0).doc("look-ahead if it does not scale with speed");
  Param<bool> use_velocity_scaled_lookahead_dist =
      param("use_velocity_scaled_lookahead_dist", true).doc("look ahead by speed times lookahead_time");
  Param<double> min_lookahead_dist =
      param("min_lookahead_dist", 0.3).unit("m").range(0.05, 10.0).doc("least look-ahead that scales with speed");
  Param<double> max_lookahead_dist =
      param("max_lookahead_dist", 0.9).unit("m").range(0.05, 10.0).doc("greatest look-ahead that scales with speed");
  Param<double> lookahead_time =
      param("lookahead_time", 1.5).unit("s").range(0.05, 10.0).doc("look-ahead is speed times this");
  Param<double> min_approach_linear_velocity =
      param("min_approach_linear_velocity", 0.05).unit("m/s").range(0.01, 1.0).doc("least speed near the end");
  Param<double> approach_velocity_scaling_dist =
      param("approach_velocity_scaling_dist", 0.6).unit("m").range(0.01, 10.0).doc("slow down this far from the end");
  Param<bool> use_regulated_linear_velocity_scaling =
      param("use_regulated_linear_velocity_scaling", true).doc("slow down in curves");
  Param<double> regulated_linear_scaling_min_radius = param("regulated_linear_scaling_min_radius", 0.9)
                                                          .unit("m")
                                                          .range(0.05, 10.0)
                                                          .doc("curves tighter than this are taken slower");
  Param<double> regulated_linear_scaling_min_speed = param("regulated_linear_scaling_min_speed", 0.25)
                                                         .unit("m/s")
                                                         .range(0.01, 10.0)
                                                         .doc("least speed of curves and of near obstacles");
  Param<bool> use_cost_regulated_linear_velocity_scaling =
      param("use_cost_regulated_linear_velocity_scaling", true).doc("slow down near obstacles");
  Param<double> cost_scaling_dist =
      param("cost_scaling_dist", 0.6).unit("m").range(0.05, 10.0).doc("slow down nearer to obstacles than this");
  Param<double> cost_scaling_gain =
      param("cost_scaling_gain", 1.0).unit("1").range(0.01, 1.0).doc("factor on the speed near obstacles");
  Param<bool> use_rotate_to_heading =
      param("use_rotate_to_heading", true).doc("turn in place if the path leads aside or back");
  Param<double> rotate_to_heading_min_angle = param("rotate_to_heading_min_angle", 0.785)
                                                  .unit("rad")
                                                  .range(0.05, 3.2)
                                                  .doc("turn in place if the look-ahead point is farther aside");
  Param<bool> use_collision_detection = param("use_collision_detection", true).doc("stop if the arc ahead collides");
  Param<double> max_allowed_time_to_collision_up_to_carrot = param("max_allowed_time_to_collision_up_to_carrot", 1.5)
                                                                 .unit("s")
                                                                 .range(0.1, 10.0)
                                                                 .doc("how far ahead in time the arc is checked");
  Param<double> footprint_padding =
      param("footprint_padding", 0.05).unit("m").range(0.0, 0.5).doc("kept free around the footprint");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  double look_ahead(const Observation& now) const;
  Command pursue(const Observation& now, double look_ahead_m, const dmrp_costmap* map) const;
  Command turn_in_place(const Observation& now, double angle) const;
  Command translate(const Observation& now, Vec2 carrot, const dmrp_costmap* map) const;
  double regulated_speed(const Observation& now, double curvature, const dmrp_costmap* map) const;
  double approach_speed(const Observation& now) const;
  bool is_blocked(const Observation& now, const Command& command, const dmrp_costmap* map) const;
  bool has_drive(std::uint32_t kinematics) const { return kinematics_ == kinematics; }

  std::uint32_t kinematics_ = DMRP_KINEMATICS_DIFFERENTIAL;
  const dmrp_local_costmap* costmap_ = nullptr;
};

}  // namespace dmrp::controllers
