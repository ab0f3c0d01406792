// SPDX-License-Identifier: MIT
#include "host/report/data/report_statistics.hpp"

#include <nlohmann/json.hpp>
#include <span>

#include "host/ranking/answer_text.hpp"
#include "host/ranking/best_marks.hpp"
#include "host/ranking/failure_causes.hpp"
#include "host/report/data/report_comparisons.hpp"
#include "host/report/data/report_completion.hpp"
#include "host/report/data/report_correlations.hpp"
#include "host/report/data/report_delay.hpp"
#include "host/report/data/report_json.hpp"

namespace dmrp::host {
namespace {

struct Choice {
  Varied varied;
  const char* name;
  std::string CombinationLabels::*label;
};

constexpr Choice choices[] = {{Varied::global_planner, "global_planner", &CombinationLabels::global_planner},
                              {Varied::local_controller, "local_controller", &CombinationLabels::local_controller},
                              {Varied::pedestrian_model, "pedestrian_model", &CombinationLabels::pedestrian_model}};

Json comparison_json(const ReportFrame& frame, const PairedComparison& one) {
  const CombinationLabels& a = frame.combinations[one.a];
  const CombinationLabels& b = frame.combinations[one.b];
  Json json = {{"metric", frame.metrics[one.metric].name}, {"scenario", a.scenario}, {"robots", a.robots}};
  Json given = Json::object();
  for (const Choice& choice : choices)
    if (choice.varied == one.varied) {
      json["varied"] = choice.name;
      json["a"] = a.*choice.label;
      json["b"] = b.*choice.label;
    } else {
      given[choice.name] = a.*choice.label;
    }
  json["given"] = std::move(given);
  json["combinations"] = {one.a, one.b};
  const core::MeanOfTasks& over_tasks = one.difference.over_tasks;
  json["pairs"] = one.pairs;
  json["tasks"] = over_tasks.n;
  json["ties"] = one.ties;
  json["median_difference"] = one.shift.estimate;
  json["low"] = one.shift.interval.low;
  json["high"] = one.shift.interval.high;
  json["mean_difference"] = over_tasks.mean;
  json["mean_low"] = over_tasks.interval.low;
  json["mean_high"] = over_tasks.interval.high;
  json["effect"] = one.effect;
  json["test"] = one.test == PairedTest::signed_rank ? "signed_rank" : "sign_flip";
  json["exact"] = one.difference.exact;
  json["equal"] = one.difference.equal;
  json["p"] = one.difference.p;
  json["p_holm"] = one.difference.p_holm;
  return json;
}

Json correlation_json(const ReportFrame& frame, const StratumCorrelation& one) {
  return {{"scenario", one.stratum.scenario},
          {"robots", one.stratum.robots},
          {"global_planner", one.stratum.global_planner},
          {"pedestrian_model", one.stratum.pedestrian_model},
          {"x", frame.metrics[one.x].name},
          {"y", frame.metrics[one.y].name},
          {"n", one.correlation.n},
          {"rho", one.correlation.rho},
          {"low", one.correlation.interval.low},
          {"high", one.correlation.interval.high},
          {"p", one.correlation.p},
          {"ties_share", one.correlation.ties_share}};
}

Json completion_json(const ArrivalTimes& one) {
  Json steps = Json::array();
  for (const core::SurvivalStep& step : one.not_arrived) steps.push_back({step.time, 1.0 - step.share});
  return {{"combination", one.combination},
          {"robots", one.robots},
          {"horizon_s", one.horizon_s},
          {"restricted_mean_s", one.restricted_mean_s.mean},
          {"low", one.restricted_mean_s.interval.low},
          {"high", one.restricted_mean_s.interval.high},
          {"arrived_share", one.arrived_share},
          {"steps", std::move(steps)}};
}

Json delay_json(const PedestrianDelay& one) {
  return {{"combination", one.combination},     {"pairs", one.pairs},
          {"tasks", one.over_tasks.n},          {"mean_s", one.over_tasks.mean},
          {"low", one.over_tasks.interval.low}, {"high", one.over_tasks.interval.high}};
}

Json ranked_json(const Answer& answer, const RankedCombination& one) {
  static constexpr const char* standings[] = {"first", "may_be_best", "worse"};  // by Standing
  Json json = {{"global_planner", one.global_planner},
               {"local_controller", one.local_controller},
               {"trials", one.trials},
               {"means", one.means},
               {"standing", standings[static_cast<std::size_t>(one.standing)]},
               {"decided", one.decided ? Json(*one.decided) : Json()},
               {"words", one.decided ? Json(difference_words(answer, one, *one.decided)) : Json()},
               {"pareto", one.pareto}};
  json["intervals"] = Json::array();
  for (const core::Interval& interval : one.intervals) json["intervals"].push_back({interval.low, interval.high});
  json["against"] = Json::array();
  for (const PairedDifference& against : one.against)
    json["against"].push_back({{"tasks", against.over_tasks.n},
                               {"mean", against.over_tasks.mean},
                               {"low", against.over_tasks.interval.low},
                               {"high", against.over_tasks.interval.high},
                               {"equal", against.equal}});
  return json;
}

Json answer_json(const Answer& answer, std::span<const CombinationFailures> failures) {
  Json json = {{"heading", answer_heading(answer)},
               {"tasks", answer.tasks},
               {"worlds", answer.worlds},
               {"lines", answer_lines(answer, failures)}};
  json["cells"] = Json::array();
  for (const CombinationLabels& cell : answer.cells) json["cells"].push_back(labels_json(cell));
  json["criteria"] = Json::array();
  for (const Criterion& criterion : answer.criteria)
    json["criteria"].push_back({{"name", criterion.name}, {"unit", criterion.unit()}});
  json["ranking"] = Json::array();
  for (const RankedCombination& one : answer.ranking) json["ranking"].push_back(ranked_json(answer, one));
  return json;
}

Json cause_json(const FailureCause& cause) {
  return {{"cause", cause.cause}, {"robots", cause.robots}, {"roots", cause.roots}, {"trials", cause.trials}};
}

Json failures_json(const CombinationFailures& failures) {
  Json json = {{"combination", labels_json(failures.combination)}, {"robots", failures.robots}};
  json["causes"] = Json::array();
  for (const FailureCause& cause : failures.causes) json["causes"].push_back(cause_json(cause));
  json["contact"] = cause_json(failures.contact);
  return json;
}

}  // namespace

void add_statistics(Json& json, const ReportFrame& frame, const ExperimentFacts& facts, const ReportLayouts& layouts) {
  const ReportLayout& report = layouts.report;
  json["comparisons"] = Json::array();
  for (const auto& one : paired_comparisons(frame, facts, report, layouts.summary.counts_failures))
    json["comparisons"].push_back(comparison_json(frame, one));
  const std::vector<CombinationFailures> failures = failure_causes(layouts.summary, frame.trials);
  json["answers"] = Json::array();
  for (const Answer& one : answers(layouts.summary, frame.metrics, frame.trials))
    json["answers"].push_back(answer_json(one, failures));
  json["best"] = Json::array();
  for (const Contestants contestants : {Contestants::planners_and_controllers, Contestants::planners})
    for (const BestMark& mark : best_marks(layouts.summary, frame.metrics, frame.trials, contestants)) {
      Json& json_mark = json["best"].emplace_back(labels_json(mark.labels));
      json_mark["metric"] = mark.metric;
    }
  json["failures_line"] = failures_line(failures);
  json["standstills_line"] = standstills_line(layouts.summary, frame.trials);
  json["failures"] = Json::array();
  for (const CombinationFailures& one : failures) json["failures"].push_back(failures_json(one));
  json["correlations"] = Json::array();
  for (const auto& one : stratum_correlations(frame, report.diagnosis))
    json["correlations"].push_back(correlation_json(frame, one));
  json["completion"] = Json::array();
  for (const auto& one : arrival_times(frame, facts, report)) json["completion"].push_back(completion_json(one));
  json["pedestrian_delay"] = Json::array();
  for (const auto& one : pedestrian_delays(frame, layouts.summary)) json["pedestrian_delay"].push_back(delay_json(one));
}

}  // namespace dmrp::host
