// SPDX-License-Identifier: MIT
#include "host/export/layout_tables.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dmrp::host {
namespace {

SummaryTableColumn parse_column(const nlohmann::json& json) {
  SummaryTableColumn column;
  column.metric = json.at("metric");
  column.header = json.value("header", column.metric);
  column.decimals = json.value("decimals", 2u);
  column.spread = json.value("spread", "");
  column.median = json.value("median", false);
  return column;
}

bool several_models(std::span<const TrialRecord> trials) {
  return std::any_of(trials.begin(), trials.end(), [&](const TrialRecord& trial) {
    return trial.robots > 0 && trial.pedestrian_model != trials.back().pedestrian_model;
  });
}

}  // namespace

std::vector<TableSpec> layout_tables(const std::string& report_layout_json, std::span<const TrialRecord> trials) {
  std::vector<TableSpec> specs;
  const nlohmann::json layout = nlohmann::json::parse(report_layout_json);
  for (const nlohmann::json& table : layout.value("tables", nlohmann::json::array())) {
    TableSpec spec{table.at("id"), table.at("title"), {}, {}, {}};
    std::vector<Label>& places = table.contains("across") ? spec.columns : spec.rows;
    places = {Label::scenario, Label::robots};
    for (const std::string row : table.at("rows"))
      if (const auto label = label_named(row); label && (label != Label::pedestrian_model || several_models(trials)))
        spec.rows.push_back(*label);
    for (const nlohmann::json& column : table.at("columns")) spec.metrics.push_back(parse_column(column));
    specs.push_back(std::move(spec));
  }
  return specs;
}

SummaryTableColumn column_of(const std::string& report_layout_json, const std::string& metric) {
  const nlohmann::json layout = nlohmann::json::parse(report_layout_json);
  for (const nlohmann::json& table : layout.value("tables", nlohmann::json::array()))
    for (const nlohmann::json& column : table.at("columns"))
      if (column.at("metric") == metric) return parse_column(column);
  SummaryTableColumn column;
  column.metric = metric;
  column.header = metric;
  std::replace(column.header.begin(), column.header.end(), '_', ' ');
  return column;
}

}  // namespace dmrp::host
