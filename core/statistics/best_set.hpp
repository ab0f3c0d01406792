// SPDX-License-Identifier: MIT
// best_set.hpp: a confidence set for the best of several entries, by criteria in a declared order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::core {

// `mean`: differences themselves are flipped; `ranks`: their signed ranks (signed_rank.hpp), for times, which have
// long tails.
enum class PairedScore { mean, ranks };

// Differences b - a of two entries by task; NaN where undefined. Antisymmetric.
using PairedDifferences = std::function<std::vector<double>(std::size_t a, std::size_t b)>;

// Takes the values [entry][task] of entries, and keeps a reference to them.
PairedDifferences differences_of(const std::vector<std::vector<double>>& values);

struct Criterion {
  PairedDifferences differences;
  bool higher_is_better = true;
  PairedScore score = PairedScore::mean;
  double margin = 0.0;  // a mean difference up to this much decides nothing: it excludes nobody, and is not inferior
  Bounds bounds;        // of the values, for non-inferiority
};

// Why an entry is not in the set.
struct Exclusion {
  std::size_t by = 0;         // the entry that is better
  std::size_t criterion = 0;  // in this one
  double p = 1.0;             // adjusted for all pairs of entries and all criteria
};

struct BestSet {
  std::vector<std::optional<Exclusion>> excluded;  // by entry; none: the best may be this one
  std::uint32_t observations = 0;                  // the most that any pair of entries shares
};

// An entry is excluded if another one is shown to be better in a criterion (by a mean of more than its margin), and not to
// be inferior in each criterion before it: a fixed sequence. Entries that a criterion excludes exclude nobody in later
// ones; never are all excluded. With 95 % confidence no exclusion is wrong, so that the best is in the set. Selection is
// inside: all pairs of entries are compared in all criteria, by the largest of their statistics when the signs of whole
// observations are flipped, the same for all pairs and criteria, with stepdown (Mogstad, Romano, Shaikh, Wilhelm:
// Inference for ranks, Review of Economic Studies 91, 2024; Romano, Wolf: Exact and approximate stepdown methods, JASA 100,
// 2005). Exact where the differences of entries that are equally good are symmetric (entries could change places within a
// task): all signs up to 12 observations, else 4,095 drawn ones and the observed. n observations give no p below 2^(1 - n);
// below six nobody is excluded.
BestSet best_set(std::size_t entries, std::span<const Criterion> criteria, const Resampling& resampling);

// Whether differences (of the entry minus the other, by task) show that the entry's mean is not worse by more than the
// margin: by Student's one-sided 95 % bound, of bounded values over n + 2 (mean_of_tasks.hpp), of unbounded ones from ten
// observations on.
// Equal in every observation: yes; n of them allow a difference by the rule of three, which may be larger than the margin.
bool non_inferior(std::span<const double> differences, const Criterion& criterion, const Resampling& resampling);

// The entries for which none is at least as good in all means and better in one. means: [criterion][entry]; NaN is the
// worst.
std::vector<bool> pareto_set(std::span<const std::vector<double>> means, const std::vector<bool>& higher_is_better);

}  // namespace dmrp::core
