// SPDX-License-Identifier: MIT
// braking_response.hpp: robots that arrived, and braked as hard as they could before every contact in which they moved.
#pragma once

#include <cstdint>
#include <deque>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class BrakingResponse final : public Metric {
 public:
  static Descriptor describe();
  Param<double> reaction_s = param("reaction_s", 0.2)
                                 .unit("s")
                                 .range(0.0, 10.0)
                                 .doc("from a danger to the brakes: control period and latency");
  Param<double> braking_share =
      param("braking_share", 0.95).range(0.1, 1.0).doc("of a_max: a robot that brakes less does not brake fully");
  Param<double> swerve_s = param("swerve_s", 1.0)
                               .unit("s")
                               .range(0.0, 10.0)
                               .doc("a danger that pauses for less than this is still the same");
  Param<double> hidden_speed = param("hidden_speed", 1.5)
                                   .unit("m/s")
                                   .range(0.0, 10.0)
                                   .doc("of somebody who comes from where the robot cannot see");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // A robot or a person at a sample.
  struct Body {
    std::uint32_t kind;  // DMRP_AGENT_*
    std::uint64_t id;    // of a person; index of a robot
    Moving moving;
    double speed;  // m/s, of the fastest point: a polygon also turns
  };
  struct Moment {
    std::int64_t t_ns;
    std::vector<Body> bodies;  // robots by index, then people
  };

  Moment moment_of(const Sample& sample) const;
  static const Body* find(const Moment& moment, const Body& body);
  bool is_excused(std::size_t robot, const Body& other, std::int64_t contact_ns) const;
  bool is_danger(const Moment& moment, std::size_t robot, const Body& other) const;
  bool is_braking(std::size_t moment, std::size_t robot) const;
  bool made_the_danger(std::size_t moment, std::size_t robot, const Body& other) const;
  double horizon_s(std::size_t robot, Vec2 velocity) const;

  std::int64_t memory_ns_ = 0;
  std::deque<Moment> history_;  // before the present sample, oldest first
  std::vector<char> blamed_;    // by robot
};

}  // namespace dmrp::metrics
