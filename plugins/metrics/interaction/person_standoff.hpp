// SPDX-License-Identifier: MIT
// person_standoff.hpp: robots that fail after a person and they stood before each other.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"

namespace dmrp::metrics {

class PersonStandoff final : public Metric {
 public:
  static Descriptor describe();
  Param<double> lasting_s =
      param("lasting_s", 10.0).unit("s").range(0.0, 10000.0).doc("they stand before each other at least this long");
  Param<double> distance_m =
      param("distance_m", 1.3).unit("m").range(0.0, 100.0).doc("at most this far apart, centre to centre");
  Param<double> moved_m =
      param("moved_m", 0.3).unit("m").range(0.0, 100.0).doc("who moves farther than this no longer stands");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // A robot and a person who have not moved since.
  struct Standing {
    std::uint64_t person;
    std::int64_t from_ns;
    std::int64_t to_ns;
    Vec2 robot_at;
    Vec2 person_at;
  };

  bool continues(const Standing& standing, Vec2 robot, const Person& person) const;
  void close(std::size_t robot, const Standing& standing);

  ActiveSteps active_;
  std::vector<char> measured_;                    // by robot: was active
  std::vector<std::vector<Standing>> open_;       // by robot
  std::vector<std::vector<Standing>> standoffs_;  // those that lasted, by robot
};

}  // namespace dmrp::metrics
