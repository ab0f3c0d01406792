// SPDX-License-Identifier: MIT
// resampling.hpp: the tasks of a benchmark as observations, and one resampling of them that all intervals share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {

// What a statement is about. `these_worlds`: an observation is a task, and other tasks of these worlds may be drawn.
// `in_general`: an observation is a world (the mean of its tasks), and other worlds may be drawn.
enum class Scope { these_worlds, in_general };

// Fewer worlds allow no statement in general.
inline constexpr std::size_t fewest_worlds_in_general = 5;

// Values of tasks (NaN: undefined) as values of observations, and whole observations drawn with replacement (Efron and
// Tibshirani: An Introduction to the Bootstrap, 1993, section 8). In these worlds, tasks are drawn within their worlds
// where each world has at least five, else from all together: of fewer in a world, draws spread too little.
// Deterministic: the draws come from a named stream.
class Resampling {
 public:
  // `world_of_task`: from 0, without gaps.
  Resampling(std::span<const std::uint32_t> world_of_task, Scope scope, std::uint32_t resamples = 2000,
             std::uint64_t seed = 1);

  Scope scope() const { return scope_; }
  std::size_t tasks() const { return observation_of_task_.size(); }
  std::size_t observations() const { return stratum_.size(); }
  std::size_t resamples() const { return resamples_; }
  std::size_t observation_of_task(std::size_t task) const { return observation_of_task_[task]; }
  std::size_t stratum_of(std::size_t observation) const { return stratum_[observation]; }
  std::size_t strata() const { return strata_; }

  // By observation: a task's own value, or the mean of a world's tasks; NaN where no task is defined.
  std::vector<double> by_observation(std::span<const double> by_task) const;

  // How often a resample holds each observation.
  std::span<const std::uint32_t> counts(std::size_t resample) const {
    return std::span<const std::uint32_t>(counts_).subspan(resample * observations(), observations());
  }

 private:
  Scope scope_;
  std::vector<std::uint32_t> observation_of_task_;
  std::vector<std::uint32_t> stratum_;  // of an observation: what is drawn within
  std::size_t strata_ = 1;
  std::size_t resamples_;
  std::vector<std::uint32_t> counts_;  // [resample][observation]
};

// The interval of a statistic that is no mean (a ratio, an area), from its values over the resamples: between the 2.5 %
// and 97.5 % quantiles. Ignores NaNs (resamples in which it is undefined); undefined if fewer than half remain.
Interval percentile_interval(std::vector<double> resampled);

}  // namespace dmrp::core
