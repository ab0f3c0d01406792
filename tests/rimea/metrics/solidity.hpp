// SPDX-License-Identifier: MIT
// solidity.hpp: overlaps of people with walls and with each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <set>
#include <vector>

namespace dmrp::rimea {

class Solidity final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  void observe_walls(const Person& person);
  void observe_each_other(const Span<Person>& people);

  std::set<std::uint64_t> outside_;  // ids of people whose centres left the free space
  double wall_overlap_m_ = 0.0;
  double people_overlap_m_ = 0.0;
  std::vector<std::size_t> by_x_;  // indices of people
};

}  // namespace dmrp::rimea
