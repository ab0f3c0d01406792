// SPDX-License-Identifier: MIT
// breach.hpp: whether the contract allows what a plugin answered.
#pragma once

#include <dmrp/local_controller.h>
#include <dmrp/values.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "host/plugins/plugin_info.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// What is wrong with an answer, in words that follow the function's name; "" if it may be so.
std::string breach_of(const dmrp_command& command);
std::string breach_of(std::uint64_t person, dmrp_vec2 velocity);

// The values and events of a metric in one trial: takes what the contract allows. A guest collects in one what its metric
// gives; the judge, whom a guest can send anything, adds it all again.
class MetricAnswer {
 public:
  // `info` outlives it. `index` goes into the result.
  MetricAnswer(const PluginInfo& info, std::uint32_t robots, std::uint32_t index)
      : info_(info), robots_(robots), result_{index, {}, {}} {}

  // Why it is not taken; "" if it is.
  std::string add(MetricValue value);
  std::string add(MetricEvent event);

  // Why the whole answer is not what a metric gives: it is too large, or has no value of the system for a declared name; "" if
  // it is. `refused`, why the last one was not taken, goes to the end of that.
  std::string breach(const std::string& refused) const;

  MetricResult& result() { return result_; }

 private:
  // What tells one value from another.
  using Key = std::tuple<std::string, std::uint32_t, std::optional<std::uint64_t>, std::optional<double>>;

  std::string breach_of_value(const MetricValue& value) const;
  std::string breach_of_robot(std::uint64_t robot) const;
  std::string take_room(std::size_t bytes);

  const PluginInfo& info_;
  std::uint32_t robots_;
  MetricResult result_;
  std::set<Key> given_;
  std::size_t bytes_ = 0;  // also of what there was no room for
};

}  // namespace dmrp::host
