// SPDX-License-Identifier: MIT
#include "host/ranking/answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "core/statistics/sample_size.hpp"
#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-9;  // sums in another order differ by less

double mean_or_undefined(const std::vector<double>& values) {
  return values.empty() ? undefined : core::mean(values);
}

// How trials are compared in each criterion.
class Measures {
 public:
  Measures(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials)
      : trials_(trials), values_(system_values(metrics, trials)) {
    for (const std::string& share : layout.answer.shares) {
      const auto metric =
          std::find_if(metrics.begin(), metrics.end(), [&](const auto& column) { return column.name == share; });
      if (metric == metrics.end()) continue;
      std::string name = share;
      std::replace(name.begin(), name.end(), '_', ' ');
      criteria_.push_back({name, true});
      metrics_.push_back(static_cast<std::size_t>(metric - metrics.begin()));
    }
    ways_ = robot_values(trials, layout.answer.way_length);
    times_ = robot_values(trials, layout.answer.time);
    for (std::size_t trial = 0; trial < times_.size(); ++trial)
      for (std::size_t robot = 0; robot < times_[trial].size(); ++robot) {
        std::optional<double>& time = times_[trial][robot];
        const std::optional<double>& way = ways_[trial][robot];
        time = time && way && *way > 0.0 ? std::optional(*time / *way) : std::nullopt;
        any_time_ = any_time_ || time;
      }
    if (any_time_ && !criteria_.empty()) criteria_.push_back({"time", false});
  }

  const std::vector<Criterion>& criteria() const { return criteria_; }
  const RobotValues& ways() const { return ways_; }

  Difference difference(std::size_t criterion) const {
    if (criteria_[criterion].share)
      return difference_of([this, criterion](std::size_t trial) { return share(trial, criterion); });
    return [this](std::span<const std::size_t> a, std::span<const std::size_t> b) {
      return time_difference(a.front(), b.front());
    };
  }

  double mean(std::span<const std::size_t> trials, std::size_t criterion) const {
    std::vector<double> values;
    for (const std::size_t trial : trials) {
      const std::optional<double> value = criteria_[criterion].share ? share(trial, criterion) : time(trial);
      if (value) values.push_back(*value);
    }
    return mean_or_undefined(values);
  }

 private:
  // A trial that ended in a fault counts as 0.
  std::optional<double> share(std::size_t trial, std::size_t criterion) const {
    if (const auto& value = values_[trial][metrics_[criterion]]) return value;
    return trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0) : std::nullopt;
  }

  // The mean of the robots that arrived.
  std::optional<double> time(std::size_t trial) const {
    std::vector<double> arrived;
    for (const std::optional<double>& value : times_[trial])
      if (value) arrived.push_back(*value);
    if (arrived.empty()) return std::nullopt;
    return core::mean(arrived);
  }

  // The mean over the robots that arrived in both trials.
  std::optional<double> time_difference(std::size_t a, std::size_t b) const {
    std::vector<double> differences;
    for (std::size_t robot = 0; robot < std::min(times_[a].size(), times_[b].size()); ++robot)
      if (times_[a][robot] && times_[b][robot]) differences.push_back(*times_[b][robot] - *times_[a][robot]);
    if (differences.empty()) return std::nullopt;
    return core::mean(differences);
  }

  std::span<const TrialRecord> trials_;
  SystemValues values_;
  RobotValues ways_;
  RobotValues times_;  // over the lengths of the shortest ways
  bool any_time_ = false;
  std::vector<Criterion> criteria_;
  std::vector<std::size_t> metrics_;  // of the criteria that are shares
};

// Whether a comes before b. An undefined time comes last.
bool is_better(const std::vector<Criterion>& criteria, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return std::isnan(b[i]);
    if (std::isnan(a[i]) || std::fabs(a[i] - b[i]) < rounding) continue;
    return criteria[i].share ? a[i] > b[i] : a[i] < b[i];
  }
  return false;
}

RankedCombination ranked(const Contest& contest, std::size_t contestant, const Measures& measures) {
  RankedCombination result;
  result.global_planner = contest.contestants[contestant].global_planner;
  result.local_controller = contest.contestants[contestant].local_controller;
  std::vector<std::size_t> trials;
  for (const auto& of_situation : contest.trials[contestant])
    trials.insert(trials.end(), of_situation.begin(), of_situation.end());
  result.trials = static_cast<std::uint32_t>(trials.size());
  for (std::size_t i = 0; i < measures.criteria().size(); ++i) result.means.push_back(measures.mean(trials, i));
  return result;
}

