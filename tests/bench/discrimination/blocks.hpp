// SPDX-License-Identifier: MIT
// blocks.hpp: how much of what varies do the entries of a comparison explain, when all of them met the same tasks.
#pragma once

#include <span>
#include <vector>

#include "core/statistics/descriptive.hpp"

namespace dmrp::bench {

// Analysis of variance of entries in tasks, one value each (a randomised block design). Partial eta squared is
// SS_entries / (SS_entries + SS_rest), once the differences between tasks are taken out; its 95 % interval inverts the
// noncentral F distribution (Steiger: Beyond the F test, Psychological Methods 9, 2004): eta2 = L / (L + df1 + df2 + 1).
// NaN with fewer than two entries or tasks, or if nothing varies within tasks.
struct BlockEffect {
  double partial_eta_squared;
  core::Interval interval;
  double f;
  double df_entries;
  double df_rest;
};
BlockEffect block_effect(std::span<const std::vector<double>> by_entry);  // [entry][task]

// Two factors in tasks, all their levels crossed: the interaction's partial eta squared, SS_interaction /
// (SS_interaction + SS_rest). The rest is what varies within tasks once each cell has its mean. NaN as above, or with
// fewer than two levels of a factor.
BlockEffect interaction_effect(std::span<const std::vector<std::vector<double>>> table);  // [first][second][task]

// The interval of the noncentrality for an observed F; its lower end is 0 where no noncentrality is so unlikely.
core::Interval noncentrality_interval(double f, double df_entries, double df_rest);

// Kendall's tau-b, with ties: 1 for the same order, -1 for the reverse. NaN if one of the lists is all ties.
double kendall_tau(std::span<const double> x, std::span<const double> y);

}  // namespace dmrp::bench
