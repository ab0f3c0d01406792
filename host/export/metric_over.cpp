// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "host/errors/input_error.hpp"
#include "host/export/line_chart.hpp"
#include "host/results/system_values.hpp"
#include "host/results/world_name.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {
namespace {

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<double> x_of(const TrialRecord& trial, const std::string& over, const RunSettings& settings) {
  if (over == "robots") return trial.robots;
  return number_of(settings.value(over, trial));
}

// The scenario's name without this swept value.
std::string scenario_without(const std::string& over, const TrialRecord& trial) {
  std::vector<SweptValue> others = swept_of_scenario(trial);
  std::erase_if(others, [&](const SweptValue& one) {
    return column_of(one) == over || (over == "people" && column_of(one) == "people_times");
  });
  return with_swept(world_name(trial), others);
}

// What stays of a combination's name on a line: for a swept parameter, its plugin's id instead of its label.
std::vector<std::string> name_parts(const TrialRecord& trial, const std::string& over, const RunSettings& settings) {
  const CombinationLabels labels = combination_of(trial);
  const auto part = [&](const std::string& kind, const std::string& label) {
    return over.starts_with(kind + ".") ? settings.value(kind + ".id", trial) : label;
  };
  return {scenario_without(over, trial), over == "robots" ? "" : fmt::format("{} robots", labels.robots),
          part("global_planner", labels.global_planner), part("local_controller", labels.local_controller),
          part("pedestrian_model", labels.pedestrian_model)};
}

// The parts in which lines differ.
std::string line_name(const std::vector<std::string>& parts, const std::vector<std::set<std::string>>& found) {
  std::string name;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (found[i].size() > 1 && !parts[i].empty()) name += (name.empty() ? "" : " + ") + parts[i];
  return name;
}

void check_over(const std::string& over, std::span<const TrialRecord> trials, const RunSettings& settings) {
  std::vector<std::string> names = settings.names();
  names.push_back("robots");
  if (std::find(names.begin(), names.end(), over) == names.end())
    throw InputError(fmt::format("--over: unknown '{}'{}", over, did_you_mean(over, names)));
  std::set<double> values;
  for (const TrialRecord& trial : trials)
    if (const auto x = x_of(trial, over, settings)) values.insert(*x);
  if (values.size() < 2) throw InputError(fmt::format("--over: trials do not differ in the number '{}'", over));
}

}  // namespace

LineChart metric_over(const std::string& metric, const std::string& over, const SummaryLayout& layout,
                      std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                      const RunSettings& settings) {
  const auto column = std::find_if(metrics.begin(), metrics.end(), [&](const auto& one) { return one.name == metric; });
  if (column == metrics.end()) throw InputError(fmt::format("--metric: '{}' was not measured", metric));
  check_over(over, trials, settings);

  const SystemValues values = system_values(metrics, trials);
  const auto index = static_cast<std::size_t>(column - metrics.begin());
  const bool counts =
      std::find(layout.counts_failures.begin(), layout.counts_failures.end(), metric) != layout.counts_failures.end();
  const Observations observations = observations_of(trials);
  const auto value_of = [&](std::size_t i) {
    const std::optional<double>& value = values[i][index];
    return !value && counts && trials[i].outcome == trial_outcome::fault ? std::optional(0.0) : value;
  };
  using Points = std::map<double, std::vector<std::size_t>>;       // trials by x
  std::vector<std::pair<std::vector<std::string>, Points>> lines;  // in order of appearance
  std::vector<std::set<std::string>> found(5);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::optional<double> x = x_of(trials[i], over, settings);
    if (!value_of(i) || !x || trials[i].robots == 0) continue;
    const std::vector<std::string> parts = name_parts(trials[i], over, settings);
    for (std::size_t part = 0; part < parts.size(); ++part) found[part].insert(parts[part]);
    auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.first == parts; });
    if (line == lines.end()) line = lines.insert(lines.end(), {parts, {}});
    line->second[*x].push_back(i);
  }

  LineChart chart{over, column->unit.empty() || column->unit == "1" ? metric : metric + " (" + column->unit + ")", {}};
  for (const auto& [parts, points] : lines) {
    ChartLine& line = chart.lines.emplace_back(ChartLine{line_name(parts, found), {}});
    for (const auto& [x, of_point] : points) {
      const auto over_tasks = core::mean_of_tasks(observation_means(observations, of_point, value_of),
                                                  bounds_of_values(counts), observations.resampling);
      line.points.push_back({x, over_tasks.mean, over_tasks.interval});
    }
  }
  return chart;
}

}  // namespace dmrp::host
