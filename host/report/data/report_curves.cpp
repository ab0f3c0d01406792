// SPDX-License-Identifier: MIT
#include "host/report/data/report_curves.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace dmrp::host {
namespace {

using Values = std::map<std::size_t, double>;  // by trial, without undefined ones

CurvePoint summarise_point(double coordinate, const Values& values, const Tasks& tasks) {
  std::vector<std::size_t> trials;
  for (const auto& [trial, value] : values) trials.push_back(trial);
  const auto value_of = [&](std::size_t trial) { return std::optional(values.at(trial)); };
  return {coordinate, core::mean_of_tasks(task_means(tasks, trials, value_of), {}, tasks.resampling),
          static_cast<std::uint32_t>(values.size())};
}

}  // namespace

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
      curve.points.push_back(summarise_point(coordinate, values, frame.tasks));
    const bool defined =
        std::any_of(curve.points.begin(), curve.points.end(), [](const auto& point) { return point.defined > 0; });
    if (defined) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace dmrp::host
