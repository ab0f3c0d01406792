// SPDX-License-Identifier: MIT
#include "host/export/mean_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/statistics/descriptive.hpp"
#include "host/findings/metric_values.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {
namespace {

// What trials of a row, or of a column, agree in.
struct Agreement {
  CombinationLabels labels;
  std::optional<std::uint32_t> people;

  bool operator==(const Agreement& other) const { return labels == other.labels && people == other.people; }
};

// In these labels alone.
Agreement agreement(const TrialRecord& trial, const std::vector<Label>& labels, const PeopleCounts& people) {
  const auto has = [&](Label label) { return std::find(labels.begin(), labels.end(), label) != labels.end(); };
  const CombinationLabels all = combination_of(trial);
  Agreement some;
  if (has(Label::scenario)) some.labels.scenario = all.scenario;
  if (has(Label::robots)) some.labels.robots = all.robots;
  if (has(Label::people)) some.people = people_in(people, trial);
  if (has(Label::global_planner)) some.labels.global_planner = all.global_planner;
  if (has(Label::local_controller)) some.labels.local_controller = all.local_controller;
  if (has(Label::pedestrian_model)) some.labels.pedestrian_model = all.pedestrian_model;
  return some;
}

std::string robots_words(std::uint32_t robots) {
  return std::to_string(robots) + (robots == 1 ? " robot" : " robots");
}

void append(std::string& words, const std::string& separator, const std::string& word) {
  if (!word.empty()) words += (words.empty() ? "" : separator) + word;
}

std::string place_of(const Agreement& trials) {
  std::string words = trials.labels.scenario;
  if (trials.labels.robots > 0) append(words, ", ", robots_words(trials.labels.robots));
  if (trials.people)
    append(words, ", ", std::to_string(*trials.people) + (*trials.people == 1 ? " person" : " people"));
  return words;
}

std::string name_of(const Agreement& trials) {
  std::string words = trials.labels.global_planner;
  append(words, " + ", trials.labels.local_controller);
  append(words, " + ", trials.labels.pedestrian_model);
  return words;
}

std::size_t index_in(std::vector<Agreement>& list, const Agreement& trials) {
  const auto found = std::find(list.begin(), list.end(), trials);
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(trials);
  return index;
}

std::optional<std::size_t> index_of(std::span<const MetricColumn> metrics, const std::string& name) {
  for (std::size_t i = 0; i < metrics.size(); ++i)
    if (metrics[i].name == name) return i;
  return std::nullopt;
}

// Rows by controller alone are means over planners: a task counts where every planner of the row has a plan, or a planner
// that finds none for hard tasks would raise or lower them.
class SolvedTasks {
 public:
  SolvedTasks(const TableSpec& spec, std::span<const TrialRecord> trials, const std::string& planned) : spec_(spec) {
    for (const TrialRecord& trial : trials) {
      if (trial.robots == 0 || !has_result(trial)) continue;
      planners_[row_of(trial)].insert(trial.global_planner);
      if (system_value(trial, planned)) solved_.insert({task_of(trial), trial.global_planner});
    }
  }

  // Whether a row has several planners.
  bool matter() const {
    return std::any_of(planners_.begin(), planners_.end(), [](const auto& row) { return row.second.size() > 1; });
  }

  bool hold(const TrialRecord& trial) const {
    const std::set<std::string>& planners = planners_.at(row_of(trial));
    return planners.size() == 1 || std::all_of(planners.begin(), planners.end(), [&](const std::string& planner) {
             return solved_.contains({task_of(trial), planner});
           });
  }

 private:
  using Task = std::tuple<std::string, std::uint32_t, std::uint64_t>;
  static Task task_of(const TrialRecord& trial) { return {trial.scenario, trial.robots, trial.seed}; }
  std::string row_of(const TrialRecord& trial) const {
    const Agreement row = agreement(trial, spec_.rows, spec_.people);
    return place_of(row) + "\n" + name_of(row);
  }

  const TableSpec& spec_;
  std::map<std::string, std::set<std::string>> planners_;  // by row
  std::set<std::pair<Task, std::string>> solved_;
};

// Whether all trials of a cell belong to the marked row: its labels that are not empty.
bool is_marked(const BestMark& mark, const std::string& metric, const std::vector<std::size_t>& cell,
               std::span<const TrialRecord> trials, bool by_controller) {
  if (mark.metric != metric || mark.labels.local_controller.empty() == by_controller) return false;
  return std::all_of(cell.begin(), cell.end(), [&](std::size_t i) {
    CombinationLabels labels = combination_of(trials[i]);
    if (!by_controller) labels.local_controller = labels.pedestrian_model = "";
    return labels == mark.labels;
  });
}

}  // namespace

