// SPDX-License-Identifier: MIT
// world_name.hpp: the name of a trial's scenario without swept values.
#pragma once

#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

inline std::vector<SweptValue> swept_of_scenario(const TrialRecord& trial) {
  std::vector<SweptValue> swept = trial.swept;
  std::erase_if(swept, [](const SweptValue& one) { return is_of_plugin(one); });
  return swept;
}

inline std::string world_name(const TrialRecord& trial) {
  return trial.scenario.substr(0, trial.scenario.size() - with_swept("", swept_of_scenario(trial)).size());
}

}  // namespace dmrp::host
