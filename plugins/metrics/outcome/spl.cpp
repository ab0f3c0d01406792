// SPDX-License-Identifier: MIT
#include "metrics/outcome/spl.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/outcome/shortest_way.hpp"

namespace dmrp::metrics {
namespace {

// The size of the walking grid's cells.
constexpr double cell_m = 0.25;

}  // namespace

Descriptor Spl::describe() {
  return describe_metric("dmrp.metric.spl", "SPL")
      .summary("success weighted by the ratio of the shortest to the driven length")
      .source("Anderson et al., On Evaluation of Embodied Navigation Agents, arXiv:1807.06757, 2018: SPL")
      .value("spl", "1", Direction::higher_is_better, Subjects::system_and_robots,
             "S l / max(p, l): S as success, l = shortest_length, p = path_length; 0 without success")
      .value("shortest_length", "m", Direction::none, Subjects::system_and_robots,
             "l: the shortest way of the robot's disc from its start through its goals among the static shapes, within "
             "about 1 %; system: sum over robots; undefined if there is no way")
      .needs(DMRP_EXT_WALKING_GRID);
}

Status Spl::start(const Start&) {
  walking_grid_ = &extension<dmrp_walking_grid>();
  return Status::ok;
}

void Spl::begin(const dmrp_plan*) {
  driven_.begin(world().robots().size());
}

void Spl::observe(const Sample& sample) {
  driven_.observe(sample);
}

void Spl::finish(const TrialEnd& end, MetricSink& sink) {
  // only its clearance counts, which is the same for every radius
  const dmrp_walking_grid_request request = {sizeof(request), 0, cell_m, world()->person_radius_m};
  const Grid* grid = walking_grid_->grid(walking_grid_, &request);
  if (grid == nullptr) throw std::runtime_error("the host has no walking grid for this world");
  ShortestWay search(*grid);
  std::vector<double> spl, shortest_m;
  for (std::size_t robot = 0; robot < world().robots().size(); ++robot) {
    shortest_m.push_back(search.tour_length(world().robots()[robot]));
    const bool succeeded = end.robots[robot].arrival_ns >= 0 && end.robots[robot].failure == DMRP_FAILURE_NONE;
    const double longer_m = std::max(driven_.of_robot(robot), shortest_m.back());
    const double ratio = longer_m == 0.0 ? 1.0 : shortest_m.back() / longer_m;
    spl.push_back(succeeded ? ratio : 0.0);
  }
  give_mean(sink, "spl", spl);
  give(sink, "shortest_length", shortest_m, &sum_of_defined);
}

}  // namespace dmrp::metrics
