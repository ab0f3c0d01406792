// SPDX-License-Identifier: MIT
#include "metrics/outcome/spl.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/thresholds.hpp"
#include "metrics/outcome/shortest_way.hpp"

namespace dmrp::metrics {
namespace {

// The size of the walking grid's cells.
constexpr double cell_m = 0.25;

const std::vector<double> least_times = {1.5, 2.0, 3.0};

bool succeeded(const RobotEnd& end) {
  return end.arrival_ns >= 0 && end.failure == DMRP_FAILURE_NONE;
}

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
      .value("success_at", "1", Direction::higher_is_better, Subjects::system,
             "share of robots that succeed within 1.5, 2 and 3 times their least time, shortest_length at v_max")
      .curve()
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
    const double longer_m = std::max(driven_.of_robot(robot), shortest_m.back());
    const double ratio = longer_m == 0.0 ? 1.0 : shortest_m.back() / longer_m;
    spl.push_back(succeeded(end.robots[robot]) ? ratio : 0.0);
  }
  give_mean(sink, "spl", spl);
  give(sink, "shortest_length", shortest_m, &sum_of_defined);
  give_curve(sink, "success_at", least_times, [&](double multiple) {
    std::vector<double> in_time;
    for (std::size_t robot = 0; robot < shortest_m.size(); ++robot) {
      const double limit_s = multiple * shortest_m[robot] / world().robots()[robot].limits->v_max;
      const bool arrives = succeeded(end.robots[robot]) && in_seconds(end.robots[robot].arrival_ns) <= limit_s;
      in_time.push_back(std::isnan(limit_s) ? undefined : arrives ? 1.0 : 0.0);
    }
    return mean_of_defined(in_time);
  });
}

}  // namespace dmrp::metrics
