// SPDX-License-Identifier: MIT
// thresholds.hpp: a value as a curve over its threshold.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

// Reports value_at(threshold) for each distinct threshold in ascending order, or one undefined value if there are none.
template <class ValueAt>
void give_curve(MetricSink& sink, const char* name, std::vector<double> thresholds, ValueAt&& value_at) {
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  for (const double threshold : thresholds) sink.curve(name, threshold, value_at(threshold));
  if (thresholds.empty()) sink.system(name, undefined);
}

}  // namespace dmrp::metrics
