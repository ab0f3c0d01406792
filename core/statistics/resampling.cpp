// SPDX-License-Identifier: MIT
#include "core/statistics/resampling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <numeric>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t fewest_in_stratum = 5;

std::vector<std::size_t> sizes_of(std::span<const std::uint32_t> group) {
  std::vector<std::size_t> sizes;
  for (const std::uint32_t one : group) {
    sizes.resize(std::max<std::size_t>(sizes.size(), one + 1));
    ++sizes[one];
  }
  return sizes;
}

// The same as quantile_of_sorted (descriptive.hpp), without sorting all values.
double quantile(std::vector<double>& values, double p) {
  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), middle, values.end());
  const double above = middle + 1 == values.end() ? *middle : *std::min_element(middle + 1, values.end());
  return *middle + (position - static_cast<double>(below)) * (above - *middle);
}

}  // namespace

Resampling::Resampling(std::span<const std::uint32_t> world_of_task, Scope scope, std::uint32_t resamples,
                       std::uint64_t seed)
    : scope_(scope), resamples_(resamples) {
  const std::vector<std::size_t> sizes = sizes_of(world_of_task);
  if (scope == Scope::in_general) {
    observation_of_task_.assign(world_of_task.begin(), world_of_task.end());
    stratum_.assign(sizes.size(), 0);
  } else {
    observation_of_task_.resize(world_of_task.size());
    std::iota(observation_of_task_.begin(), observation_of_task_.end(), 0);
    stratum_.assign(world_of_task.begin(), world_of_task.end());
    if (std::any_of(sizes.begin(), sizes.end(), [](std::size_t size) { return size < fewest_in_stratum; }))
      std::fill(stratum_.begin(), stratum_.end(), 0);
  }
  std::vector<std::vector<std::uint32_t>> members(std::max<std::size_t>(1, sizes_of(stratum_).size()));
  for (std::uint32_t i = 0; i < stratum_.size(); ++i) members[stratum_[i]].push_back(i);
  strata_ = members.size();
  counts_.assign(resamples_ * observations(), 0);
  toolkit::Stream random(seed, "statistics.resampling");
  for (std::size_t resample = 0; resample < resamples_; ++resample)
    for (const std::vector<std::uint32_t>& stratum : members)
      for (std::size_t draw = 0; draw < stratum.size(); ++draw)
        ++counts_[resample * observations() + stratum[random.below(stratum.size())]];
}

std::vector<double> Resampling::by_observation(std::span<const double> by_task) const {
  assert(by_task.size() == tasks());
  if (scope_ == Scope::these_worlds) return {by_task.begin(), by_task.end()};
  std::vector<std::vector<double>> values(observations());
  for (std::size_t task = 0; task < by_task.size(); ++task)
    if (!std::isnan(by_task[task])) values[observation_of_task_[task]].push_back(by_task[task]);
  std::vector<double> means;
  for (const std::vector<double>& of_world : values) means.push_back(mean(of_world));
  return means;
}

Interval percentile_interval(std::vector<double> resampled) {
  const std::size_t drawn = resampled.size();
  resampled.erase(std::remove_if(resampled.begin(), resampled.end(), [](double value) { return std::isnan(value); }),
                  resampled.end());
  if (resampled.empty() || 2 * resampled.size() < drawn) return {undefined, undefined};
  const double low = quantile(resampled, 0.025);
  return {low, quantile(resampled, 0.975)};
}

}  // namespace dmrp::core
