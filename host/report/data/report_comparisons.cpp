// SPDX-License-Identifier: MIT
#include "host/report/data/report_comparisons.hpp"

#include <algorithm>
#include <map>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "core/statistics/sign_flip.hpp"
#include "core/statistics/signed_rank.hpp"
#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

using BySeed = std::map<std::uint64_t, double>;  // a combination's values

std::string& label_of(CombinationLabels& labels, Varied varied) {
  switch (varied) {
    case Varied::global_planner:
      return labels.global_planner;
    case Varied::local_controller:
      return labels.local_controller;
    default:
      return labels.pedestrian_model;
  }
}

bool differ_only_in(Varied varied, CombinationLabels a, CombinationLabels b) {
  if (label_of(a, varied) == label_of(b, varied)) return false;
  label_of(a, varied) = label_of(b, varied);
  return a == b;
}

std::vector<BySeed> values_by_seed(const ReportFrame& frame, const ExperimentFacts& facts, const CountedValue& rule) {
  std::vector<BySeed> values(frame.combinations.size());
  for (std::size_t trial = 0; trial < frame.trials.size(); ++trial)
    if (const auto value = counted_value(frame, facts, rule, trial))
      values[frame.combination_of[trial]][frame.trials[trial].seed] = *value;
  return values;
}

std::vector<double> differences(const BySeed& a, const BySeed& b) {
  std::vector<double> found;
  for (const auto& [seed, value] : a)
    if (const auto other = b.find(seed); other != b.end()) found.push_back(other->second - value);
  return found;
}

core::Interval interval_of_mean(const std::vector<double>& values, std::map<std::size_t, core::BootstrapDraws>& draws) {
  std::vector<std::vector<double>> clusters;
  for (const double value : values) clusters.push_back({value});
  return core::cluster_bootstrap_interval(clusters, draws.try_emplace(values.size(), values.size()).first->second);
}

PairedComparison compare(std::span<const double> differences, const core::Interval& mean_interval, PairedTest test) {
  const core::SignedRankTest ranks = core::signed_rank_test(differences);
  const core::HodgesLehmann shift = core::hodges_lehmann(differences);
  PairedComparison result{};
  result.pairs = ranks.pairs;
  result.ties = ranks.zeros;
  result.median_difference = shift.estimate;
  result.median_interval = shift.interval;
  result.mean_difference = core::mean(differences);
  result.mean_interval = mean_interval;
  result.effect = ranks.rank_biserial;
  result.test = test;
  result.exact = ranks.exact;
  result.p = ranks.p;
  if (test == PairedTest::sign_flip) {
    const core::SignFlipTest flips = core::sign_flip_test(differences);
    result.exact = flips.exact;
    result.p = flips.p;
  }
  return result;
}

bool same_family(const ReportFrame& frame, const PairedComparison& one, const PairedComparison& other) {
  const CombinationLabels& labels = frame.combinations[one.a];
  const CombinationLabels& other_labels = frame.combinations[other.a];
  return one.metric == other.metric && one.varied == other.varied && labels.scenario == other_labels.scenario &&
         labels.robots == other_labels.robots;
}

void adjust(const ReportFrame& frame, std::vector<PairedComparison>& comparisons) {
  std::vector<char> adjusted(comparisons.size(), false);
  for (std::size_t first = 0; first < comparisons.size(); ++first) {
    if (adjusted[first]) continue;
    std::vector<std::size_t> family;
    std::vector<double> p_values;
    for (std::size_t i = first; i < comparisons.size(); ++i) {
      if (!same_family(frame, comparisons[first], comparisons[i])) continue;
      family.push_back(i);
      p_values.push_back(comparisons[i].p);
      adjusted[i] = true;
    }
    const std::vector<double> p_holm = core::holm_adjusted(p_values);
    for (std::size_t i = 0; i < family.size(); ++i) comparisons[family[i]].p_holm = p_holm[i];
  }
}

}  // namespace

std::vector<PairedComparison> paired_comparisons(const ReportFrame& frame, const ExperimentFacts& facts,
                                                 const ReportLayout& layout,
                                                 std::span<const std::string> counts_failures) {
  std::vector<PairedComparison> comparisons;
  std::map<std::size_t, core::BootstrapDraws> draws;  // by number of pairs
  for (const ComparedMetric& compared : layout.comparisons) {
    const std::optional<std::size_t> metric = frame.metric(compared.metric);
    if (!metric) continue;
    const bool counts =
        std::find(counts_failures.begin(), counts_failures.end(), compared.metric) != counts_failures.end();
    const std::vector<BySeed> values =
        values_by_seed(frame, facts, {*metric, counts, compared.censored, compared.both_succeeded});
    for (const Varied varied : {Varied::global_planner, Varied::local_controller, Varied::pedestrian_model})
      for (std::size_t a = 0; a < values.size(); ++a)
        for (std::size_t b = a + 1; b < values.size(); ++b) {
          if (!differ_only_in(varied, frame.combinations[a], frame.combinations[b])) continue;
          const std::vector<double> found = differences(values[a], values[b]);
          if (found.empty()) continue;
          PairedComparison& comparison =
              comparisons.emplace_back(compare(found, interval_of_mean(found, draws), compared.test));
          comparison.metric = *metric;
          comparison.varied = varied;
          comparison.a = a;
          comparison.b = b;
        }
  }
  adjust(frame, comparisons);
  return comparisons;
}

}  // namespace dmrp::host
