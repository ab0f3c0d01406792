// SPDX-License-Identifier: MIT
// orca.hpp: optimal reciprocal collision avoidance of robots.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011); for differential
// drives NH-ORCA, Alonso-Mora, Breitenmoser, Rufli, Beardsley, Siegwart, DARS 2010 (Springer 2013).
#pragma once

#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/motion/path_controller.hpp"
#include "controllers/orca/allowed_velocities.hpp"
#include "reciprocal/linear_program.hpp"

namespace dmrp::controllers {

class OrcaController final : public PathController {
 public:
  static Descriptor describe();

  Param<double> neighbor_distance =
      param("neighbor_distance", 5.0).unit("m").range(0.5, 50.0).doc("agents farther away are ignored");
  Param<int> max_neighbors =
      param("max_neighbors", 10).range(1, 100).doc("only so many agents count, the nearest ones");
  Param<double> time_horizon =
      param("time_horizon", 3.0).unit("s").range(0.1, 20.0).doc("collisions with agents are avoided within this time");
  Param<double> time_horizon_obst =
      param("time_horizon_obst", 1.5).unit("s").range(0.1, 20.0).doc("collisions with obstacles, likewise");
  Param<double> tracking_error = param("tracking_error", 0.1)
                                     .unit("m")
                                     .range(0.01, 1.0)
                                     .doc("a differential drive deviates this much from the holonomic velocity");
  Param<double> alignment_time = param("alignment_time", 0.35)
                                     .unit("s")
                                     .range(0.05, 5.0)
                                     .doc("a differential drive turns to the holonomic velocity in this time");
  Param<double> lookahead_dist =
      param("lookahead_dist", 1.0).unit("m").range(0.05, 10.0).doc("the preferred velocity points so far ahead");

  Status start(const Start& start) override;

 private:
  Status control(const Observation& now, Command& command) override;
  struct Near {
    double gap_m;
    const Obstacle* obstacle;
  };

  void find_near(const Observation& now);
  double error_m() const;
  void add_walls(const Observation& now, double margin_m);
  void add_drive(const Observation& now, double margin_m);
  void add_agents(const Observation& now, double margin_m);
  orca::Follower follower(const Observation& now) const;
  Vec2 preferred(const Observation& now) const;
  Command follow(const Observation& now, Vec2 velocity, Vec2 wanted) const;
  Command translate(const Observation& now, Vec2 velocity) const;

  bool holonomic_ = false;
  const dmrp_obstacle_clusters* clusters_ = nullptr;
  const dmrp_local_costmap* costmap_ = nullptr;

  // buffers, filled anew in every cycle
  ObstacleSet obstacles_;
  std::vector<Near> walls_;   // nearest first
  std::vector<Near> agents_;  // nearest first
  std::vector<reciprocal::HalfPlane> planes_;
  reciprocal::VelocityProgram program_;
};

}  // namespace dmrp::controllers
