// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "core/statistics/descriptive.hpp"
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
  std::erase_if(others, [&](const SweptValue& one) { return column_of(one) == over; });
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
  using Clusters = std::map<std::uint64_t, std::vector<double>>;                       // by seed
  std::vector<std::pair<std::vector<std::string>, std::map<double, Clusters>>> lines;  // in order of appearance
  std::vector<std::set<std::string>> found(5);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    std::optional<double> value = values[i][index];
    if (!value && counts && trials[i].outcome == trial_outcome::fault) value = 0.0;
    const std::optional<double> x = x_of(trials[i], over, settings);
    if (!value || !x || trials[i].robots == 0) continue;
    const std::vector<std::string> parts = name_parts(trials[i], over, settings);
    for (std::size_t part = 0; part < parts.size(); ++part) found[part].insert(parts[part]);
    auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.first == parts; });
    if (line == lines.end()) line = lines.insert(lines.end(), {parts, {}});
    line->second[*x][trials[i].seed].push_back(*value);
  }

  LineChart chart{over, column->unit.empty() || column->unit == "1" ? metric : metric + " (" + column->unit + ")", {}};
  for (const auto& [parts, points] : lines) {
    ChartLine& line = chart.lines.emplace_back(ChartLine{line_name(parts, found), {}});
    for (const auto& [x, clusters] : points) {
      std::vector<double> all;
      std::vector<std::vector<double>> of_seeds;
      for (const auto& [seed, of_seed] : clusters) {
        all.insert(all.end(), of_seed.begin(), of_seed.end());
        of_seeds.push_back(of_seed);
      }
      line.points.push_back({x, core::mean(all), core::cluster_bootstrap_interval(of_seeds)});
    }
  }
  return chart;
}

}  // namespace dmrp::host
