// SPDX-License-Identifier: MIT
// run_settings.hpp: the parameters and settings of each trial, from effective.toml.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/export/people_counts.hpp"
#include "host/findings/summary.hpp"

namespace dmrp::host {

// Names are those of the file: "local_controller.sim_time", "simulation.step_s", "robot.lidar.beams"; swept
// keys of [[scenario]] have their own. "people" is their number.
class RunSettings {
 public:
  // Throws InputError or std::runtime_error if the text is damaged.
  RunSettings(std::string_view effective_toml, std::span<const TrialRecord> trials, PeopleCounts people = {});

  // All names: plugins of trials with their ids and parameters first, then settings.
  const std::vector<std::string>& names() const { return names_; }

  // The value as text, numbers in their shortest exact form; "" if the trial's plugins have no such parameter. Swept
  // values come from the trial.
  std::string value(const std::string& name, const TrialRecord& trial) const;

 private:
  using Values = std::map<std::string, std::string>;

  void add_name(const std::string& name);

  std::vector<std::string> names_;
  std::map<std::string, std::map<std::string, Values>> plugins_;  // by kind, then label
  Values settings_;
  PeopleCounts people_;
};

}  // namespace dmrp::host