AgainstFirst compare(const std::vector<double>& differences, bool share) {
  AgainstFirst result;
  result.observations = static_cast<std::uint32_t>(differences.size());
  std::vector<std::vector<double>> clusters;
  for (const double difference : differences) clusters.push_back({difference});
  result.mean = mean_or_undefined(differences);
  result.interval = core::cluster_bootstrap_interval(clusters);
  result.sd = core::sample_sd(differences);
  const bool equal =
      std::all_of(differences.begin(), differences.end(), [](double one) { return std::fabs(one) < rounding; });
  result.p = equal ? undefined : paired_test(differences, share ? PairedTest::sign_flip : PairedTest::signed_rank).p;
  return result;
}

// Corrects the p values over all comparisons with the first.
void adjust(Answer& answer) {
  std::vector<double> p_values;
  for (const RankedCombination& one : answer.ranking)
    for (const AgainstFirst& against : one.against) p_values.push_back(against.p);
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  auto next = adjusted.begin();
  for (RankedCombination& one : answer.ranking)
    for (AgainstFirst& against : one.against) against.p_holm = *next++;
}

void judge(const Answer& answer, RankedCombination& one) {
  one.standing = Standing::not_told_apart;
  for (std::size_t i = 0; i < one.against.size(); ++i) {
    if (!(one.against[i].p_holm < significant)) continue;
    one.decided = i;
    if ((one.against[i].mean < 0.0) == answer.criteria[i].share) one.standing = Standing::worse;
    return;
  }
}

std::optional<std::uint64_t> needed(const Answer& answer) {
  double sd = 0.0;
  for (const RankedCombination& one : answer.ranking)
    if (one.standing == Standing::not_told_apart && one.against[0].observations >= least_for_needed)
      sd = std::max(sd, one.against[0].sd);
  const double level = significant / static_cast<double>(answer.ranking.size() - 1);  // Holm's strictest
  return core::pairs_needed(sd, wished_difference, level);
}

Answer answer_of(const Contest& contest, const Measures& measures) {
  Answer answer{contest.cells, contest.tasks, contest.tasks_known, in_general(contest), 0, measures.criteria(), {}, {}};
  std::vector<RankedCombination> all;
  for (std::size_t i = 0; i < contest.contestants.size(); ++i) all.push_back(ranked(contest, i, measures));
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return is_better(answer.criteria, all[a].means, all[b].means);
  });
  for (const std::size_t i : order) {
    RankedCombination& one = answer.ranking.emplace_back(all[i]);
    if (i == order.front()) continue;
    for (std::size_t c = 0; c < answer.criteria.size(); ++c)
      one.against.push_back(
          compare(paired_differences(contest, order.front(), i, measures.difference(c)), answer.criteria[c].share));
  }
  adjust(answer);
  for (std::size_t i = 1; i < answer.ranking.size(); ++i) {
    judge(answer, answer.ranking[i]);
    answer.observations = std::max(answer.observations, answer.ranking[i].against[0].observations);
  }
  answer.needed = needed(answer);
  return answer;
}

}  // namespace

std::vector<Answer> answers(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                            std::span<const TrialRecord> trials) {
  const Measures measures(layout, metrics, trials);
  if (measures.criteria().empty()) return {};
  std::vector<Answer> found;
  const auto add = [&](const std::function<bool(const CombinationLabels&)>& included) {
    const Contest contest = make_contest(trials, measures.ways(), Contestants::planners_and_controllers, included);
    if (contest.contestants.size() > 1) found.push_back(answer_of(contest, measures));
    return contest.cells;
  };
  const std::vector<CombinationLabels> cells = add([](const CombinationLabels&) { return true; });
  if (cells.size() < 2) return found;
  for (const CombinationLabels& cell : cells)
    add([&](const CombinationLabels& labels) {
      return labels.scenario == cell.scenario && labels.robots == cell.robots &&
             labels.pedestrian_model == cell.pedestrian_model;
    });
  return found;
}

}  // namespace dmrp::host
