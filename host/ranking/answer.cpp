// SPDX-License-Identifier: MIT
#include "host/ranking/answer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "core/statistics/best_set.hpp"
#include "core/statistics/sample_size.hpp"

namespace dmrp::host {
namespace {

// Those with trials in every cell. With fewer cells than others, an entry would have met other tasks.
std::vector<std::size_t> entries_of_all_cells(const Findings& findings) {
  std::set<CombinationLabels> cells;
  for (const Situation& situation : findings.situations) cells.insert(situation.cell);
  std::vector<std::size_t> entries;
  for (std::size_t entry = 0; entry < findings.entries.size(); ++entry) {
    std::set<CombinationLabels> met;
    for (std::size_t i = 0; i < findings.situations.size(); ++i)
      if (!findings.trials[entry][i].empty()) met.insert(findings.situations[i].cell);
    if (met.size() == cells.size()) entries.push_back(entry);
  }
  return entries;
}

// The answer about some trials while it is made.
class Contest {
 public:
  Contest(const Measures& measures, const Observations& observations, Findings findings)
      : measures_(measures), observations_(observations), findings_(std::move(findings)) {
    for (const std::size_t entry : entries_of_all_cells(findings_)) {
      const auto same = std::find_if(order_.begin(), order_.end(), [&](std::size_t other) {
        return findings_.entries[other].local_controller == findings_.entries[entry].local_controller &&
               measures_.are_same(findings_.trials[other], findings_.trials[entry]);
      });
      if (same == order_.end())
        order_.push_back(entry);
      else
        same_as_[*same].push_back(findings_.entries[entry].global_planner);
    }
  }

  bool has_rivals() const { return order_.size() > 1; }

  Answer answer() {
    Answer answer;
    describe(answer);
    add_factors(answer);
    std::vector<RankedCombination> all;
    for (const std::size_t entry : order_) all.push_back(ranked(entry));
    find_best(answer, all);
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto how_far = [&](std::size_t i) { return all[i].decided.value_or(answer.criteria.size()); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (how_far(a) != how_far(b)) return how_far(a) > how_far(b);
      return is_better(answer.criteria, all[a].means, all[b].means);
    });
    std::vector<std::size_t> entries;
    for (const std::size_t i : order) {
      entries.push_back(order_[i]);
      answer.ranking.push_back(std::move(all[i]));
    }
    order_ = entries;
    answer.ranking.front().standing = Standing::first;
    compare_with_first(answer);
    find_pareto_set(answer);
    add_deviation(answer);
    for (std::size_t i = 0; i < answer.siblings.size(); ++i) add_flips(answer, i);
    return answer;
  }

 private:
  void describe(Answer& answer) const {
    std::set<std::size_t> met;
    std::set<std::size_t> worlds;
    for (const Situation& situation : findings_.situations) {
      if (std::find(answer.cells.begin(), answer.cells.end(), situation.cell) == answer.cells.end())
        answer.cells.push_back(situation.cell);
      met.insert(situation.observation);
      worlds.insert(observations_.world_of[situation.observation]);
    }
    std::vector<std::size_t> trials;
    for (const std::size_t entry : order_)
      for (const auto& of_situation : findings_.trials[entry])
        trials.insert(trials.end(), of_situation.begin(), of_situation.end());
    answer.met = observations_.met_by(trials);
    answer.n = static_cast<std::uint32_t>(met.size());
    answer.worlds = static_cast<std::uint32_t>(worlds.size());
    answer.in_general = answer.worlds >= core::fewest_worlds_in_general;
    answer.criteria = measures_.criteria();
    answer.siblings = measures_.siblings();
    answer.safe = measures_.safe().value_or(0);
  }

