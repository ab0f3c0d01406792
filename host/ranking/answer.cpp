// SPDX-License-Identifier: MIT
#include "host/ranking/answer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "core/statistics/sample_size.hpp"
#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

RankedCombination ranked(const Contest& contest, std::size_t contestant, const Measures& measures) {
  RankedCombination result;
  result.global_planner = contest.contestants[contestant].global_planner;
  result.local_controller = contest.contestants[contestant].local_controller;
  std::vector<std::size_t> trials;
  for (const auto& of_situation : contest.trials[contestant])
    trials.insert(trials.end(), of_situation.begin(), of_situation.end());
  result.trials = static_cast<std::uint32_t>(trials.size());
  for (const Criterion& one : measures.criteria()) result.means.push_back(measures.mean(trials, one));
  for (const Criterion& one : measures.siblings()) result.sibling_means.push_back(measures.mean(trials, one));
  return result;
}

AgainstFirst compare(const std::vector<double>& differences, bool share) {
  AgainstFirst result;
  result.observations = static_cast<std::uint32_t>(differences.size());
  std::vector<std::vector<double>> clusters;
  for (const double difference : differences) clusters.push_back({difference});
  result.mean = core::mean(differences);
  result.interval = core::cluster_bootstrap_interval(clusters);
  result.sd = core::sample_sd(differences);
  const bool equal =
      std::all_of(differences.begin(), differences.end(), [](double one) { return std::fabs(one) < rounding; });
  result.p =
      equal ? core::undefined : paired_test(differences, share ? PairedTest::sign_flip : PairedTest::signed_rank).p;
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

void add_flips(Answer& answer, std::size_t sibling) {
  const std::vector<RankedCombination>& ranking = answer.ranking;
  for (std::size_t before = 0; before < ranking.size(); ++before)
    for (std::size_t behind = before + 1; behind < ranking.size(); ++behind)
      if (ranking[before].means[0] > ranking[behind].means[0] + rounding &&
          ranking[before].sibling_means[sibling] < ranking[behind].sibling_means[sibling] - rounding)
        answer.flips.push_back({sibling, before, behind});
}

Answer answer_of(const Contest& contest, const Measures& measures) {
  Answer answer;
  answer.cells = contest.cells;
  answer.tasks = contest.tasks;
  answer.tasks_known = contest.tasks_known;
  answer.in_general = in_general(contest);
  answer.criteria = measures.criteria();
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
  if (answer.in_general && answer.observations >= least_for_needed && answer.criteria.front().share)
    answer.pairs = pairs_apart(contest, measures);
  answer.siblings = measures.siblings();
  for (std::size_t i = 0; i < answer.siblings.size(); ++i) add_flips(answer, i);
  return answer;
}

}  // namespace

std::vector<Answer> answers(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                            std::span<const TrialRecord> trials) {
  const Measures measures(layout, metrics, trials);
  if (measures.criteria().empty()) return {};
  std::vector<Answer> found;
  const auto add = [&](const std::function<bool(const CombinationLabels&)>& included) {
    const Contest contest = make_contest(trials, Contestants::planners_and_controllers, included);
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
