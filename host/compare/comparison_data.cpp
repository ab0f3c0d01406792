// SPDX-License-Identifier: MIT
#include "host/compare/comparison_data.hpp"

#include <nlohmann/json.hpp>

#include "host/report/data/report_json.hpp"

namespace dmrp::host {
namespace {

using Json = nlohmann::ordered_json;

Json run_json(const ComparedRun& compared) {
  const Manifest& manifest = compared.run.manifest;
  return {{"path", compared.path},
          {"name", manifest.experiment.name},
          {"version", manifest.dmrp_version},
          {"commit", manifest.commit},
          {"started", manifest.started_at},
          {"repetitions", manifest.experiment.repetitions}};
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json libraries_json(const std::vector<ComparedLibrary>& libraries) {
  Json json = Json::array();
  for (const ComparedLibrary& one : libraries)
    json.push_back({{"name", one.name}, {"before", text_or_null(one.before)}, {"after", text_or_null(one.after)}});
  return json;
}

Json differences_json(const std::vector<MetricComparison>& metrics) {
  Json json = Json::array();
  for (const MetricComparison& one : metrics) {
    const core::MeanOfTasks& over_tasks = one.difference.over_tasks;
    Json difference = {{"metric", one.metric}, {"pairs", one.pairs}, {"n", over_tasks.n}};
    if (one.pairs > 0)
      difference.update({{"before", one.before},
                         {"after", one.after},
                         {"difference", over_tasks.mean},
                         {"low", over_tasks.interval.low},
                         {"high", over_tasks.interval.high},
                         {"equal", one.difference.equal},
                         {"p", one.difference.p},
                         {"p_holm", one.difference.p_holm}});
    json.push_back(std::move(difference));
  }
  return json;
}

Json other_json(const ComparedRuns::Other& other) {
  const RunComparison& comparison = other.comparison;
  Json json = run_json(other.run);
  json["pairs"] = comparison.pairs;
  json["only_before"] = comparison.only_before;
  json["only_after"] = comparison.only_after;
  json["changes"] = comparison.changes;
  json["libraries"] = libraries_json(comparison.libraries);
  json["differences"] = differences_json(comparison.metrics);
  json["combinations"] = Json::array();
  json["of_combinations"] = Json::array();
  for (const CombinationComparison& one : comparison.combinations) {
    json["combinations"].push_back(labels_json(one.combination));
    json["of_combinations"].push_back(differences_json(one.metrics));
  }
  return json;
}

}  // namespace

std::string comparison_data_json(const ComparedRuns& runs, const ReportLayouts& layouts) {
  Json json;
  json["format"] = 1;
  json["before"] = run_json(runs.before);
  json["scenarios"] = scenarios_json(runs.before.run.manifest.experiment.scenarios);
  json["metrics"] = metrics_json(runs.before.run.metrics);
  json["layouts"] = {{"summary", Json::parse(layouts.summary_json)}, {"report", Json::parse(layouts.report.json)}};
  json["runs"] = Json::array();
  for (const ComparedRuns::Other& other : runs.others) json["runs"].push_back(other_json(other));
  // texts of plugins and paths need not be UTF-8: invalid bytes are replaced
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace dmrp::host
