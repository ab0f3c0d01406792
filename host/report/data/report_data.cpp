// SPDX-License-Identifier: MIT
#include "host/report/data/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/statistics/mean_of_tasks.hpp"
#include "host/files/read_file.hpp"
#include "host/findings/summary.hpp"
#include "host/ranking/bounds.hpp"
#include "host/ranking/graded_series.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_json.hpp"
#include "host/report/data/report_statistics.hpp"
#include "host/results/arrivals_by_type.hpp"

namespace dmrp::host {

namespace {

struct CurvePoint {
  double coordinate;
  core::MeanOfTasks over_tasks;
  std::uint32_t defined;  // trials
};

// A metric with values at several coordinates (thresholds), over the trials of a combination.
struct MetricCurve {
  std::size_t metric;              // index
  std::size_t combination;         // index
  std::vector<CurvePoint> points;  // by coordinate
};

using Values = std::map<std::size_t, double>;  // by trial, without undefined ones

CurvePoint summarise_point(const MetricColumn& metric, double coordinate, const Values& values,
                           const Observations& observations) {
  std::vector<std::size_t> trials;
  for (const auto& [trial, value] : values) trials.push_back(trial);
  const auto value_of = [&](std::size_t trial) { return std::optional(values.at(trial)); };
  CurvePoint point = {
      coordinate, core::mean_of_tasks(observation_means(observations, trials, value_of), {}, observations.resampling),
      static_cast<std::uint32_t>(values.size())};
  point.over_tasks.interval = within(metric, point.over_tasks.interval);
  return point;
}

// The system's curves, by metric, then combination. Omits the metric for delays of people and curves without a
// defined point.
std::vector<MetricCurve> metric_curves(const ReportFrame& frame, const std::string& people_progress) {
  std::map<std::string_view, std::size_t> metric_of;
  for (std::size_t i = 0; i < frame.metrics.size(); ++i)
    if (frame.metrics[i].name != people_progress) metric_of.emplace(frame.metrics[i].name, i);

  std::map<std::pair<std::size_t, std::size_t>, std::map<double, Values>> collected;  // (metric, combination)
  for (std::size_t i = 0; i < frame.trials.size(); ++i)
    for (const MetricValue& value : frame.trials[i].values) {
      if (value.subject_kind != DMRP_SUBJECT_SYSTEM || !value.coordinate) continue;
      const auto metric = metric_of.find(value.metric);
      if (metric == metric_of.end()) continue;
      Values& values = collected[{metric->second, frame.combination_of[i]}][*value.coordinate];
      if (value.value) values[i] = *value.value;
    }

  std::vector<MetricCurve> curves;
  for (const auto& [key, points] : collected) {
    MetricCurve curve{key.first, key.second, {}};
    for (const auto& [coordinate, values] : points)
      curve.points.push_back(summarise_point(frame.metrics[key.first], coordinate, values, frame.observations));
    const bool defined =
        std::any_of(curve.points.begin(), curve.points.end(), [](const auto& point) { return point.defined > 0; });
    if (defined) curves.push_back(std::move(curve));
  }
  return curves;
}

// With seven significant digits: a page shows fewer, and long numbers were a third of it.
double for_display(double value) {
  constexpr int digits = 7;
  if (value == 0.0 || !std::isfinite(value)) return value;
  const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (decimals < 0 || decimals > 15) return value;
  const double power = std::pow(10.0, decimals);
  return std::round(value * power) / power;
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(for_display(*value)) : Json();
}

std::uint64_t finished(std::span<const TrialRecord> trials) {
  return static_cast<std::uint64_t>(std::count_if(
      trials.begin(), trials.end(), [](const auto& trial) { return trial.outcome != trial_outcome::skipped; }));
}

Json run_json(const ReportRun& run) {
  const ExperimentFacts& facts = run.manifest.experiment;
  return {{"name", facts.name},
          {"seed", std::to_string(facts.seed)},
          {"repetitions", facts.repetitions},
          {"trials_planned", std::max<std::uint64_t>(facts.trials_planned, run.trials.size())},
          {"trials_finished", finished(run.trials)},
          {"version", run.manifest.dmrp_version},
          {"started", run.manifest.started_at},
          {"command_line", run.manifest.command_line},
          {"effective_toml", run.effective_toml},
          {"conditions", run.conditions},
          {"manifest", Json::parse(run.manifest_json)}};
}

Json graded_json(const ReportRun& run, const SummaryLayout& layout) {
  Json json = Json::array();
  for (const GradedSeries& series : graded_series(layout, run.manifest.experiment.scenarios, run.trials)) {
    Json results = Json::array();
    for (const GradedResult& result : series.results)
      results.push_back({{"global_planner", result.global_planner},
                         {"local_controller", result.local_controller},
                         {"pedestrian_model", result.pedestrian_model},
                         {"threshold", threshold_words(series, result.estimate)},
                         {"means", result.means}});
    json.push_back({{"name", series.name},
                    {"title", series.title},
                    {"quantity", series.quantity},
                    {"unit", series.unit},
                    {"levels", series.levels},
                    {"scenarios", series.scenarios},
                    {"results", std::move(results)}});
  }
  return json;
}

// Of the combinations whose robots are of several types.
Json arrivals_by_type_json(const ReportFrame& frame, const ExperimentFacts& facts, const std::string& arrived) {
  std::vector<std::vector<TypeArrivals>> counts(frame.combinations.size());
  for (std::size_t i = 0; i < frame.trials.size(); ++i)
    count_arrivals(arrived, facts.scenarios, frame.trials[i], counts[frame.combination_of[i]]);
  Json json = Json::array();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].size() < 2) continue;
    Json types = Json::array();
    for (const TypeArrivals& one : counts[i])
      types.push_back({{"type", one.type}, {"robots", one.robots}, {"arrived", one.arrived}});
    json.push_back({{"combination", labels_json(frame.combinations[i])}, {"types", std::move(types)}});
  }
  return json;
}

