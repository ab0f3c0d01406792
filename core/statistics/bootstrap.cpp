// SPDX-License-Identifier: MIT
#include "core/statistics/bootstrap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <numeric>
#include <utility>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {
BootstrapDraws::BootstrapDraws(std::size_t clusters, const BootstrapSettings& settings)
    : clusters_(clusters), resamples_(settings.resamples), draws_(clusters * settings.resamples) {
  toolkit::Stream random(settings.seed, "statistics.bootstrap");
  for (std::uint32_t& draw : draws_) draw = static_cast<std::uint32_t>(random.below(clusters));
}

Interval cluster_bootstrap_interval(std::span<const std::vector<double>> clusters, const BootstrapDraws& draws) {
  assert(draws.resamples() == 0 || draws.resample(0).size() == clusters.size());
  assert(std::none_of(clusters.begin(), clusters.end(), [](const auto& cluster) { return cluster.empty(); }));
  struct Total {
    double sum;
    double count;
  };
  std::vector<Total> totals;
  for (const std::vector<double>& cluster : clusters)
    totals.push_back({std::accumulate(cluster.begin(), cluster.end(), 0.0), static_cast<double>(cluster.size())});
  if (totals.size() < 2) return {undefined, undefined};

  std::vector<double> means(draws.resamples());
  for (std::size_t i = 0; i < means.size(); ++i) {
    Total drawn{0.0, 0.0};
    for (const std::uint32_t draw : draws.resample(i)) {
      drawn.sum += totals[draw].sum;
      drawn.count += totals[draw].count;
    }
    means[i] = drawn.sum / drawn.count;
  }
  return percentile_interval(std::move(means));
}

Interval cluster_bootstrap_interval(std::span<const std::vector<double>> clusters, const BootstrapSettings& settings) {
  std::vector<std::vector<double>> nonempty;
  for (const std::vector<double>& cluster : clusters)
    if (!cluster.empty()) nonempty.push_back(cluster);
  return cluster_bootstrap_interval(nonempty, BootstrapDraws(nonempty.size(), settings));
}

}  // namespace dmrp::core
