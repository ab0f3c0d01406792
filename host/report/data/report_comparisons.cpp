// SPDX-License-Identifier: MIT
#include "host/report/data/report_comparisons.hpp"

#include <algorithm>
#include <cmath>

#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

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

PairedComparison compare(const JointFindings& joint, PairedTest test, const core::Bounds& bounds,
                         const core::Resampling& resampling) {
  const std::vector<double> differences = joint.differences(0, 1);
  std::vector<double> defined;
  for (const double one : differences)
    if (!std::isnan(one)) defined.push_back(one);
  const core::SignedRankTest ranks = core::signed_rank_test(defined);
  PairedComparison result{};
  result.pairs = joint.situations;
  result.ties = ranks.zeros;
  result.test = test;
  result.difference = paired_difference(differences, test, bounds, resampling);
  result.shift = core::hodges_lehmann(defined);
  result.effect = ranks.rank_biserial;
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
    std::vector<PairedDifference*> family;
    for (std::size_t i = first; i < comparisons.size(); ++i) {
      if (!same_family(frame, comparisons[first], comparisons[i])) continue;
      family.push_back(&comparisons[i].difference);
      adjusted[i] = true;
    }
    adjust_by_holm(family);
  }
}

}  // namespace

std::vector<PairedComparison> paired_comparisons(const ReportFrame& frame, const ExperimentFacts& facts,
                                                 const ReportLayout& layout,
                                                 std::span<const std::string> counts_failures) {
  const Findings findings = make_findings(frame.trials, frame.observations, [&](std::size_t trial) {
    const CombinationLabels& labels = frame.combinations[frame.combination_of[trial]];
    return Split{labels, {labels.scenario, labels.robots, "", "", ""}};
  });
  std::vector<PairedComparison> comparisons;
  for (const ComparedMetric& compared : layout.comparisons) {
    const std::optional<std::size_t> metric = frame.metric(compared.metric);
    if (!metric) continue;
    const bool counts =
        std::find(counts_failures.begin(), counts_failures.end(), compared.metric) != counts_failures.end();
    const CountedValue rule{*metric, counts, compared.censored, compared.both_succeeded};
    const JointValues values = means_of([&](std::size_t trial) { return counted_value(frame, facts, rule, trial); });
    for (const Varied varied : {Varied::global_planner, Varied::local_controller, Varied::pedestrian_model})
      for (std::size_t a = 0; a < findings.entries.size(); ++a)
        for (std::size_t b = a + 1; b < findings.entries.size(); ++b) {
          if (!differ_only_in(varied, findings.entries[a], findings.entries[b])) continue;
          const JointFindings joint = joint_findings(findings, frame.observations, std::vector{a, b}, values);
          if (joint.situations == 0) continue;
          PairedComparison& comparison = comparisons.emplace_back(
              compare(joint, compared.test, bounds_of_values(counts), frame.observations.resampling));
          comparison.metric = *metric;
          comparison.varied = varied;
          comparison.a = frame.combination(findings.entries[a]);
          comparison.b = frame.combination(findings.entries[b]);
        }
  }
  adjust(frame, comparisons);
  return comparisons;
}

}  // namespace dmrp::host