  // Main effects in the first criterion, where entries are a product.
  void add_factors(Answer& answer) const {
    std::vector<std::string> planners, controllers;
    const auto place_in = [](std::vector<std::string>& names, const std::string& name) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) return names.push_back(name), names.size() - 1;
      return static_cast<std::size_t>(found - names.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> places;  // of entries
    const std::vector<std::size_t> all = entries_of_all_cells(findings_);
    for (const std::size_t entry : all)
      places.emplace_back(place_in(planners, findings_.entries[entry].global_planner),
                          place_in(controllers, findings_.entries[entry].local_controller));
    if (planners.size() < 2 || controllers.size() < 2 || all.size() < planners.size() * controllers.size()) return;
    const auto values = joint_findings(findings_, observations_, all, measures_.joint(answer.criteria.front())).values;
    const auto add = [&](const char* factor, const char* other, const auto& levels, std::size_t others, auto place_of) {
      std::vector<std::vector<double>> means(levels.size(), std::vector<double>(values.front().size()));
      for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t k = 0; k < values[i].size(); ++k)
          means[place_of(places[i])][k] += values[i][k] / static_cast<double>(others);
      answer.factors.emplace_back(FactorEffects{factor, other, others, levels, core::level_effects(means)});
      if (answer.factors.back().effects.empty()) answer.factors.pop_back();
    };
    add("controller", "planner", controllers, planners.size(), [](const auto& place) { return place.second; });
    // twenty crowds that meet one plan say nothing of planners
    if (answer.met.tasks > 1)
      add("planner", "controller", planners, controllers.size(), [](const auto& place) { return place.first; });
  }

  RankedCombination ranked(std::size_t entry) const {
    RankedCombination result;
    result.global_planner = findings_.entries[entry].global_planner;
    result.local_controller = findings_.entries[entry].local_controller;
    if (const auto same = same_as_.find(entry); same != same_as_.end()) result.same_as = same->second;
    std::vector<std::size_t> trials;
    for (const auto& of_situation : findings_.trials[entry])
      trials.insert(trials.end(), of_situation.begin(), of_situation.end());
    result.trials = static_cast<std::uint32_t>(trials.size());
    const auto over_tasks = [&](const Criterion& one) {
      const auto value = [&](std::size_t trial) { return measures_.value(trial, one); };
      return core::mean_of_tasks(observation_means(observations_, trials, value), bounds_of_values(one.share()),
                                 observations_.resampling);
    };
    for (const Criterion& one : measures_.criteria()) {
      const core::MeanOfTasks found = over_tasks(one);
      result.means.push_back(found.mean);
      result.intervals.push_back(found.interval);
    }
    for (const Criterion& one : measures_.siblings()) result.sibling_means.push_back(over_tasks(one).mean);
    return result;
  }

  // By task: of one entry minus of another.
  std::vector<double> differences(std::size_t a, std::size_t b, const Criterion& criterion) const {
    return joint_findings(findings_, observations_, std::vector{a, b}, measures_.joint(criterion)).differences(0, 1);
  }

  void compare_with_first(Answer& answer) const {
    for (std::size_t i = 1; i < order_.size(); ++i)
      for (const Criterion& criterion : answer.criteria)
        answer.ranking[i].against.push_back(paired_difference(differences(order_.front(), order_[i], criterion),
                                                              PairedTest::mean, bounds_of_values(criterion.share()),
                                                              observations_.resampling));
  }

  // `all`: the entries as ranked.
  core::BestSet best_set(const core::Resampling& resampling, const std::vector<RankedCombination>& all) const {
    std::vector<core::Criterion> criteria;
    for (const Criterion& one : measures_.criteria()) {
      std::vector<double> means;
      for (const RankedCombination& entry : all) means.push_back(entry.means[criteria.size()]);
      core::Criterion& by = criteria.emplace_back();
      by.differences = [this, one](std::size_t a, std::size_t b) { return differences(order_[a], order_[b], one); };
      by.higher_is_better = one.share();
      by.score = one.kind == Criterion::Kind::time ? core::PairedScore::ranks : core::PairedScore::mean;
      by.margin = one.share()                          ? tolerated_share
                  : one.kind == Criterion::Kind::delay ? tolerated_delay_s
                                                       : tolerated_time_share * core::mean(means);
      by.bounds = bounds_of_values(one.share());
    }
    return core::best_set(order_.size(), criteria, resampling);
  }

