// SPDX-License-Identifier: MIT
// summary_layout.hpp: the metrics in the table at the end of a run, from a data file, so that the code names no plugin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct SummaryTableColumn {
  std::string metric;  // name of a value; omits columns of metrics that were not measured
  std::string header;  // the unit is appended
  std::uint32_t decimals = 2;
  std::string spread;   // metric shown as "±0.17" after the value; empty for none
  bool median = false;  // of the trials, instead of the mean: for times of the machine, which have outliers
  std::string legend;   // what the header stands for, {metric} for values of another one; empty: nothing to explain
};

// The metrics by which combinations are ordered (host/ranking/answer.hpp).
struct AnswerMetrics {
  std::vector<std::string> shares;  // of robots, the most important first; higher is better
  std::string safe;  // the share that is 1 for a robot that arrived without a fault, else 0; by default the first
  std::vector<std::string> siblings;         // of `safe`, stricter or milder; orders that one turns round are named
  std::map<std::string, std::string> names;  // of shares, for readers; by default with spaces for underscores
  std::string people_progress;               // curve over seconds: mean distance gained by a person, m
  std::string people_speed;  // their mean desired speed, m/s: with the curve, the delay that robots cause
  std::string time;          // of a robot's arrival; lower is better
  std::string way_length;    // of a robot's shortest way, by which its time is divided
};

struct SummaryLayout {
  std::vector<SummaryTableColumn> columns;
  std::string arrived;   // metric that is 1 for each robot that completed its task; empty: not in the closing line
  std::string contacts;  // metric whose system value is the number of contacts; likewise
  std::string at_fault;  // metric of each robot's contacts by its own fault; empty: causes do not say
  std::string after_standstill;  // metric of each robot at a standstill that ran on: 1 if it arrived; likewise

  // Metrics that count failures: a trial that ended in a fault has the value 0, and the paper's rule includes failed
  // trials.
  std::vector<std::string> counts_failures;

  // Metrics of plans, which do not change where a robot fails on its way. The first is defined where there is a plan.
  std::vector<std::string> of_plans;

  AnswerMetrics answer;
};

// The layout with a column for each added metric (MetricColumn::added) that it does not have.
SummaryLayout with_added_columns(SummaryLayout layout, std::span<const MetricColumn> metrics);

// `name`: the file's name for error messages. Throws std::runtime_error.
SummaryLayout parse_summary_layout(std::string_view json, const std::string& name);
SummaryLayout read_summary_layout(const std::filesystem::path& path);

}  // namespace dmrp::host
