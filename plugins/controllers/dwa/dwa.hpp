// SPDX-License-Identifier: MIT
// dwa.hpp: the dynamic window approach with the critics of ROS's dwa_local_planner.
//
// Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation Magazine 4
// (1997).
#pragma once

#include <array>
#include <optional>

#include "controllers/dwa/critics.hpp"
#include "controllers/dwa/path_fronts.hpp"
#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/path_controller.hpp"

namespace dmrp::controllers {

class Dwa final : public PathController {
 public:
  static Descriptor describe();

  Param<double> sim_time = param("sim_time", 1.7).unit("s").range(0.1, 10.0).doc("how far ahead arcs are simulated");
  Param<double> sim_granularity =
      param("sim_granularity", 0.025).unit("m").range(0.001, 1.0).doc("step of the collision check along an arc");
  Param<double> angular_sim_granularity = param("angular_sim_granularity", 0.1)
                                              .unit("rad")
                                              .range(0.001, 1.0)
                                              .doc("step of the collision check along a turn");
  Param<std::int64_t> vx_samples = param("vx_samples", 3).unit("1").range(2, 100).doc("number of speeds sampled");
  Param<std::int64_t> vy_samples =
      param("vy_samples", 5).unit("1").range(2, 100).doc("number of speeds sideways sampled; holonomic drives only");
  Param<std::int64_t> vth_samples =
      param("vth_samples", 20).unit("1").range(2, 200).doc("number of turning rates sampled");
  Param<double> path_distance_bias =
      param("path_distance_bias", 0.6).unit("1/m").range(0.0, 100.0).doc("weight of the distance from the path");
  Param<double> goal_distance_bias = param("goal_distance_bias", 0.8)
                                         .unit("1/m")
                                         .range(0.0, 100.0)
                                         .doc("weight of the distance to the end of the path in the window");
  Param<double> occdist_scale =
      param("occdist_scale", 0.01).unit("1").range(0.0, 10.0).doc("weight of the footprint's highest cost");
  Param<double> twirling_scale =
      param("twirling_scale", 0.0).unit("s/rad").range(0.0, 10.0).doc("weight of the turning rate");
  Param<double> forward_point_distance =
      param("forward_point_distance", 0.325).unit("m").range(0.0, 2.0).doc("from the robot's centre to its nose");
  Param<double> scaling_speed =
      param("scaling_speed", 0.25).unit("m/s").range(0.0, 10.0).doc("above this the footprint grows");
  Param<double> max_scaling_factor =
      param("max_scaling_factor", 0.2).unit("1").range(0.0, 1.0).doc("growth of the footprint at full speed");
  Param<double> oscillation_reset_dist = param("oscillation_reset_dist", 0.05)
                                             .unit("m")
                                             .range(0.0, 10.0)
                                             .doc("after moving this far, the robot may reverse again");
  Param<double> oscillation_reset_angle = param("oscillation_reset_angle", 0.2)
                                              .unit("rad")
                                              .range(0.0, 3.2)
                                              .doc("after turning this far, the robot may reverse again");
  Param<bool> use_dwa =
      param("use_dwa", true).doc("sample the velocities reachable within a control period; off: within sim_time");
  Param<double> footprint_padding =
      param("footprint_padding", 0.01).unit("m").range(0.0, 0.5).doc("kept free around the footprint");
  Param<double> max_global_plan_lookahead_dist = param("max_global_plan_lookahead_dist", 100.0)
                                                     .unit("m")
                                                     .range(0.5, 100.0)
                                                     .doc("length of the path considered, inside the window");
  Param<bool> leave_padding = param("leave_padding", false)
                                  .doc("departure: after standing beside an obstacle for 2 s, drive clear of it first");
  Param<bool> turn_to_better_heading =
      param("turn_to_better_heading", true)
          .doc("departure: if standing still scores best, turn in place to a heading that scores better");
  Param<bool> leave_path_if_stalled =
      param("leave_path_if_stalled", true)
          .doc(
              "departure: after standing for 2 s before a free path, the goal critics alone count for a nose's length");
  Param<bool> extend_path =
      param("extend_path", true).doc("departure: the path goes straight on beyond its end, by the nose's length");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  Status choose(const Observation& now, const CostmapView& map, FootprintCheck& footprint, Command& command);
  void sample_window(const Observation& now);
  std::array<dwa::Box, 2> reachable_boxes(const Observation& now) const;
  bool is_stalled(const Observation& now);
  bool leaves_path(Vec2 robot, bool stalled);
  std::optional<FootprintCheck> room_to_leave_for(const Observation& now, const CostmapView& map, bool begins);
  std::optional<double> better_heading(const dwa::Scene& scene, FootprintCheck& footprint) const;
  Command turn(const Observation& now, double heading, FootprintCheck& footprint) const;
  Command approach(const Observation& now, const dwa::Sample& choice) const;
  void annotate(const dwa::Scene& scene, const dwa::Sample& choice) const;

  const dmrp_local_costmap* costmap_ = nullptr;
  dwa::Tuning tuning_;

  // state from one control cycle to the next
  dwa::OscillationGuard oscillation_;
  std::int64_t standing_ns_ = 0;
  std::optional<double> turn_to_;   // the heading of a turn in place
  bool leaving_ = false;            // driving clear of an obstacle
  std::optional<Vec2> stalled_at_;  // where the robot stood while the path critics held it

  // buffers, filled anew in every cycle
  dwa::VelocityWindow window_;
  dwa::PathFronts fronts_;
};

}  // namespace dmrp::controllers
