// SPDX-License-Identifier: MIT
#include "core/statistics/blocks.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <cmath>
#include <limits>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double distribution(double f, double df_entries, double df_rest, double noncentrality) {
  if (noncentrality <= 0.0) return boost::math::cdf(boost::math::fisher_f(df_entries, df_rest), f);
  return boost::math::cdf(boost::math::non_central_f(df_entries, df_rest, noncentrality), f);
}

// The noncentrality under which so much of the distribution lies below f; it falls as the noncentrality grows.
double noncentrality_at(double f, double df_entries, double df_rest, double below) {
  if (distribution(f, df_entries, df_rest, 0.0) <= below) return 0.0;
  double low = 0.0;
  double high = 1.0;
  constexpr double largest = 1e6;
  while (high < largest && distribution(f, df_entries, df_rest, high) > below) high *= 2.0;
  constexpr int halvings = 80;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (distribution(f, df_entries, df_rest, middle) > below ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Interval noncentrality_interval(double f, double df_entries, double df_rest) {
  return {noncentrality_at(f, df_entries, df_rest, 0.975), noncentrality_at(f, df_entries, df_rest, 0.025)};
}

BlockEffect block_effect(std::span<const std::vector<double>> by_entry) {
  BlockEffect effect{undefined, {undefined, undefined}, undefined, undefined, undefined};
  if (by_entry.size() < 2 || by_entry.front().size() < 2) return effect;
  const std::size_t tasks = by_entry.front().size();
  std::vector<double> task_means(tasks);
  std::vector<double> entry_means;
  for (const std::vector<double>& values : by_entry) {
    entry_means.push_back(mean(values));
    for (std::size_t task = 0; task < tasks; ++task)
      task_means[task] += values[task] / static_cast<double>(by_entry.size());
  }
  const double all = mean(entry_means);
  double of_entries = 0.0;
  double of_rest = 0.0;
  for (std::size_t entry = 0; entry < by_entry.size(); ++entry) {
    of_entries += static_cast<double>(tasks) * (entry_means[entry] - all) * (entry_means[entry] - all);
    for (std::size_t task = 0; task < tasks; ++task) {
      const double rest = by_entry[entry][task] - entry_means[entry] - task_means[task] + all;
      of_rest += rest * rest;
    }
  }
  constexpr double rounding = 1e-12;
  if (of_entries + of_rest < rounding) return effect;
  effect.df_entries = static_cast<double>(by_entry.size() - 1);
  effect.df_rest = effect.df_entries * static_cast<double>(tasks - 1);
  effect.partial_eta_squared = of_entries / (of_entries + of_rest);
  if (of_rest < rounding) {
    effect.interval = {1.0, 1.0};  // the limit
    return effect;
  }
  effect.f = (of_entries / effect.df_entries) / (of_rest / effect.df_rest);
  const Interval noncentrality = noncentrality_interval(effect.f, effect.df_entries, effect.df_rest);
  const auto share = [&](double l) { return l / (l + effect.df_entries + effect.df_rest + 1.0); };
  effect.interval = {share(noncentrality.low), share(noncentrality.high)};
  return effect;
}

double kendall_tau(std::span<const double> x, std::span<const double> y) {
  double agreement = 0.0;
  double untied_x = 0.0;
  double untied_y = 0.0;
  const auto sign = [](double a, double b) { return a < b ? 1.0 : a > b ? -1.0 : 0.0; };
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      const double in_x = sign(x[i], x[j]);
      const double in_y = sign(y[i], y[j]);
      agreement += in_x * in_y;
      untied_x += in_x * in_x;
      untied_y += in_y * in_y;
    }
  return untied_x > 0.0 && untied_y > 0.0 ? agreement / std::sqrt(untied_x * untied_y) : undefined;
}

}  // namespace dmrp::core
