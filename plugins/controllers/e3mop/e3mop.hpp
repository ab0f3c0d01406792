// SPDX-License-Identifier: MIT
// e3mop.hpp: state lattice search with pruned motion primitives, path optimisation with a banded structure, and a
// time-optimal velocity profile.
//
// Wen, Zhang, Gao, Yuan, Fang: E3MoP: Efficient motion planning based on heuristic-guided motion primitives pruning and
// path optimization with sparse-banded structure, IEEE Transactions on Automation Science and Engineering 19 (2022).
#pragma once

#include <dmrp/ext/distance_field.h>

#include <optional>

#include "controllers/e3mop/local_plan.hpp"
#include "controllers/e3mop/path_shaper.hpp"
#include "controllers/e3mop/way_out.hpp"
#include "controllers/motion/path_ahead.hpp"
#include "controllers/motion/path_controller.hpp"

namespace dmrp::controllers {

class E3mop final : public PathController {
 public:
  static Descriptor describe();

  Param<bool> pruning =
      param("pruning", true).doc("drop motion primitives that lead away from the heuristic's path to the goal");
  Param<double> lattice_resolution =
      param("lattice_resolution", 0.1).unit("m").range(0.05, 0.5).doc("cell of the state lattice");
  Param<double> max_global_plan_lookahead_dist = param("max_global_plan_lookahead_dist", 3.0)
                                                     .unit("m")
                                                     .range(0.5, 100.0)
                                                     .doc("length of the path planned along, inside the window");
  Param<double> weight_smoothness = param("weight_smoothness", 1.0)
                                        .unit("1/m^2")
                                        .range(1e-6, 1e6)
                                        .doc("w_s: weight of the path's second differences");
  Param<double> weight_obstacle = param("weight_obstacle", 10.0)
                                      .unit("1/m^2")
                                      .range(0.0, 1e7)
                                      .doc("w_o: weight of being closer to obstacles than safe_distance");
  Param<double> safe_distance = param("safe_distance", 0.5)
                                    .unit("m")
                                    .range(0.0, 5.0)
                                    .doc("d_s: what the robot's centre should keep from obstacles");
  Param<double> point_spacing =
      param("point_spacing", 0.1).unit("m").range(0.02, 1.0).doc("between the points that are optimised");
  Param<double> smoothing_length =
      param("smoothing_length", 3.0).unit("m").range(0.3, 20.0).doc("length of the path that is optimised");
  Param<int> max_iterations =
      param("max_iterations", 100).unit("1").range(0, 1000).doc("maximum iterations of Levenberg-Marquardt");
  Param<double> footprint_padding =
      param("footprint_padding", 0.05).unit("m").range(0.0, 0.5).doc("kept free around the footprint");
  Param<bool> leave_padding =
      param("leave_padding", true)
          .doc("departure: a robot that the collision check stops first drives clear, aside of its path");
  Param<bool> keep_right =
      param("keep_right", true)
          .doc("departure: a robot that somebody leaves no way moves to its right-hand side to let them pass");
  Param<double> prediction_time =
      param("prediction_time", 1.0)
          .unit("s")
          .range(0.0, 10.0)
          .doc("departure: time for which the predicted motion of visible agents counts as occupied");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  // The result of one lattice search.
  struct Plan {
    e3mop::LatticeGoal goal;
    const e3mop::SearchResult* found;
    Pose from;                    // where the lattice path begins
    e3mop::FreeSpace free_space;  // that it was searched in
  };

  void prepare(const Observation& now);
  Command drive(const Observation& now);
  bool read_fields(const Observation& now);
  void lay_out_global_path(const Observation& now, const CostmapView& map);
  Pose keep_path(const Observation& now, const e3mop::FreeSpace& free_space);
  std::optional<Plan> choose_plan(const Observation& now, const FootprintCheck& outline, bool has_agents);
  std::optional<Plan> plan(const Observation& now, const e3mop::FreeSpace& free_space);
  std::optional<Plan> plan_to(const e3mop::LatticeGoal& goal, const Pose& from, const Observation& now,
                              const e3mop::FreeSpace& free_space);
  void append_points(const Plan& plan);
  bool shape_path(const Observation& now, const e3mop::FreeSpace& free_space);
  Vec2 lead_point(bool is_shaped) const;
  void annotate(const std::vector<Pose>& lattice_path);

  const dmrp_local_costmap* costmap_ = nullptr;
  const dmrp_distance_field* distance_field_ = nullptr;

  // state from one control cycle to the next
  std::vector<e3mop::PathPoint> path_;  // the path in use; empty if there is none
  bool turning_ = false;                // in place
  e3mop::WayOut way_out_;
  Limits limits_{};  // for which the lattice was built

  // buffers, filled anew in every cycle
  e3mop::ClearanceField field_;     // the obstacles now
  e3mop::ClearanceField foreseen_;  // with the predicted motion of visible agents
  PathAhead ahead_;
  std::vector<Vec2> global_path_;  // the part of the path ahead that is planned to
  e3mop::LocalPlan local_plan_;
  e3mop::RoughPath rough_;
  e3mop::PathShaper shaper_;
  std::vector<Pose> intended_;  // for the annotation
};

}  // namespace dmrp::controllers
