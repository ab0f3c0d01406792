// SPDX-License-Identifier: MIT
#include "host/report/data/report_delay.hpp"

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "core/statistics/descriptive.hpp"

namespace dmrp::host {
namespace {

using Crowd = std::tuple<std::string, std::string, std::uint64_t>;  // scenario, pedestrian model, seed
using Curve = std::map<double, double>;                             // seconds -> m

Crowd crowd_of(const TrialRecord& trial) {
  return {trial.scenario, trial.pedestrian_model, trial.seed};
}

Curve progress_of(const TrialRecord& trial, const std::string& metric) {
  Curve curve;
  for (const MetricValue& value : trial.values)
    if (value.subject_kind == DMRP_SUBJECT_SYSTEM && value.coordinate && value.value && value.metric == metric)
      curve[*value.coordinate] = *value.value;
  return curve;
}

// The lost progress at the last second that both curves have, m.
std::optional<double> lost_m(const Curve& without, const Curve& with) {
  for (auto second = with.rbegin(); second != with.rend(); ++second)
    if (const auto same = without.find(second->first); same != without.end()) return same->second - second->second;
  return std::nullopt;
}

struct Reference {
  Curve progress_m;
  double desired_speed;
};

}  // namespace

std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const PedestrianDelayMetrics& metrics) {
  const std::optional<std::size_t> speed = frame.metric(metrics.desired_speed);
  if (!speed) return {};
  std::map<Crowd, Reference> without_robots;
  for (std::size_t i = 0; i < frame.trials.size(); ++i) {
    const std::optional<double>& desired_speed = frame.values[i][*speed];
    if (frame.trials[i].robots == 0 && desired_speed && *desired_speed > 0.0)
      without_robots[crowd_of(frame.trials[i])] = {progress_of(frame.trials[i], metrics.progress), *desired_speed};
  }

  std::map<std::size_t, std::map<std::uint64_t, std::vector<double>>> delays_s;  // of a combination, by seed
  for (std::size_t i = 0; i < frame.trials.size(); ++i) {
    const TrialRecord& trial = frame.trials[i];
    const auto reference = without_robots.find(crowd_of(trial));
    if (trial.robots == 0 || reference == without_robots.end()) continue;
    if (const auto lost = lost_m(reference->second.progress_m, progress_of(trial, metrics.progress)))
      delays_s[frame.combination_of[i]][trial.seed].push_back(*lost / reference->second.desired_speed);
  }

  std::vector<PedestrianDelay> found;
  for (const auto& [combination, by_seed] : delays_s) {
    std::vector<double> all;
    std::vector<std::vector<double>> clusters;
    for (const auto& [seed, of_seed] : by_seed) {
      all.insert(all.end(), of_seed.begin(), of_seed.end());
      clusters.push_back(of_seed);
    }
    found.push_back({combination, static_cast<std::uint32_t>(all.size()), core::mean(all),
                     core::cluster_bootstrap_interval(clusters)});
  }
  return found;
}

}  // namespace dmrp::host
