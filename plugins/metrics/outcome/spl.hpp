// SPDX-License-Identifier: MIT
// spl.hpp: success weighted by path length.
#pragma once

#include "metrics/measure/driven_length.hpp"
#include "metrics/measure/values.hpp"
#include "metrics/outcome/shortest_way.hpp"

namespace dmrp::metrics {

class Spl final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.spl", "SPL")
        .summary("success weighted by the ratio of the shortest to the driven length")
        .source("Anderson et al., On Evaluation of Embodied Navigation Agents, arXiv:1807.06757, 2018: SPL")
        .value("spl", "1", higher_is_better, system_and_robots,
               "S l / max(p, l): S as success, l = shortest_length, p = path_length; 0 without success", share_range)
        .value("shortest_length", "m", Direction::none, system_and_robots,
               "l: the shortest way of the robot's disc from its start through its goals among the static shapes; "
               "system: sum over robots; undefined if there is no way",
               never_negative)
        .value("success_at", "1", higher_is_better, Subjects::system,
               "share of robots that succeed within 1.5, 2 and 3 times their least time, shortest_length at v_max",
               share_range)
        .curve();
  }

  void begin(const MetricTrial&) override { driven_.begin(world().robots().size()); }

  void observe(const Sample& sample) override { driven_.observe(sample); }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    tours_.begin(world());
    std::vector<double> spl, shortest_m;
    for (std::size_t robot = 0; robot < world().robots().size(); ++robot) {
      shortest_m.push_back(tours_.length_m(world().robots()[robot]));
      const double longer_m = std::max(driven_.of_robot(robot), shortest_m.back());
      const double ratio = longer_m == 0.0 ? 1.0 : shortest_m.back() / longer_m;
      spl.push_back(succeeded(end.robots[robot]) ? ratio : 0.0);
    }
    give(sink, "spl", &mean_of_defined, spl);
    give(sink, "shortest_length", &sum_of_defined, shortest_m);
    give_curve(sink, "success_at", {1.5, 2.0, 3.0}, [&](double multiple) {
      std::vector<double> in_time;
      for (std::size_t robot = 0; robot < shortest_m.size(); ++robot) {
        const double limit_s = multiple * shortest_m[robot] / world().robots()[robot].limits->v_max;
        const bool arrives = succeeded(end.robots[robot]) && in_seconds(end.robots[robot].arrival_ns) <= limit_s;
        in_time.push_back(std::isnan(limit_s) ? undefined : arrives ? 1.0 : 0.0);
      }
      return mean_of_defined(in_time);
    });
  }

 private:
  ShortestTours tours_;
  DrivenLength driven_;
};

}  // namespace dmrp::metrics