Json combinations_json(const ReportFrame& frame) {
  Json json = Json::array();
  for (const CombinationLabels& labels : frame.combinations) json.push_back(labels_json(labels));
  return json;
}

Json trials_json(const ReportFrame& frame) {
  Json json;
  for (const char* column :
       {"id", "combination", "repetition", "seed", "outcome", "repeatable", "sim_time_s", "wall_time_s"})
    json[column] = Json::array();
  for (std::size_t i = 0; i < frame.trials.size(); ++i) {
    const TrialRecord& trial = frame.trials[i];
    json["id"].push_back(trial.id);
    json["combination"].push_back(frame.combination_of[i]);
    json["repetition"].push_back(trial.repetition);
    json["seed"].push_back(std::to_string(trial.seed));
    json["outcome"].push_back(trial.outcome);
    json["repeatable"].push_back(trial.repeatable);
    json["sim_time_s"].push_back(trial.sim_time_s);
    json["wall_time_s"].push_back(trial.wall_time_s);
  }
  return json;
}

Json values_json(const ReportFrame& frame, const std::set<std::size_t>& curves) {
  Json json = Json::object();
  for (std::size_t metric = 0; metric < frame.metrics.size(); ++metric) {
    if (curves.count(metric) > 0) continue;
    Json column = Json::array();
    for (const auto& values : frame.values) column.push_back(number_or_null(values[metric]));
    json[frame.metrics[metric].name] = std::move(column);
  }
  return json;
}

Json summary_json(std::uint32_t trials, const MetricSummary& summary) {
  return {{"trials", trials},
          {"n", summary.n},
          {"defined", summary.defined},
          {"mean", summary.mean},
          {"sd", summary.sd},
          {"median", summary.median},
          {"low", summary.interval.low},
          {"high", summary.interval.high},
          {"at_most", summary.at_most},
          {"paper_mean", summary.paper.mean},
          {"paper_count", summary.paper.count},
          {"paper_trimmed_all_nonzero", summary.paper.trimmed_all_nonzero}};
}

