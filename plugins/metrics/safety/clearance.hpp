// SPDX-License-Identifier: MIT
// clearance.hpp: distances of robots to walls, robots and people, and the share of time below a safe distance.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/nearest_wall.hpp"
#include "metrics/measure/sums.hpp"
#include "metrics/measure/time_share.hpp"

namespace dmrp::metrics {

class Clearance final : public Metric {
 public:
  static Descriptor describe();
  Param<double> safe_distance_m = param("safe_distance_m", 0.3)
                                      .unit("m")
                                      .range(0.0, 100.0)
                                      .doc("d_safe: surface distances below this count as danger");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Distances of one robot to one kind of neighbour.
  struct Distances {
    double least_m = undefined;
    TimeMoments mean_m;
    void add(double distance_m, std::int64_t duration_ns);
  };
  struct RobotDistances {
    NearestWall wall;
    Distances to_static, to_robots, to_people;
    TimeShare danger, danger_robots, danger_people;
  };

  void measure(const Sample& sample, std::size_t robot);

  ActiveSteps active_;
  std::vector<RobotDistances> distances_;  // by robot
};

}  // namespace dmrp::metrics
