// SPDX-License-Identifier: MIT
#include "host/report/data/report_correlations.hpp"

#include <algorithm>
#include <cstdint>

namespace dmrp::host {
namespace {

struct Stratum {
  CombinationLabels labels;
  std::vector<std::size_t> trials;
};

std::vector<Stratum> strata_of(const ReportFrame& frame) {
  std::vector<Stratum> strata;
  for (std::size_t trial = 0; trial < frame.trials.size(); ++trial) {
    if (frame.trials[trial].outcome == trial_outcome::skipped || frame.trials[trial].robots == 0) continue;
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
  std::vector<double> xs;
  std::vector<double> ys;
  std::vector<std::uint64_t> seeds;
  std::vector<std::uint32_t> controllers;  // by combination: the other labels are constant in the stratum
  for (const std::size_t trial : stratum.trials) {
    const auto& values = frame.values[trial];
    if (!values[x] || !values[y]) continue;
    xs.push_back(*values[x]);
    ys.push_back(*values[y]);
    seeds.push_back(frame.trials[trial].seed);
    controllers.push_back(static_cast<std::uint32_t>(frame.combination_of[trial]));
  }
  return core::rank_correlation(xs, ys, seeds, controllers);
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
