// SPDX-License-Identifier: MIT
// trial_record.hpp: the results of one trial, as in results.sqlite.
#pragma once

#include <dmrp/metric.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/plugins/calls/timing_reason.hpp"
#include "host/process/fault_kind.hpp"
#include "host/toml/swept_value.hpp"

namespace dmrp::host {

// The declaration of a metric's value.
struct MetricColumn {
  std::string name;
  std::string unit;
  std::uint32_t direction = 0;  // DMRP_DIRECTION_*
  bool wall_clock = false;      // differs from run to run
  std::string description;
  bool added = false;  // of a plugin that is not built in: tables show it although no layout names it
  double minimum = -std::numeric_limits<double>::infinity();  // what it can be
  double maximum = std::numeric_limits<double>::infinity();
};

inline constexpr std::array<const char*, 3> subject_kind_names{"system", "robot", "pedestrian"};  // by DMRP_SUBJECT_*

struct MetricValue {
  std::string metric;                    // MetricColumn::name
  std::uint32_t subject_kind = 0;        // DMRP_SUBJECT_*
  std::optional<std::uint64_t> subject;  // none for the system
  std::optional<double> coordinate;      // of a curve
  std::optional<double> value;           // none if undefined
};

struct MetricEvent {
  std::string metric;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::vector<std::uint32_t> robots;
  std::vector<std::uint64_t> people;
  std::string text;
  std::uint32_t severity = DMRP_SEVERITY_INFO;
  std::optional<dmrp_vec2> place;
};

// The result of one metric for a trial.
struct MetricResult {
  std::uint32_t index = 0;  // of Experiment::metrics
  std::vector<MetricValue> values;
  std::vector<MetricEvent> events;
};

struct FaultRecord {
  std::string kind;  // fault_kind
  std::string plugin;
  std::string function;
  std::int64_t step = 0;
  std::int32_t robot = -1;  // -1: none
  std::int32_t signal = 0;  // 0: none
  std::string detail;
  std::string rerun;  // the command that repeats this trial alone
};

// Values of TrialRecord::outcome.
namespace trial_outcome {
inline constexpr const char* succeeded = "succeeded";  // all robots arrived
inline constexpr const char* failed = "failed";
inline constexpr const char* fault = "fault";
inline constexpr const char* skipped = "skipped";
inline constexpr const char* unsupported = "unsupported";  // a plugin says that the trial is not for it
}  // namespace trial_outcome

// Of a trial that a fault of this kind ended.
inline const char* outcome_of(std::string_view fault) {
  return fault == fault_kind::unsupported ? trial_outcome::unsupported : trial_outcome::fault;
}

struct TrialRecord {
  std::uint64_t id = 0;
  std::string scenario;
  std::uint32_t robots = 0;
  std::string global_planner;
  std::string local_controller;
  std::string pedestrian_model;  // empty without pedestrians
  std::uint32_t repetition = 0;
  std::uint64_t seed = 0;
  std::string outcome;
  bool repeatable = true;
  std::vector<TimingReason> timing{};  // why it is not repeatable
  double sim_time_s = 0.0;
  double wall_time_s = 0.0;
  std::string task{};          // a hash of the robots' starts and goals; empty after a fault
  bool task_is_drawn = false;  // for this trial; otherwise it is listed, for all repetitions
  std::string plan_sha256{};   // of the first plan's paths; empty if there is none
  std::string trace_sha256{};  // of the recorded file; likewise
  std::vector<SweptValue> swept{};
  std::vector<MetricValue> values;
  std::vector<MetricEvent> events;
  std::vector<FaultRecord> faults;
};

// How the place of a trial in its experiment differs from what its row says, in one line; "" if it does not.
std::string misplacement(const TrialRecord& row, const TrialRecord& place);

// SHA-256, hexadecimal, of what the row says, with its values, but without events, faults and reasons of timing. Equal for a
// record and the same one read from a database.
std::string row_sha256(const TrialRecord& row);

// The columns of all swept values of trials or summaries, in order of appearance.
template <class Swept>
std::vector<std::string> swept_columns(std::span<const Swept> all) {
  std::vector<std::string> columns;
  for (const Swept& one : all)
    for (const SweptValue& swept : one.swept)
      if (std::find(columns.begin(), columns.end(), column_of(swept)) == columns.end())
        columns.push_back(column_of(swept));
  return columns;
}

// "" if this column is none of them.
inline std::string swept_value(std::span<const SweptValue> swept, const std::string& column) {
  for (const SweptValue& one : swept)
    if (column_of(one) == column) return one.value;
  return "";
}

// The system's value of a metric without a coordinate; none if undefined or not measured.
inline std::optional<double> system_value(const TrialRecord& trial, std::string_view metric) {
  for (const MetricValue& value : trial.values)
    if (value.subject_kind == DMRP_SUBJECT_SYSTEM && !value.coordinate && value.metric == metric) return value.value;
  return std::nullopt;
}

// Whether its values count: it was run, and was for all its plugins.
inline bool has_result(const TrialRecord& trial) {
  return trial.outcome != trial_outcome::skipped && trial.outcome != trial_outcome::unsupported;
}

inline bool has_fault(const TrialRecord& trial) {
  return !trial.faults.empty() && trial.outcome != trial_outcome::unsupported;
}

}  // namespace dmrp::host
