// SPDX-License-Identifier: MIT
#include "host/report/data/report_correlations.hpp"

#include <algorithm>
#include <map>

namespace dmrp::host {
namespace {

struct Stratum {
  CombinationLabels labels;
  std::vector<std::size_t> trials;
};

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
    xs.push_back(task_means(frame.tasks, trials, [&](std::size_t trial) { return frame.values[trial][x]; }));
    ys.push_back(task_means(frame.tasks, trials, [&](std::size_t trial) { return frame.values[trial][y]; }));
  }
  return core::task_rank_correlation(xs, ys, frame.tasks.resampling);
}

}  // namespace

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

}  // namespace dmrp::host
