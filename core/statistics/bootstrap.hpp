// SPDX-License-Identifier: MIT
// bootstrap.hpp: confidence intervals by the percentile bootstrap over clusters: dependent values (the robots of a
// trial, the trials of a seed) are drawn together. Efron and Tibshirani: An Introduction to the Bootstrap, 1993,
// sections 8 and 13. Deterministic: the draws come from a named stream. Undefined results are NaN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::core {

struct BootstrapSettings {
  std::uint32_t resamples = 2000;
  std::uint64_t seed = 1;
};

// The clusters of each resample: drawn once for a number of clusters, used for any number of intervals.
class BootstrapDraws {
 public:
  explicit BootstrapDraws(std::size_t clusters, const BootstrapSettings& settings = {});
  std::size_t resamples() const { return resamples_; }
  std::span<const std::uint32_t> resample(std::size_t i) const {
    return std::span<const std::uint32_t>(draws_).subspan(i * clusters_, clusters_);
  }

 private:
  std::size_t clusters_;
  std::size_t resamples_;
  std::vector<std::uint32_t> draws_;  // [resample][draw]
};

// A 95 % interval for the mean of all values. Needs at least two clusters. The first form takes draws for this number
// of clusters, none of them empty; the second ignores empty clusters.
Interval cluster_bootstrap_interval(std::span<const std::vector<double>> clusters, const BootstrapDraws& draws);
Interval cluster_bootstrap_interval(std::span<const std::vector<double>> clusters,
                                    const BootstrapSettings& settings = {});

}  // namespace dmrp::core
