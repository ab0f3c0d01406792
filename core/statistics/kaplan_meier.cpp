// SPDX-License-Identifier: MIT
#include "core/statistics/kaplan_meier.hpp"

#include <algorithm>
#include <cstddef>

namespace dmrp::core {

std::vector<SurvivalStep> kaplan_meier(std::span<const TimeToEvent> cases) {
  std::vector<TimeToEvent> sorted(cases.begin(), cases.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::vector<SurvivalStep> steps;
  double share = 1.0;
  for (std::size_t begin = 0; begin < sorted.size();) {
    const auto watched = static_cast<double>(sorted.size() - begin);
    const double time = sorted[begin].time;
    double happened = 0.0;
    for (; begin < sorted.size() && sorted[begin].time == time; ++begin) happened += sorted[begin].happened ? 1.0 : 0.0;
    if (happened == 0.0) continue;
    share *= 1.0 - happened / watched;
    steps.push_back({time, share});
  }
  return steps;
}

}  // namespace dmrp::core
