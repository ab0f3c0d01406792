// SPDX-License-Identifier: MIT
// proxemics.hpp: shares of time in people's intimate, personal and social space.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/surface_distance.hpp"

namespace dmrp::metrics {

struct ProxemicShares {
  TimeCount intimate, personal, social;
};

class Proxemics final : public ActiveTimeMetric<ProxemicShares> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.proxemics", "Proxemics")
        .summary("shares of time in people's intimate, personal and social space")
        .source(
            "zones: Hall, The Hidden Dimension, 1966; surface distances as in HuNavSim, Perez-Higueras et al., RA-L "
            "2023")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("proxemics_intimate", "%", lower_is_better, system_and_robots,
               "share of active time with people present in which the surface distance d to the nearest one is <= 0.45 "
               "m; undefined without people",
               percent_range)
        .value("proxemics_personal", "%", lower_is_better, system_and_robots,
               "the same with 0.45 m < d <= 1.2 m; undefined without people", percent_range)
        .value("proxemics_social", "%", Direction::none, system_and_robots,
               "the same with 1.2 m < d <= 3.6 m; undefined without people", percent_range);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "proxemics_intimate", [](const ProxemicShares& own) { return own.intimate.percent(); });
    give_mean(sink, "proxemics_personal", [](const ProxemicShares& own) { return own.personal.percent(); });
    give_mean(sink, "proxemics_social", [](const ProxemicShares& own) { return own.social.percent(); });
  }

 private:
  // Hall's zones, m.
  static constexpr double intimate_m = 0.45;
  static constexpr double personal_m = 1.2;
  static constexpr double social_m = 3.6;

  void add_step(ProxemicShares& shares, std::size_t robot, const Sample& sample) override {
    if (sample.people.empty()) return;
    const Outline own = outline_of(world().robots()[robot], sample.robots[robot]);
    NearestBody nearest(own);
    for (const Person& person : sample.people) nearest.add(outline_of(person));
    const double nearest_m = nearest.distance_m();
    shares.intimate.add(nearest_m <= intimate_m, sample.dt_ns);
    shares.personal.add(nearest_m > intimate_m && nearest_m <= personal_m, sample.dt_ns);
    shares.social.add(nearest_m > personal_m && nearest_m <= social_m, sample.dt_ns);
  }
};

}  // namespace dmrp::metrics