  void find_best(const Answer& answer, std::vector<RankedCombination>& all) const {
    const core::BestSet best = best_set(observations_.resampling, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].standing = best.excluded[i] ? Standing::worse : Standing::may_be_best;
      if (best.excluded[i]) all[i].decided = best.excluded[i]->criterion;
    }
    if (!answer.in_general) return;
    const core::BestSet general = best_set({observations_.world_of, core::Scope::in_general}, all);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].best_in_general = !general.excluded[i];
  }

  static void find_pareto_set(Answer& answer) {
    std::vector<std::vector<double>> means(answer.criteria.size());
    std::vector<bool> higher_is_better;
    for (std::size_t c = 0; c < answer.criteria.size(); ++c) {
      higher_is_better.push_back(answer.criteria[c].share());
      for (const RankedCombination& one : answer.ranking) means[c].push_back(one.means[c]);
    }
    const std::vector<bool> found = core::pareto_set(means, higher_is_better);
    for (std::size_t i = 0; i < found.size(); ++i) answer.ranking[i].pareto = found[i];
  }

  static void add_deviation(Answer& answer) {
    for (const RankedCombination& one : answer.ranking)
      if (one.standing == Standing::may_be_best && one.against[0].over_tasks.n >= least_for_deviation)
        answer.deviation = std::max(answer.deviation, one.against[0].over_tasks.sd);
  }

  static void add_flips(Answer& answer, std::size_t sibling) {
    const std::vector<RankedCombination>& ranking = answer.ranking;
    for (std::size_t before = 0; before < ranking.size(); ++before)
      for (std::size_t behind = before + 1; behind < ranking.size(); ++behind)
        for (const auto& [a, b] : {std::pair(before, behind), std::pair(behind, before)})
          if (ranking[a].means[answer.safe] > ranking[b].means[answer.safe] + rounding &&
              ranking[a].sibling_means[sibling] < ranking[b].sibling_means[sibling] - rounding)
            answer.flips.push_back({sibling, a, b});
  }

  const Measures& measures_;
  const Observations& observations_;
  Findings findings_;
  std::vector<std::size_t> order_;  // entries, one of those that did the same in every trial
  std::map<std::size_t, std::vector<std::string>> same_as_;
};

}  // namespace

std::string combination_name(const RankedCombination& one) {
  return one.global_planner + " + " + one.local_controller;
}

std::optional<std::uint64_t> observations_needed(const Answer& answer, double difference) {
  return core::pairs_needed(answer.deviation, difference, significant / static_cast<double>(answer.criteria.size()));
}

std::vector<Answer> answers(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                            std::span<const TrialRecord> trials) {
  const Measures measures(layout, metrics, trials);
  if (measures.criteria().empty()) return {};
  const Observations observations = observations_of(trials);
  std::vector<CombinationLabels> cells;
  for (const TrialRecord& trial : trials)
    if (const auto split = by_planner_and_controller(trial);
        split && has_result(trial) && std::find(cells.begin(), cells.end(), split->cell) == cells.end())
      cells.push_back(split->cell);
  const auto answer_of = [&](const std::function<bool(const CombinationLabels&)>& included) -> std::optional<Answer> {
    Contest contest(measures, observations,
                    make_findings(trials, observations, [&](std::size_t i) -> std::optional<Split> {
                      const std::optional<Split> split = by_planner_and_controller(trials[i]);
                      return split && included(split->cell) ? split : std::nullopt;
                    }));
    return contest.has_rivals() ? std::optional(contest.answer()) : std::nullopt;
  };
  std::vector<Answer> found;
  if (auto answer = answer_of([](const CombinationLabels&) { return true; })) {
    std::set<std::string> models;
    for (const CombinationLabels& cell : cells) models.insert(cell.pedestrian_model);
    for (const std::string& model : models) {
      if (models.size() < 2) break;
      const auto of_model = answer_of([&](const CombinationLabels& cell) { return cell.pedestrian_model == model; });
      if (!of_model) continue;
      Answer::WithPeople& with = answer->with_people.emplace_back(Answer::WithPeople{model, {}});
      for (const RankedCombination& one : of_model->ranking)
        if (one.standing != Standing::worse) with.best.push_back(combination_name(one));
      std::sort(with.best.begin(), with.best.end());
    }
    found.push_back(std::move(*answer));
  }
  if (cells.size() > 1)
    for (const CombinationLabels& cell : cells)
      if (auto answer = answer_of([&](const CombinationLabels& other) { return other == cell; }))
        found.push_back(std::move(*answer));
  return found;
}

}  // namespace dmrp::host
