// SPDX-License-Identifier: MIT
#include "host/results/summary_layout.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace dmrp::host {
namespace {

constexpr std::uint32_t most_decimals = 9;
constexpr std::uint32_t decimals_of_added = 3;

SummaryTableColumn parse_column(const nlohmann::json& json) {
  SummaryTableColumn column;
  for (const auto& [key, value] : json.items()) {
    if (key == "metric")
      column.metric = value.get<std::string>();
    else if (key == "header")
      column.header = value.get<std::string>();
    else if (key == "decimals")
      column.decimals = value.get<std::uint32_t>();
    else if (key == "spread")
      column.spread = value.get<std::string>();
    else if (key == "median")
      column.median = value.get<bool>();
    else if (key == "legend")
      column.legend = value.get<std::string>();
    else
      throw std::runtime_error("unknown key '" + key + "' of a column");
  }
  if (column.metric.empty()) throw std::runtime_error("a column without 'metric'");
  if (column.header.empty()) column.header = column.metric;
  if (column.decimals > most_decimals) throw std::runtime_error("'decimals' must be 0 to 9");
  return column;
}

AnswerMetrics parse_answer(const nlohmann::json& json) {
  AnswerMetrics answer;
  for (const auto& [key, value] : json.items()) {
    if (key == "shares")
      answer.shares = value.get<std::vector<std::string>>();
    else if (key == "safe")
      answer.safe = value.get<std::string>();
    else if (key == "names")
      answer.names = value.get<std::map<std::string, std::string>>();
    else if (key == "siblings")
      answer.siblings = value.get<std::vector<std::string>>();
    else if (key == "people_progress")
      answer.people_progress = value.get<std::string>();
    else if (key == "people_speed")
      answer.people_speed = value.get<std::string>();
    else if (key == "time")
      answer.time = value.get<std::string>();
    else if (key == "way_length")
      answer.way_length = value.get<std::string>();
    else
      throw std::runtime_error("unknown key '" + key + "' of 'answer'");
  }
  if (answer.safe.empty() && !answer.shares.empty()) answer.safe = answer.shares.front();
  return answer;
}

SummaryLayout parse_layout(std::string_view text) {
  const auto json = nlohmann::json::parse(text);
  if (!json.is_object()) throw std::runtime_error("not a table of keys");
  SummaryLayout layout;
  for (const auto& [key, value] : json.items()) {
    if (key == "columns")
      for (const auto& column : value) layout.columns.push_back(parse_column(column));
    else if (key == "arrived")
      layout.arrived = value.get<std::string>();
    else if (key == "contacts")
      layout.contacts = value.get<std::string>();
    else if (key == "at_fault")
      layout.at_fault = value.get<std::string>();
    else if (key == "after_standstill")
      layout.after_standstill = value.get<std::string>();
    else if (key == "counts_failures")
      layout.counts_failures = value.get<std::vector<std::string>>();
    else if (key == "of_plans")
      layout.of_plans = value.get<std::vector<std::string>>();
    else if (key == "answer")
      layout.answer = parse_answer(value);
    else
      throw std::runtime_error("unknown key '" + key + "'");
  }
  return layout;
}

}  // namespace

SummaryLayout with_added_columns(SummaryLayout layout, std::span<const MetricColumn> metrics) {
  const std::vector<SummaryTableColumn> own = layout.columns;
  for (const MetricColumn& metric : metrics) {
    const bool has = std::any_of(own.begin(), own.end(),
                                 [&](const SummaryTableColumn& column) { return column.metric == metric.name; });
    if (!metric.added || has) continue;
    SummaryTableColumn column;
    column.metric = column.header = metric.name;
    column.decimals = decimals_of_added;
    column.legend = metric.description;
    if (metric.direction == DMRP_DIRECTION_LOWER) column.legend += ", lower is better";
    if (metric.direction == DMRP_DIRECTION_HIGHER) column.legend += ", higher is better";
    layout.columns.push_back(std::move(column));
  }
  return layout;
}

SummaryLayout parse_summary_layout(std::string_view json, const std::string& name) {
  try {
    return parse_layout(json);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

SummaryLayout read_summary_layout(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse_summary_layout(text, path.string());
}

}  // namespace dmrp::host
