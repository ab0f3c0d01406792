// SPDX-License-Identifier: MIT
// rehearsal.hpp: one trial of one instance on a stage: start(), the calls of its kind, trial_end().
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "host/check/rehearsal/inputs.hpp"
#include "host/check/rehearsal/stage.hpp"
#include "host/plugins/instance.hpp"

namespace dmrp::host {

using Outputs = std::vector<double>;  // all that a plugin gave, statuses too

class Rehearsal {
 public:
  // Starts the instance, which outlives it. All functions throw PluginFault, also where an output is not what the contract
  // demands.
  Rehearsal(Instance& instance, const PluginInfo& info, const StageSettings& settings, std::uint64_t seed);

  // The next calls; false once the trial is over.
  bool advance();

  Stage& stage() { return *stage_; }
  const Outputs& outputs() const { return outputs_; }

 private:
  std::unique_ptr<Stage> stage_;
  std::function<bool(Outputs&)> calls_;
  std::unique_ptr<Inputs> world_;  // what start() got: valid for the whole trial
  Outputs outputs_;
};

// The whole trial.
Outputs rehearse(Instance& instance, const PluginInfo& info, const StageSettings& settings, std::uint64_t seed);

// The calls of one kind, after start(): each call of the function makes the next, until it returns false. Offers the
// instance its extensions. The stage outlives the function.
using Calls = std::function<bool(Outputs&)>;
Calls planner_calls(Instance& instance, const PluginInfo& info, Stage& stage);
Calls controller_calls(Instance& instance, const PluginInfo& info, Stage& stage);
Calls pedestrian_calls(Instance& instance, const PluginInfo& info, Stage& stage);
Calls metric_calls(Instance& instance, const PluginInfo& info, Stage& stage);

}  // namespace dmrp::host
