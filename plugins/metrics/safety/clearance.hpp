// SPDX-License-Identifier: MIT
// clearance.hpp: how much room robots keep to walls, to each other and to people, and how long they keep too little.
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
  Param<double> safe_distance_m =
      param("safe_distance_m", 0.3).unit("m").range(0.0, 100.0).doc("d_safe: a surface nearer than this is a danger");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Of one robot to one kind of partner.
  struct Room {
    double least_m = undefined;
    TimeMoments mean_m;
    void add(double distance_m, std::int64_t duration_ns);
  };
  struct Rooms {
    NearestWall wall;
    Room to_static, to_robots, to_people;
    TimeShare danger, danger_robots, danger_people;
  };

  void measure(const Sample& sample, std::size_t robot);

  ActiveSteps active_;
  std::vector<Rooms> rooms_;  // a robot
};

}  // namespace dmrp::metrics