// [group][metric]. Groups of skipped trials have no summary.
Json summaries_json(std::span<const CombinationLabels> groups, std::span<const CombinationSummary> summaries,
                    std::size_t metrics) {
  Json json = Json::array();
  for (const CombinationLabels& labels : groups) {
    const auto summary = std::find_if(summaries.begin(), summaries.end(),
                                      [&](const CombinationSummary& other) { return other.combination == labels; });
    Json of_metrics = Json::array();
    for (std::size_t metric = 0; metric < metrics; ++metric)
      of_metrics.push_back(summary == summaries.end() ? Json()
                                                      : summary_json(summary->trials, summary->metrics[metric]));
    json.push_back(std::move(of_metrics));
  }
  return json;
}

// The labels that a plan depends on.
CombinationLabels planner_of(const TrialRecord& trial) {
  return {trial.scenario, trial.robots, trial.global_planner, "", ""};
}

void add_planners(Json& json, const ReportFrame& frame, const MetricKinds& kinds) {
  const auto summaries = summarise(frame.metrics, frame.trials, kinds, planner_of);
  json["planners"] = Json::array();
  std::vector<CombinationLabels> groups;
  for (const CombinationSummary& summary : summaries) {
    if (summary.combination.robots == 0) continue;  // no plans
    const CombinationLabels& labels = groups.emplace_back(summary.combination);
    json["planners"].push_back(
        {{"scenario", labels.scenario}, {"robots", labels.robots}, {"global_planner", labels.global_planner}});
  }
  json["planner_summaries"] = summaries_json(groups, summaries, frame.metrics.size());
}

Json curves_json(const ReportFrame& frame, std::span<const MetricCurve> curves, std::span<const CurveAxis> axes) {
  Json json = Json::array();
  for (const MetricCurve& curve : curves) {
    const std::string& metric = frame.metrics[curve.metric].name;
    const auto axis = std::find_if(axes.begin(), axes.end(), [&](const auto& one) { return one.metric == metric; });
    Json points = Json::array();
    for (const CurvePoint& point : curve.points)
      points.push_back({point.coordinate, point.over_tasks.mean, point.over_tasks.interval.low,
                        point.over_tasks.interval.high, point.defined});
    json.push_back({{"metric", metric},
                    {"combination", curve.combination},
                    {"coordinate_unit", axis == axes.end() ? "" : axis->coordinate_unit},
                    {"points", std::move(points)}});
  }
  return json;
}

Json timing_json(std::span<const TrialRecord> trials) {
  Json json = Json::array();
  for (const TrialRecord& trial : trials)
    for (const TimingReason& reason : trial.timing)
      json.push_back({{"trial", trial.id}, {"plugin", reason.plugin}, {"reason", reason.text}});
  return json;
}

Json faults_json(std::span<const TrialRecord> trials) {
  Json json = Json::array();
  for (const TrialRecord& trial : trials) {
    if (!has_fault(trial)) continue;
    for (const FaultRecord& fault : trial.faults)
      json.push_back({{"trial", trial.id},
                      {"kind", fault.kind},
                      {"plugin", fault.plugin},
                      {"function", fault.function},
                      {"step", fault.step},
                      {"robot", fault.robot < 0 ? Json() : Json(fault.robot)},
                      {"signal", fault.signal == 0 ? Json() : Json(fault.signal)},
                      {"detail", fault.detail},
                      {"rerun", fault.rerun}});
  }
  return json;
}

void add_replays(Json& json, const ReplayIndex& index) {
  json["replays"] = Json::array();
  for (const ReplayEntry& replay : index.replays)
    json["replays"].push_back({{"trial", replay.trial}, {"why", replay.why}, {"element", replay.element}});
  json["replays_left_out"] = Json::array();
  for (const OmittedReplays& omitted : index.omitted)
    json["replays_left_out"].push_back({{"why", omitted.why}, {"trials", omitted.trials}, {"reason", omitted.reason}});
}

// Metrics that have values with a coordinate, for any subject.
std::set<std::size_t> curve_metrics(const ReportFrame& frame) {
  std::set<std::string_view> names;
  for (const TrialRecord& trial : frame.trials)
    for (const MetricValue& value : trial.values)
      if (value.coordinate) names.insert(value.metric);
  std::set<std::size_t> metrics;
  for (std::size_t i = 0; i < frame.metrics.size(); ++i)
    if (names.count(frame.metrics[i].name) > 0) metrics.insert(i);
  return metrics;
}

