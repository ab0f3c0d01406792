// SPDX-License-Identifier: MIT
#include "host/report/data/report_curves.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/statistics/descriptive.hpp"

namespace dmrp::host {
namespace {

using ValuesBySeed = std::map<std::uint64_t, std::vector<double>>;  // without undefined values

CurvePoint summarise_point(double coordinate, const ValuesBySeed& by_seed,
                           std::map<std::size_t, core::BootstrapDraws>& draws) {
  std::vector<double> values;
  std::vector<std::vector<double>> clusters;
  for (const auto& [seed, of_seed] : by_seed) {
    if (of_seed.empty()) continue;
    values.insert(values.end(), of_seed.begin(), of_seed.end());
    clusters.push_back(of_seed);
  }
  const auto& drawn = draws.try_emplace(clusters.size(), clusters.size()).first->second;
  return {coordinate, core::mean(values), core::cluster_bootstrap_interval(clusters, drawn),
          static_cast<std::uint32_t>(values.size())};
}

}  // namespace

std::vector<MetricCurve> metric_curves(const ReportFrame& frame, const ReportLayout& layout) {
  std::map<std::string_view, std::size_t> metric_of;
  for (std::size_t i = 0; i < frame.metrics.size(); ++i)
    if (frame.metrics[i].name != layout.pedestrian_delay.progress) metric_of.emplace(frame.metrics[i].name, i);

  std::map<std::pair<std::size_t, std::size_t>, std::map<double, ValuesBySeed>> collected;  // (metric, combination)
  for (std::size_t i = 0; i < frame.trials.size(); ++i)
    for (const MetricValue& value : frame.trials[i].values) {
      if (value.subject_kind != DMRP_SUBJECT_SYSTEM || !value.coordinate) continue;
      const auto metric = metric_of.find(value.metric);
      if (metric == metric_of.end()) continue;
      std::vector<double>& of_seed =
          collected[{metric->second, frame.combination_of[i]}][*value.coordinate][frame.trials[i].seed];
      if (value.value) of_seed.push_back(*value.value);
    }

  std::vector<MetricCurve> curves;
  std::map<std::size_t, core::BootstrapDraws> draws;  // by number of seeds
  for (const auto& [key, points] : collected) {
    MetricCurve curve{key.first, key.second, {}};
    for (const auto& [coordinate, by_seed] : points)
      curve.points.push_back(summarise_point(coordinate, by_seed, draws));
    const bool defined =
        std::any_of(curve.points.begin(), curve.points.end(), [](const auto& point) { return point.defined > 0; });
    if (defined) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace dmrp::host
