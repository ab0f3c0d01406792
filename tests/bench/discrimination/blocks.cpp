// SPDX-License-Identifier: MIT
#include "tests/bench/discrimination/blocks.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <cassert>
#include <cmath>

#include "core/statistics/descriptive.hpp"

namespace dmrp::bench {
namespace {

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

constexpr BlockEffect undefined_effect = {
    core::undefined, {core::undefined, core::undefined}, core::undefined, core::undefined, core::undefined};

std::vector<double> means_of(std::span<const std::vector<double>> rows) {
  std::vector<double> means;
  for (const std::vector<double>& row : rows) means.push_back(core::mean(row));
  return means;
}

// The sum of squares that is left once each row and each task has its mean; [row][task].
double rest_of(std::span<const std::vector<double>> rows) {
  const std::size_t tasks = rows.front().size();
  const std::vector<double> row_means = means_of(rows);
  const double all = core::mean(row_means);
  std::vector<double> task_means(tasks);
  for (const std::vector<double>& row : rows)
    for (std::size_t task = 0; task < tasks; ++task) task_means[task] += row[task] / static_cast<double>(rows.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t task = 0; task < tasks; ++task) {
      const double rest = rows[i][task] - row_means[i] - task_means[task] + all;
      sum += rest * rest;
    }
  return sum;
}

// From sums of squares and degrees of freedom.
BlockEffect effect_of(double of_entries, double of_rest, double df_entries, double df_rest) {
  constexpr double rounding = 1e-12;
  BlockEffect effect = undefined_effect;
  if (of_entries + of_rest < rounding) return effect;
  effect.df_entries = df_entries;
  effect.df_rest = df_rest;
  effect.partial_eta_squared = of_entries / (of_entries + of_rest);
  if (of_rest < rounding) {
    effect.interval = {1.0, 1.0};  // the limit
    return effect;
  }
  effect.f = (of_entries / df_entries) / (of_rest / df_rest);
  const core::Interval noncentrality = noncentrality_interval(effect.f, df_entries, df_rest);
  const auto share = [&](double l) { return l / (l + df_entries + df_rest + 1.0); };
  effect.interval = {share(noncentrality.low), share(noncentrality.high)};
  return effect;
}

template <class Rows>
bool have_equal_sizes(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return row.size() == rows.front().size(); });
}

}  // namespace

core::Interval noncentrality_interval(double f, double df_entries, double df_rest) {
  assert(f >= 0.0 && df_entries > 0.0 && df_rest > 0.0);
  return {noncentrality_at(f, df_entries, df_rest, 0.975), noncentrality_at(f, df_entries, df_rest, 0.025)};
}

BlockEffect block_effect(std::span<const std::vector<double>> by_entry) {
  assert(have_equal_sizes(by_entry));
  if (by_entry.size() < 2 || by_entry.front().size() < 2) return undefined_effect;
  const double df_entries = static_cast<double>(by_entry.size() - 1);
  const double tasks = static_cast<double>(by_entry.front().size());
  const std::vector<double> entry_means = means_of(by_entry);
  const double all = core::mean(entry_means);
  double of_entries = 0.0;
  for (const double one : entry_means) of_entries += tasks * (one - all) * (one - all);
  return effect_of(of_entries, rest_of(by_entry), df_entries, df_entries * (tasks - 1.0));
}

BlockEffect interaction_effect(std::span<const std::vector<std::vector<double>>> table) {
  assert(have_equal_sizes(table) &&
         std::all_of(table.begin(), table.end(), [](const auto& row) { return have_equal_sizes(row); }));
  if (table.size() < 2 || table.front().size() < 2 || table.front().front().size() < 2) return undefined_effect;
  const double tasks = static_cast<double>(table.front().front().size());
  std::vector<std::vector<double>> cells;
  std::vector<double> first_means;
  std::vector<double> second_means(table.front().size());
  for (const auto& of_first : table) {
    cells.insert(cells.end(), of_first.begin(), of_first.end());
    const std::vector<double> means = means_of(of_first);
    first_means.push_back(core::mean(means));
    for (std::size_t j = 0; j < means.size(); ++j) second_means[j] += means[j] / static_cast<double>(table.size());
  }
  const double all = core::mean(first_means);
  double of_interaction = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = 0; j < second_means.size(); ++j) {
      const double off = core::mean(table[i][j]) - first_means[i] - second_means[j] + all;
      of_interaction += tasks * off * off;
    }
  return effect_of(of_interaction, rest_of(cells), static_cast<double>((table.size() - 1) * (second_means.size() - 1)),
                   static_cast<double>(cells.size() - 1) * (tasks - 1.0));
}

double kendall_tau(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
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
  return untied_x > 0.0 && untied_y > 0.0 ? agreement / std::sqrt(untied_x * untied_y) : core::undefined;
}

}  // namespace dmrp::bench
