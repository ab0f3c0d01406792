// SPDX-License-Identifier: MIT
#include "core/statistics/kaplan_meier.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {
namespace {

std::vector<TimeToEvent> by_time(std::span<const TimeToEvent> cases) {
  std::vector<TimeToEvent> sorted(cases.begin(), cases.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return sorted;
}

// Calls visit(time, share) for each event time. `cases` are sorted; case i counts `count[i]` times.
template <class Visit>
void walk_steps(std::span<const TimeToEvent> cases, std::span<const std::uint32_t> count, Visit visit) {
  std::uint64_t watched = std::accumulate(count.begin(), count.end(), std::uint64_t{0});
  double share = 1.0;
  for (std::size_t begin = 0; begin < cases.size();) {
    std::size_t end = begin;
    std::uint64_t happened = 0;
    std::uint64_t gone = 0;
    for (; end < cases.size() && cases[end].time == cases[begin].time; ++end) {
      gone += count[end];
      if (cases[end].happened) happened += count[end];
    }
    if (happened > 0) {
      share *= 1.0 - static_cast<double>(happened) / static_cast<double>(watched);
      visit(cases[begin].time, share);
    }
    watched -= gone;
    begin = end;
  }
}

double area(std::span<const TimeToEvent> sorted, std::span<const std::uint32_t> count, double horizon) {
  double sum = 0.0;
  double from = 0.0;
  double share = 1.0;
  walk_steps(sorted, count, [&](double time, double next_share) {
    const double to = std::min(time, horizon);
    sum += (to - from) * share;
    from = to;
    share = next_share;
  });
  return sum + (horizon - from) * share;
}

}  // namespace

std::vector<SurvivalStep> kaplan_meier(std::span<const TimeToEvent> cases) {
  const std::vector<TimeToEvent> sorted = by_time(cases);
  const std::vector<std::uint32_t> once(sorted.size(), 1);
  std::vector<SurvivalStep> steps;
  walk_steps(sorted, once, [&](double time, double share) { steps.push_back({time, share}); });
  return steps;
}

double restricted_mean(std::span<const TimeToEvent> cases, double horizon) {
  assert(horizon >= 0.0);
  if (cases.empty()) return undefined;
  const std::vector<std::uint32_t> once(cases.size(), 1);
  return area(by_time(cases), once, horizon);
}

Interval restricted_mean_interval(std::span<const TimeToEvent> cases, double horizon,
                                  const BootstrapSettings& settings) {
  const std::vector<TimeToEvent> sorted = by_time(cases);
  std::map<std::uint64_t, std::uint32_t> index_of;
  for (const TimeToEvent& one : sorted) index_of.emplace(one.cluster, 0);
  if (index_of.size() < 2) return {undefined, undefined};
  std::uint32_t next = 0;
  for (auto& [cluster, index] : index_of) index = next++;
  std::vector<std::uint32_t> cluster_of;
  for (const TimeToEvent& one : sorted) cluster_of.push_back(index_of.at(one.cluster));

  const BootstrapDraws draws(index_of.size(), settings);
  std::vector<std::uint32_t> of_cluster(index_of.size());
  std::vector<std::uint32_t> count(sorted.size());
  std::vector<double> means;
  for (std::size_t i = 0; i < draws.resamples(); ++i) {
    std::fill(of_cluster.begin(), of_cluster.end(), 0);
    for (const std::uint32_t draw : draws.resample(i)) ++of_cluster[draw];
    for (std::size_t k = 0; k < count.size(); ++k) count[k] = of_cluster[cluster_of[k]];
    means.push_back(area(sorted, count, horizon));
  }
  return percentile_interval(std::move(means));
}

Interval restricted_mean_interval(std::span<const TimeToEvent> cases, double horizon, const Resampling& resampling) {
  if (cases.empty() || resampling.observations() < 2) return {};
  const std::vector<TimeToEvent> sorted = by_time(cases);
  std::vector<std::uint32_t> count(sorted.size());
  std::vector<double> means;
  for (std::size_t i = 0; i < resampling.resamples(); ++i) {
    const auto counts = resampling.counts(i);
    for (std::size_t k = 0; k < count.size(); ++k) count[k] = counts[resampling.observation_of_task(sorted[k].cluster)];
    const bool any = std::any_of(count.begin(), count.end(), [](std::uint32_t one) { return one > 0; });
    means.push_back(any ? area(sorted, count, horizon) : undefined);
  }
  return percentile_interval(std::move(means));
}

}  // namespace dmrp::core
