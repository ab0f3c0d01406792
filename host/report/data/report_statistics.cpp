// SPDX-License-Identifier: MIT
#include "host/report/data/report_statistics.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/statistics/kaplan_meier.hpp"
#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "host/ranking/answer_text.hpp"
#include "host/ranking/best_marks.hpp"
#include "host/ranking/failure_causes.hpp"
#include "host/ranking/measures.hpp"
#include "host/report/data/report_comparisons.hpp"
#include "host/report/data/report_json.hpp"
#include "host/report/data/report_layout.hpp"
#include "host/report/data/report_values.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

namespace {

// A rank correlation of two metrics, within one scenario, planner and pedestrian model, and within controllers, because
// pooling can cause Simpson's paradox.
struct StratumCorrelation {
  CombinationLabels stratum;  // without a controller: includes the trials of all controllers
  std::size_t x;              // metrics
  std::size_t y;
  core::RankCorrelation correlation;  // over the tasks in which both are defined, within controllers
};

struct Stratum {
  CombinationLabels labels;
  std::vector<std::size_t> trials;
};

// The arrival times of the robots of all trials of a combination, including robots that never arrive. A robot that has
// not arrived at the end of its trial (time limit, deadlock or fault) is censored at the time limit, not at the end: a
// deadlock does not mean that it would have arrived soon.
struct ArrivalTimes {
  std::size_t combination;
  std::uint32_t robots;
  double horizon_s;  // the time limit
  core::MeanOfTasks restricted_mean_s;
  double arrived_share;
  std::vector<core::SurvivalStep> not_arrived;  // share of robots that have not arrived
};

// The delay of pedestrians by robots, from pairs of trials with and without robots. As people_delays() has it
// (host/ranking/measures.hpp): of people who met robots, against the same people without.
struct PedestrianDelay {
  std::size_t combination;  // with robots
  std::uint32_t pairs;
  core::MeanOfTasks over_tasks;  // s
};

struct Choice {
  Varied varied;
  const char* name;
  std::string CombinationLabels::*label;
};

constexpr Choice choices[] = {{Varied::global_planner, "global_planner", &CombinationLabels::global_planner},
                              {Varied::local_controller, "local_controller", &CombinationLabels::local_controller},
                              {Varied::pedestrian_model, "pedestrian_model", &CombinationLabels::pedestrian_model}};

std::vector<Stratum> strata_of(const ReportFrame& frame) {
  std::vector<Stratum> strata;
  for (std::size_t trial = 0; trial < frame.trials.size(); ++trial) {
    if (!has_result(frame.trials[trial]) || frame.trials[trial].robots == 0) continue;
    CombinationLabels labels = frame.combinations[frame.combination_of[trial]];
    labels.local_controller.clear();
    const auto found =
        std::find_if(strata.begin(), strata.end(), [&](const auto& one) { return one.labels == labels; });
    if (found == strata.end())
      strata.push_back({labels, {trial}});
    else
      found->trials.push_back(trial);
  }
  return strata;
}

core::RankCorrelation correlate(const ReportFrame& frame, const Stratum& stratum, std::size_t x, std::size_t y) {
  std::map<std::size_t, std::vector<std::size_t>> controllers;  // by combination: the other labels are constant
  for (const std::size_t trial : stratum.trials)
    if (frame.values[trial][x] && frame.values[trial][y]) controllers[frame.combination_of[trial]].push_back(trial);
  std::vector<std::vector<double>> xs;
  std::vector<std::vector<double>> ys;
  for (const auto& [combination, trials] : controllers) {
    xs.push_back(
        observation_means(frame.observations, trials, [&](std::size_t trial) { return frame.values[trial][x]; }));
    ys.push_back(
        observation_means(frame.observations, trials, [&](std::size_t trial) { return frame.values[trial][y]; }));
  }
  return core::task_rank_correlation(xs, ys, frame.observations.resampling);
}

std::vector<StratumCorrelation> stratum_correlations(const ReportFrame& frame, const DiagnosisAxes& axes) {
  std::vector<StratumCorrelation> found;
  const std::optional<std::size_t> x = frame.metric(axes.x);
  if (!x) return found;
  for (const Stratum& stratum : strata_of(frame))
    for (const std::string& name : axes.y)
      if (const std::optional<std::size_t> y = frame.metric(name))
        found.push_back({stratum.labels, *x, *y, correlate(frame, stratum, *x, *y)});
  return found;
}

// One for each robot. The robots of a trial that a fault ended before it was measured did not arrive.
std::vector<core::TimeToEvent> robots_of(const TrialRecord& trial, const std::string& metric, double horizon_s) {
  std::vector<core::TimeToEvent> robots;
  for (const MetricValue& value : trial.values) {
    if (value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate || value.metric != metric) continue;
    robots.push_back({value.value.value_or(horizon_s), value.value.has_value()});
  }
  if (robots.empty() && trial.outcome == trial_outcome::fault) robots.resize(trial.robots, {horizon_s, false});
  return robots;
}

// Nobody is censored before the horizon: the area under the curve is a mean.
core::MeanOfTasks restricted_mean(const Observations& observations, std::span<const std::size_t> trials,
                                  const std::vector<std::vector<core::TimeToEvent>>& by_trial, double horizon_s) {
  const auto mean_of = [&](std::size_t trial) -> std::optional<double> {
    if (by_trial[trial].empty()) return std::nullopt;
    double sum_s = 0.0;
    for (const core::TimeToEvent& robot : by_trial[trial]) sum_s += std::min(robot.time, horizon_s);
    return sum_s / static_cast<double>(by_trial[trial].size());
  };
  return core::mean_of_tasks(observation_means(observations, trials, mean_of), core::Interval{0.0, horizon_s},
                             observations.resampling);
}

// The time limit, or the end of the longest trial if the manifest has none.
double horizon_of(const ReportFrame& frame, const ExperimentFacts& facts, std::size_t combination) {
  if (const auto limit_s = time_limit_s(facts, frame.combinations[combination])) return *limit_s;
  double longest_s = 0.0;
  for (std::size_t i = 0; i < frame.trials.size(); ++i)
    if (frame.combination_of[i] == combination) longest_s = std::max(longest_s, frame.trials[i].sim_time_s);
  return longest_s;
}

// For each combination with robots; empty if the metric of the layout was not measured.
std::vector<ArrivalTimes> arrival_times(const ReportFrame& frame, const ExperimentFacts& facts,
                                        const ReportLayout& layout) {
  std::vector<ArrivalTimes> found;
  if (!frame.metric(layout.completion)) return found;
  std::vector<std::vector<core::TimeToEvent>> by_trial(frame.trials.size());
  for (std::size_t i = 0; i < frame.combinations.size(); ++i) {
    const double horizon_s = horizon_of(frame, facts, i);
    std::vector<std::size_t> trials;
    std::vector<core::TimeToEvent> robots;
    for (std::size_t trial = 0; trial < frame.trials.size(); ++trial) {
      if (frame.combination_of[trial] != i || !has_result(frame.trials[trial])) continue;
      trials.push_back(trial);
      by_trial[trial] = robots_of(frame.trials[trial], layout.completion, horizon_s);
      robots.insert(robots.end(), by_trial[trial].begin(), by_trial[trial].end());
    }
    if (robots.empty()) continue;
    const auto arrived = std::count_if(robots.begin(), robots.end(), [](const auto& robot) { return robot.happened; });
    found.push_back({i, static_cast<std::uint32_t>(robots.size()), horizon_s,
                     restricted_mean(frame.observations, trials, by_trial, horizon_s),
                     static_cast<double>(arrived) / static_cast<double>(robots.size()), core::kaplan_meier(robots)});
  }
  return found;
}

// For each combination with robots that has a counterpart without robots; empty if the metrics were not measured.
std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const SummaryLayout& layout) {
  const std::vector<std::optional<double>> delays = people_delays(layout, frame.trials);
  std::map<std::size_t, std::vector<std::size_t>> trials_of;  // a combination's with a delay
  for (std::size_t i = 0; i < delays.size(); ++i)
    if (delays[i]) trials_of[frame.combination_of[i]].push_back(i);
  std::vector<PedestrianDelay> found;
  for (const auto& [combination, trials] : trials_of)
    found.push_back(
        {combination, static_cast<std::uint32_t>(trials.size()),
         core::mean_of_tasks(observation_means(frame.observations, trials, [&](std::size_t i) { return delays[i]; }),
                             {}, frame.observations.resampling)});
  return found;
}

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
  json["n"] = over_tasks.n;
  json["ties"] = one.ties;
  json["median_difference"] = one.shift.estimate;
  json["low"] = one.shift.interval.low;
  json["high"] = one.shift.interval.high;
  json["mean_difference"] = over_tasks.mean;
  json["mean_low"] = over_tasks.interval.low;
  json["mean_high"] = over_tasks.interval.high;
  json["effect"] = one.effect;
  json["test"] = one.test == PairedTest::signed_rank ? "signed_rank" : "mean";
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
  return {{"combination", one.combination},
          {"pairs", one.pairs},
          {"n", one.over_tasks.n},
          {"mean_s", one.over_tasks.mean},
          {"low", one.over_tasks.interval.low},
          {"high", one.over_tasks.interval.high}};
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
    json["against"].push_back({{"n", against.over_tasks.n},
                               {"mean", against.over_tasks.mean},
                               {"low", against.over_tasks.interval.low},
                               {"high", against.over_tasks.interval.high},
                               {"equal", against.equal}});
  return json;
}

Json answer_json(const Answer& answer, std::span<const CombinationFailures> failures) {
  Json json = {{"heading", answer_heading(answer)},
               {"n", answer.n},
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
  return {{"cause", cause.cause},
          {"robots", cause.robots},
          {"after_contact", cause.after_contact},
          {"roots", cause.roots},
          {"trials", cause.trials}};
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
  json["growth_line"] = growth_line(facts);
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