std::optional<Label> label_named(const std::string& name) {
  static const std::map<std::string, Label> names = {{"scenario", Label::scenario},
                                                     {"robots", Label::robots},
                                                     {"planner", Label::global_planner},
                                                     {"global_planner", Label::global_planner},
                                                     {"controller", Label::local_controller},
                                                     {"local_controller", Label::local_controller},
                                                     {"people", Label::people},
                                                     {"pedestrian_model", Label::pedestrian_model}};
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

std::string table_caption(const MeanTable& table) {
  const auto any_cell = [&](bool (*holds)(const TableCell&)) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const TableRow& row) { return std::any_of(row.cells.begin(), row.cells.end(), holds); });
  };
  std::string medians;
  for (const SummaryTableColumn& column : table.spec.metrics)
    if (column.median) append(medians, " and ", column.header);
  std::string words = fmt::format("{}: means over {}{}{}.", table.spec.title, met_words(table.met),
                                  medians.empty() ? "" : ", medians of ", medians);
  if (any_cell([](const TableCell& cell) { return cell.interval.has_value(); }))
    words += fmt::format(" In brackets: 95 % intervals over {}s.", observation_name(table.met));
  double at_most = core::undefined;
  for (const TableRow& row : table.rows)
    for (const TableCell& cell : row.cells) at_most = std::fmax(at_most, cell.at_most);
  if (!std::isnan(at_most))
    words += fmt::format(" 0 without brackets: in no {0} of the cell; of all {0}s at most {1:.0f} % have any.",
                         observation_name(table.met), 100.0 * at_most);
  if (table.solved_alone) words += " Over the tasks for which every planner has a plan.";
  if (any_cell([](const TableCell& cell) { return cell.best; }))
    words += " Bold: with 95 % confidence better than all others of its column.";
  if (any_cell([](const TableCell& cell) { return cell.value && cell.defined < cell.trials; }))
    words += " In parentheses: trials in which the value is defined, of all.";
  if (!table.spec.conditions.empty()) words += fmt::format(" Conditions: {}.", table.spec.conditions);
  return words;
}

std::string interval_words(const TableCell& cell, std::uint32_t decimals) {
  return cell.interval ? fmt::format("[{:.{}f}, {:.{}f}]", cell.interval->low, decimals, cell.interval->high, decimals)
                       : "";
}

MeanTable make_mean_table(TableSpec spec, const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                          std::span<const TrialRecord> trials) {
  std::erase_if(spec.metrics, [&](const auto& column) { return !index_of(metrics, column.metric); });
  const auto has = [&](Label label) {
    return std::find(spec.rows.begin(), spec.rows.end(), label) != spec.rows.end() ||
           std::find(spec.columns.begin(), spec.columns.end(), label) != spec.columns.end();
  };
  const bool by_controller = has(Label::local_controller);
  const std::string planned = layout.of_plans.empty() ? "" : layout.of_plans.front();
  const SolvedTasks solved(spec, trials, planned);
  const bool solved_alone =
      by_controller && !has(Label::global_planner) && index_of(metrics, planned) && solved.matter();
  std::vector<Agreement> rows;
  std::vector<Agreement> columns;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].robots == 0 || !has_result(trials[i])) continue;
    std::vector<std::size_t>& cell = cells[{index_in(rows, agreement(trials[i], spec.rows, spec.people)),
                                            index_in(columns, agreement(trials[i], spec.columns, spec.people))}];
    if (!solved_alone || solved.hold(trials[i])) cell.push_back(i);
  }

  const std::vector<BestMark> marks = best_marks(
      layout, metrics, trials, by_controller ? Contestants::planners_and_controllers : Contestants::planners);
  const MetricValues values(kinds_of(layout), metrics, trials);
  const auto defined = [&](const std::vector<std::size_t>& cell, std::size_t metric) {
    std::vector<double> found;
    for (const std::size_t trial : cell)
      if (const auto value = values.of(trial, metric)) found.push_back(*value);
    return found;
  };
  std::vector<std::size_t> all;
  for (const auto& [place, cell] : cells) all.insert(all.end(), cell.begin(), cell.end());

  MeanTable table{spec, {}, {}, {}, solved_alone, observations_of(trials).met_by(all)};
  for (const SummaryTableColumn& column : spec.metrics) {
    const std::string& unit = metrics[*index_of(metrics, column.metric)].unit;
    table.units.push_back(unit == "1" ? "" : unit);
  }
  for (const Agreement& column : columns) {
    std::string title = place_of(column);
    append(title, ", ", name_of(column));
    if (!spec.columns.empty()) table.spans.push_back(title);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    TableRow row{place_of(rows[r]), name_of(rows[r]), {}};
    if (row.name.empty()) std::swap(row.name, row.group);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (const SummaryTableColumn& column : spec.metrics) {
        const std::vector<std::size_t>& cell = cells[{r, c}];
        TableCell shown;
        shown.trials = static_cast<std::uint32_t>(cell.size());
        const std::size_t metric = *index_of(metrics, column.metric);
        const auto found = defined(cell, metric);
        const core::MeanOfTasks over_tasks = values.mean(cell, metric);
        shown.defined = static_cast<std::uint32_t>(found.size());
        if (!found.empty()) shown.value = column.median ? core::median(found) : over_tasks.mean;
        if (over_tasks.n > 1 && !column.median && !std::isnan(over_tasks.interval.low))
          shown.interval = over_tasks.interval;
        if (!column.median) shown.at_most = at_most(metrics[metric], over_tasks);
        if (const auto spread = index_of(metrics, column.spread); spread && !found.empty())
          if (const auto spreads = defined(cell, *spread); !spreads.empty()) shown.spread = core::mean(spreads);
        shown.best = !cell.empty() && std::any_of(marks.begin(), marks.end(), [&](const BestMark& mark) {
          return is_marked(mark, column.metric, cell, trials, by_controller);
        });
        row.cells.push_back(shown);
      }
    table.rows.push_back(std::move(row));
  }
  std::vector<std::string> groups;
  for (const TableRow& row : table.rows)
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
  std::stable_sort(table.rows.begin(), table.rows.end(), [&](const TableRow& a, const TableRow& b) {
    return std::find(groups.begin(), groups.end(), a.group) < std::find(groups.begin(), groups.end(), b.group);
  });
  return table;
}

}  // namespace dmrp::host
