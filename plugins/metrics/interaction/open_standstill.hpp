// SPDX-License-Identifier: MIT
// open_standstill.hpp: robots that stand although they have room and their way is free.
//
// Once a second, a robot that stands is looked at: it has room if no wall and no body is within `room_m` of it, and its
// way is free if a 4-connected way of cells of 0.1 m leads from it to its place on the path `way_m` ahead, no cell
// farther than a metre from the path, none nearer to walls, people and other robots than the robot's radius.
// Polygonal footprints count as their circumscribed circles.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class OpenStandstill final : public Metric {
 public:
  static Descriptor describe();
  Param<double> lasting_s = param("lasting_s", 15.0).unit("s").range(0.0, 10000.0).doc("shorter ones do not count");
  Param<double> moved_m =
      param("moved_m", 0.1).unit("m").range(0.0, 100.0).doc("a robot that moves farther than this does not stand");
  Param<double> room_m =
      param("room_m", 0.5).unit("m").range(0.0, 100.0).doc("free room round the robot, from body to body");
  Param<double> way_m = param("way_m", 3.0).unit("m").range(0.1, 100.0).doc("length of the way ahead that is free");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Standing {
    bool is_open = false;
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
    Vec2 at = {undefined, undefined};  // nowhere before the first look
  };

  bool is_in_the_open(const Sample& sample, std::size_t robot) const;
  bool has_free_way(const Sample& sample, std::size_t robot, const std::vector<Disc>& others) const;
  void close(std::size_t robot);

  ActiveSteps active_;
  std::vector<char> measured_;                  // by robot: was active
  std::vector<Standing> standing_;              // by robot
  std::vector<std::vector<Standing>> counted_;  // by robot
  std::int64_t looked_ns_ = -1;
};

}  // namespace dmrp::metrics
