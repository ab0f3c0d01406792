// SPDX-License-Identifier: MIT
#include "host/workers/open_trial.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "host/process/fault_kind.hpp"
#include "host/results/result_json.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

TrialRecord row_of(const Experiment& experiment, std::uint64_t trial) {
  const auto all = combinations(experiment);
  const TrialId id = trial_id(trial, all.size());
  const Combination& combination = all[id.combination];
  const ScenarioVariant& variant = experiment.scenarios[combination.scenario];
  TrialRecord record;
  record.id = trial;
  record.scenario = result_name(variant);
  record.robots = robot_count(variant);
  record.swept = variant.swept;
  const auto label = [&record](const std::vector<PluginUse>& uses, std::int32_t index) {
    if (index < 0) return std::string();
    const PluginUse& use = uses[static_cast<std::size_t>(index)];
    record.swept.insert(record.swept.end(), use.swept.begin(), use.swept.end());
    return use.label;
  };
  record.global_planner = label(experiment.global_planners, combination.global_planner);
  record.local_controller = label(experiment.local_controllers, combination.local_controller);
  record.pedestrian_model = label(experiment.pedestrian_models, combination.pedestrian_model);
  record.repetition = id.repetition;
  record.seed = trial_seed(experiment, trial);
  record.task_is_drawn = is_drawn(variant);
  return record;
}

Job OpenTrial::begin() {
  begun_ = false;
  Job job;
  job.trial = record_.id;
  return job;
}

bool OpenTrial::take(const nlohmann::json& message) {
  const auto type = message.at("type").get<std::string>();
  if (type == "began") {
    begun_ = true;
  } else if (type == "metric") {
    auto piece = message.get<MetricResult>();
    std::move(piece.values.begin(), piece.values.end(), std::back_inserter(record_.values));
    std::move(piece.events.begin(), piece.events.end(), std::back_inserter(record_.events));
  } else if (type == "fault") {
    add_fault(message.get<FaultRecord>());
  } else if (type == "done") {
    const auto done = message.get<TrialDone>();
    record_.outcome = done.outcome;
    add_timing(done.timing);
    record_.sim_time_s = done.sim_time_s;
    record_.task = done.task;
    return true;
  }
  return false;
}

void OpenTrial::add_fault(FaultRecord fault) {
  if (fault.kind == fault_kind::hang)
    add_timing({{fault.plugin, fault.function + "() was stopped: it did not return"}});
  record_.faults.push_back(std::move(fault));
}

void OpenTrial::add_timing(const std::vector<TimingReason>& reasons) {
  for (const TimingReason& reason : reasons)
    if (std::find(record_.timing.begin(), record_.timing.end(), reason) == record_.timing.end())
      record_.timing.push_back(reason);
  record_.repeatable = record_.timing.empty();
}

void OpenTrial::end_by(FaultRecord fault) {
  restart();
  record_.outcome = outcome_of(fault.kind);
  add_fault(std::move(fault));
}

void OpenTrial::end_without_plan(StoredPlan stored) {
  record_.outcome = outcome_of(stored.fault->kind);
  record_.faults = {std::move(*stored.fault)};
  record_.task = std::move(stored.task);
  add_timing(stored.timing);
}

void OpenTrial::restart() {
  record_.values.clear();
  record_.events.clear();
  record_.faults.clear();
}

}  // namespace dmrp::host
