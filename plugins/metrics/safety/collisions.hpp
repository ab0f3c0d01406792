// SPDX-License-Identifier: MIT
// collisions.hpp: contact events of robots, by partner and by fault.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace dmrp::metrics {

class Collisions final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // One contact, from its first to its last sample.
  struct Event {
    std::uint32_t kind;  // DMRP_CONTACT_*
    std::uint32_t a;     // the robot, or the first of two
    std::uint64_t b;     // the partner: index of a shape or robot, id of a person
    bool fault_of_a, fault_of_b;
    double impact_speed;  // m/s; NaN: the trace does not have it
    std::int64_t from_ns, to_ns;
  };
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, a, b

  static Pair pair_of(const Contact& contact, const Sample& sample);
  std::string text_of(const Event& event) const;

  bool planned_ = false;                // without a plan, nothing moves
  std::vector<Event> events_;           // by beginning
  std::map<Pair, std::size_t> latest_;  // index of the pair's latest event
};

}  // namespace dmrp::metrics
