// SPDX-License-Identifier: MIT
#include "metrics/outcome/spl.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/outcome/shortest_way.hpp"

namespace dmrp::metrics {

Descriptor Spl::describe() {
  return describe_metric("dmrp.metric.spl", "SPL")
      .summary("success weighted by how near the way driven is to the shortest one")
      .source("Anderson et al., On Evaluation of Embodied Navigation Agents, arXiv:1807.06757, 2018: SPL")
      .value(
          "spl", "1", Direction::higher_is_better, Subjects::system_and_robots,
          "S l / max(p, l): S as success, l = shortest_length, p = path_length; 0 without success; system: (1/N) sum "
          "over robots")
      .value("shortest_length", "m", Direction::none, Subjects::system_and_robots,
             "l: the shortest way of the robot's disc from its start through its goals past the static shapes, no "
             "other robot there (any-angle search on the walking grid's clearance, within about 1 %); system: sum over "
             "robots; undefined where there is no way");
}

void Spl::begin(const dmrp_plan*) {
  driven_m_.assign(world().robots().size(), {});
  last_position_.clear();
}

void Spl::observe(const Sample& sample) {
  if (last_position_.empty())
    for (const RobotSample& robot : sample.robots) last_position_.push_back(toolkit::position(robot.pose));
  for (std::size_t robot = 0; robot < driven_m_.size(); ++robot) {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    driven_m_[robot].add(toolkit::distance(last_position_[robot], position));
    last_position_[robot] = position;
  }
}

void Spl::finish(const TrialEnd& end, MetricSink& sink) {
  ShortestWay search(world().walking_grid());
  std::vector<double> spl, shortest_m;
  for (std::size_t robot = 0; robot < driven_m_.size(); ++robot) {
    shortest_m.push_back(search.tour_length(world().robots()[robot]));
    const bool succeeded = end.robots[robot].arrival_ns >= 0 && end.robots[robot].failure == DMRP_FAILURE_NONE;
    const double longer_m = std::max(driven_m_[robot].value(), shortest_m.back());
    const double ratio = longer_m == 0.0 ? 1.0 : shortest_m.back() / longer_m;
    spl.push_back(succeeded ? ratio : 0.0);
  }
  give_mean(sink, "spl", spl);
  give(sink, "shortest_length", shortest_m, &sum_of_defined);
}

}  // namespace dmrp::metrics
