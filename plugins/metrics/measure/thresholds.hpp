// SPDX-License-Identifier: MIT
// thresholds.hpp: how a value depends on a threshold, as a curve.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

// `value_at(threshold)` over the threshold, rising, each once; undefined where there are no thresholds.
template <class ValueAt>
void give_curve(MetricSink& sink, const char* name, std::vector<double> thresholds, ValueAt&& value_at) {
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  for (const double threshold : thresholds) sink.curve(name, threshold, value_at(threshold));
  if (thresholds.empty()) sink.system(name, undefined);
}

}  // namespace dmrp::metrics
