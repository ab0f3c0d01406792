// SPDX-License-Identifier: MIT
// open_trial.hpp: a trial that is not over: what its worker has said so far, and how often it was begun.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"
#include "host/workers/messages.hpp"

namespace dmrp::host {

// The record of a trial that has not run: its place in the experiment.
TrialRecord blank_record(const Experiment& experiment, std::uint64_t trial);

class OpenTrial {
 public:
  OpenTrial(const Experiment& experiment, TrialRecord blank) : experiment_(&experiment), record_(std::move(blank)) {}

  // Begins an attempt: the job for a worker, without its files.
  Job begin(std::uint64_t stamp);

  enum class State { running, done, ended_by_fault };  // ended_by_fault: the worker ends too

  // Takes a message of the worker. A value is believed if its metric runs and has declared it. Throws
  // UnbelievableMessage, and nlohmann::json::exception.
  State take(const nlohmann::json& message);

  // Throws UnbelievableMessage if the message is not from the worker of this attempt.
  void check_sender(const nlohmann::json& message) const;

  // The worker has begun this attempt.
  bool has_begun() const { return begun_; }

  // A fault that ended the worker. If a metric was running, the trial goes on without this metric, in a next attempt;
  // otherwise the trial is over.
  State end_attempt(FaultRecord fault);

  // Ends before it begins, by the fault of the planner in another trial of the same plan.
  void end_without_plan(StoredPlan stored);

  // Forgets this attempt, except for faults of metrics.
  void restart();

  const TrialRecord& record() const { return record_; }
  TrialRecord take_record() { return std::move(record_); }

  std::int64_t started_ns = 0;  // of this attempt
  bool worker_failed = false;   // an attempt ended because its worker could not continue
  int killed = 0;               // so many attempts were killed from outside

 private:
  void take_metric(const nlohmann::json& message);
  template <class T>
  void take_all(std::vector<T>& piece, std::vector<T>& given);
  void forget_given();
  State take_fault(const nlohmann::json& message);
  void take_done(const nlohmann::json& message);
  void add_timing(const std::vector<TimingReason>& reasons);
  void skip(std::uint32_t metric);
  bool is_skipped(std::uint32_t metric) const;

  const Experiment* experiment_;
  TrialRecord record_;
  std::uint64_t stamp_ = 0;
  bool begun_ = false;
  bool failed_ = false;                     // a fault of a plugin that is no metric ended the trial
  std::uint32_t next_metric_ = 0;           // metrics are measured in order
  std::optional<std::uint32_t> measuring_;  // the metric that runs
  MetricResult given_;                      // what it has given so far
  std::size_t given_bytes_ = 0;
  std::vector<std::uint32_t> skip_metrics_;    // measured in this attempt, or ended in a fault
  std::vector<std::uint32_t> faulty_metrics_;  // that ended in a fault
};

// Whether a metric may have given this result in a trial with so many robots: declared values, each once. Otherwise why
// not.
std::optional<std::string> breach_of(const MetricResult& result, const PluginInfo& metric, std::uint32_t robots);

}  // namespace dmrp::host