// A table of these metrics by combination.
Json table_of(const char* id, const char* title, const std::string& note, std::span<const MetricColumn> metrics) {
  Json columns = Json::array();
  for (const MetricColumn& metric : metrics)
    columns.push_back({{"metric", metric.name}, {"header", metric.name}, {"decimals", 3}});
  return {{"id", id},
          {"title", title},
          {"note", note},
          {"rows", {"global_planner", "local_controller", "pedestrian_model"}},
          {"columns", std::move(columns)}};
}

// The places between the experiment's two bounds.
Json places_table(std::span<const MetricColumn> places) {
  std::string note;
  for (const MetricColumn& place : places) note += (note.empty() ? "" : "; ") + place.name + ": " + place.description;
  return table_of("places", "Between two bounds",
                  note + ". A dash: the bounds themselves, and where they do not differ significantly.", places);
}

// The report's layout with a table of the metrics that plugins beside the built-in ones added and that no table has.
Json with_added_table(Json layout, const std::vector<MetricColumn>& metrics) {
  std::set<std::string> shown;
  for (const Json& table : layout["tables"])
    for (const Json& column : table["columns"]) shown.insert(column["metric"].get<std::string>());
  std::vector<MetricColumn> added;
  for (const MetricColumn& metric : metrics)
    if (metric.added && shown.count(metric.name) == 0) added.push_back(metric);
  if (!added.empty())
    layout["tables"].push_back(table_of("added", "Added metrics", "Of plugins that are not built in.", added));
  return layout;
}

}  // namespace

ReportLayouts read_report_layouts(const std::filesystem::path& folder) {
  const std::filesystem::path summary = folder / "summary.json";
  return {read_summary_layout(summary), read_file(summary, summary.string()),
          read_report_layout(folder / "report.json")};
}

std::string report_data_json(const ReportRun& run, const ReportLayouts& layouts, const ReplayIndex& replays) {
  const ReportFrame frame = make_report_frame(run.metrics, run.trials);
  const MetricKinds kinds = kinds_of(layouts.summary);
  std::vector<MetricColumn> metrics = run.metrics;
  std::vector<CombinationSummary> summaries = summarise(run.metrics, run.trials, kinds);
  add_places(bounds_of(run.effective_toml), layouts.summary, run.trials, metrics, summaries);
  Json json;
  json["format"] = 1;
  json["run"] = run_json(run);
  const Met met = met_by_all(run.trials);
  json["met"] = met_words(met);
  json["observation"] = observation_name(met);
  json["scenarios"] = scenarios_json(run.manifest.experiment.scenarios);
  json["metrics"] = metrics_json(metrics);
  json["combinations"] = combinations_json(frame);
  json["trials"] = trials_json(frame);
  json["values"] = values_json(frame, curve_metrics(frame));
  json["summaries"] = summaries_json(frame.combinations, summaries, metrics.size());
  add_planners(json, frame, kinds);
  json["curves"] =
      curves_json(frame, metric_curves(frame, layouts.summary.answer.people_progress), layouts.report.curves);
  add_statistics(json, frame, run.manifest.experiment, layouts);
  json["graded"] = graded_json(run, layouts.summary);
  json["arrivals_by_type"] = arrivals_by_type_json(frame, run.manifest.experiment, layouts.summary.arrived);
  json["timing"] = timing_json(run.trials);
  json["faults"] = faults_json(run.trials);
  json["layouts"] = {{"summary", Json::parse(layouts.summary_json)},
                     {"report", with_added_table(Json::parse(layouts.report.json), run.metrics)}};
  if (metrics.size() > run.metrics.size())
    json["layouts"]["report"]["tables"].push_back(places_table(std::span(metrics).subspan(run.metrics.size())));
  add_replays(json, replays);
  // labels and details need not be UTF-8
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace dmrp::host
