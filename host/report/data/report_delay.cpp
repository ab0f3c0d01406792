// SPDX-License-Identifier: MIT
#include "host/report/data/report_delay.hpp"

#include <map>

#include "host/ranking/measures.hpp"

namespace dmrp::host {

std::vector<PedestrianDelay> pedestrian_delays(const ReportFrame& frame, const SummaryLayout& layout) {
  const std::vector<std::optional<double>> delays = people_delays(layout, frame.trials);
  std::map<std::size_t, std::vector<std::size_t>> trials_of;  // a combination's with a delay
  for (std::size_t i = 0; i < delays.size(); ++i)
    if (delays[i]) trials_of[frame.combination_of[i]].push_back(i);
  std::vector<PedestrianDelay> found;
  for (const auto& [combination, trials] : trials_of)
    found.push_back({combination, static_cast<std::uint32_t>(trials.size()),
                     core::mean_of_tasks(task_means(frame.tasks, trials, [&](std::size_t i) { return delays[i]; }), {},
                                         frame.tasks.resampling)});
  return found;
}

}  // namespace dmrp::host
