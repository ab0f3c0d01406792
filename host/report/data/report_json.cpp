// SPDX-License-Identifier: MIT
#include "host/report/data/report_json.hpp"

#include <array>

namespace dmrp::host {

Json labels_json(const CombinationLabels& labels) {
  return {{"scenario", labels.scenario},
          {"robots", labels.robots},
          {"global_planner", labels.global_planner},
          {"local_controller", labels.local_controller},
          {"pedestrian_model", labels.pedestrian_model}};
}

Json metrics_json(std::span<const MetricColumn> metrics) {
  static constexpr std::array<const char*, 3> directions{"none", "lower", "higher"};  // by DMRP_DIRECTION_*
  Json json = Json::array();
  for (const MetricColumn& metric : metrics)
    json.push_back({{"name", metric.name},
                    {"unit", metric.unit},
                    {"direction", directions.at(metric.direction)},
                    {"wall_clock", metric.wall_clock},
                    {"description", metric.description}});
  return json;
}

Json scenarios_json(std::span<const ScenarioFacts> scenarios) {
  Json json = Json::array();
  for (const ScenarioFacts& scenario : scenarios)
    json.push_back({{"name", scenario.name},
                    {"robots", scenario.robots},
                    {"title", scenario.title},
                    {"description", scenario.description},
                    {"people", scenario.people},
                    {"time_limit_s", scenario.time_limit_s}});
  return json;
}

}  // namespace dmrp::host
