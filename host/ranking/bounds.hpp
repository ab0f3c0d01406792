// SPDX-License-Identifier: MIT
// bounds.hpp: where a controller stands between the two that an experiment names as bounds of what is possible: one that
// does no more than it must, and one that knows more than any can.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "host/findings/summary.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

// The labels of the controllers with `bound`; empty if there are none.
struct Bounds {
  std::string lower;
  std::string upper;
};
Bounds bounds_of(std::string_view effective_toml);

// (value - lower) / (upper - lower), each a mean over the same observations: 0 at the lower bound, 1 at the upper one. The
// interval is a 95 % bootstrap over observations. NaN where the upper bound is not told apart from the lower one as the
// better (paired, 5 %), and for the bounds themselves.
struct Place {
  double place = std::numeric_limits<double>::quiet_NaN();
  core::Interval interval{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  std::uint32_t observations = 0;  // tasks
};

// The values of the bounds and of a third in one observation.
struct BoundedValue {
  double lower;
  double upper;
  double value;
};

// `higher_is_better`: a share, else a time.
Place place_between(std::span<const BoundedValue> observations, bool higher_is_better);

// Appends the places of all combinations as columns to `metrics` and to the summaries of these: by the first share of the
// layout's answer, and by its time over the length of the shortest way (over robots that arrive with all three). Nothing
// if there are no bounds, or the values were not measured.
void add_places(const Bounds& bounds, const SummaryLayout& layout, std::span<const TrialRecord> trials,
                std::vector<MetricColumn>& metrics, std::vector<CombinationSummary>& summaries);

}  // namespace dmrp::host
