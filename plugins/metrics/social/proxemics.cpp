// SPDX-License-Identifier: MIT
#include "metrics/social/proxemics.hpp"

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/surface_distance.hpp"

namespace dmrp::metrics {
namespace {

// Hall's zones, m.
constexpr double intimate_m = 0.45;
constexpr double personal_m = 1.2;
constexpr double social_m = 3.6;

}  // namespace

Descriptor Proxemics::describe() {
  const auto lower = Direction::lower_is_better;
  const auto robots = Subjects::system_and_robots;
  return describe_metric("dmrp.metric.proxemics", "Proxemics")
      .summary("shares of time in people's intimate, personal and social space")
      .source(
          "zones: Hall, The Hidden Dimension, 1966; surface distances as in HuNavSim, Perez-Higueras et al., "
          "RA-L 2023")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("proxemics_intimate", "%", lower, robots,
             "share of active time with people present in which the surface distance d to the nearest one is <= 0.45 "
             "m; undefined without people")
      .value("proxemics_personal", "%", lower, robots, "the same with 0.45 m < d <= 1.2 m; undefined without people")
      .value("proxemics_social", "%", Direction::none, robots,
             "the same with 1.2 m < d <= 3.6 m; undefined without people");
}

void Proxemics::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  shares_.assign(world().robots().size(), {});
}

void Proxemics::observe(const Sample& sample) {
  active_.observe(sample);
  if (sample.people.empty()) return;
  for (std::size_t robot = 0; robot < shares_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    const Outline own = outline_of(world().robots()[robot], sample.robots[robot]);
    NearestBody nearest(own);
    for (const Person& person : sample.people) nearest.add(outline_of(person));
    const double nearest_m = nearest.distance_m();
    Shares& shares = shares_[robot];
    shares.intimate.add(nearest_m <= intimate_m, sample.dt_ns);
    shares.personal.add(nearest_m > intimate_m && nearest_m <= personal_m, sample.dt_ns);
    shares.social.add(nearest_m > personal_m && nearest_m <= social_m, sample.dt_ns);
  }
}

void Proxemics::finish(const TrialEnd&, MetricSink& sink) {
  const auto give_share = [&](const char* name, TimeShare Shares::*share) {
    give_mean(sink, name, values_of(shares_, [&](const Shares& shares) { return (shares.*share).percent(); }));
  };
  give_share("proxemics_intimate", &Shares::intimate);
  give_share("proxemics_personal", &Shares::personal);
  give_share("proxemics_social", &Shares::social);
}

}  // namespace dmrp::metrics
