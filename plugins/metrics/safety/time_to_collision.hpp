// SPDX-License-Identifier: MIT
// time_to_collision.hpp: the time until a robot would hit somebody if all kept their velocities.
#pragma once

#include <limits>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

struct TimesToCollision {
  double least_s = undefined;
  TimeCount low;
};

class TimeToCollision final : public ActiveTimeMetric<TimesToCollision> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.time_to_collision", "Time to collision")
        .summary("time until a robot would touch another robot or a person at constant velocities")
        .source(
            "Hayward, Near-miss determination through use of a scale of danger, 1972; as in SocNavBench, Biswas et al. "
            "2022, with the radii of both")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value(
            "ttc_min", "s", higher_is_better, system_and_robots,
            "minimum over active time and over robots and people of the smallest tau > 0 with |dp + dv tau| = r + r'; "
            "0 in contact; system: minimum over robots; undefined where the robot is never on a collision course",
            never_negative)
        .value("ttc_low_time", "%", lower_is_better, system_and_robots,
               "share of active time in which a time to collision is below threshold_s; undefined without another "
               "robot or person",
               percent_range);
  }

  Param<double> threshold_s =
      param("threshold_s", 1.5).unit("s").range(0.0, 1000.0).doc("a time to collision below this is a conflict");

  void observe(const Sample& sample) override {
    bodies_.clear();
    for (std::size_t robot = 0; robot < states_.size(); ++robot)
      bodies_.push_back(moving(world().robots()[robot], sample.robots[robot]));
    for (const Person& person : sample.people) bodies_.push_back(moving(person));
    fastest_ = widest_m_ = 0.0;
    for (const Moving& body : bodies_) {
      fastest_ = std::max(fastest_, toolkit::norm(body.velocity));
      widest_m_ = std::max(widest_m_, body.disc.radius_m);
    }
    grid_.build(bodies_.size(), std::max(near_m, cell_of_one_m()),
                [this](std::size_t body) { return bodies_[body].disc.center; });
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_of_states(sink, "ttc_min", &least_of_defined, &TimesToCollision::least_s);
    give_mean(sink, "ttc_low_time", [](const TimesToCollision& times) { return times.low.percent(); });
  }

 private:
  void add_step(TimesToCollision& times, std::size_t robot, const Sample& sample) override {
    if (bodies_.size() < 2) return;
    // later ones change neither value
    const double latest_s = std::isnan(times.least_s) ? std::numeric_limits<double>::infinity()
                                                      : std::max<double>(threshold_s, times.least_s);
    const double soonest_s = soonest_until(robot, latest_s);
    times.least_s = std::fmin(times.least_s, soonest_s);
    times.low.add(soonest_s < threshold_s, sample.dt_ns);
  }

  // The side of cells that would hold one body each, were they evenly spread.
  double cell_of_one_m() const {
    if (bodies_.empty()) return 0.0;
    Vec2 lower = bodies_.front().disc.center;
    Vec2 upper = lower;
    for (const Moving& body : bodies_) {
      lower = {std::min(lower.x, body.disc.center.x), std::min(lower.y, body.disc.center.y)};
      upper = {std::max(upper.x, body.disc.center.x), std::max(upper.y, body.disc.center.y)};
    }
    return std::max(upper.x - lower.x, upper.y - lower.y) / std::sqrt(static_cast<double>(bodies_.size()));
  }

  // The least time to a collision of the robot if that is at most latest_s; else that, a greater one or NaN.
  double soonest_until(std::size_t robot, double latest_s) const {
    const Moving& own = bodies_[robot];
    for (double horizon_s = std::max<double>(threshold_s, 1.0);; horizon_s *= 2.0) {
      const double until_s = std::min(horizon_s, latest_s);
      // A body that it meets by then is now within this distance of where the robot will be then: it comes no faster than
      // the fastest. Times are rounded by much less than a thousandth.
      const double reach_m = 1.001 * (own.disc.radius_m + widest_m_ + fastest_ * until_s);
      double soonest_s = undefined;
      const std::size_t visited =
          grid_.visit(own.disc.center + until_s * own.velocity, reach_m, [&](std::size_t other) {
            if (other != robot) soonest_s = std::fmin(soonest_s, time_to_contact(own, bodies_[other]));
          });
      if (soonest_s <= until_s || until_s == latest_s || visited == bodies_.size() || fastest_ == 0.0) return soonest_s;
    }
  }

  std::vector<Moving> bodies_;  // at the sample: robots, then people
  toolkit::NeighbourGrid grid_;
  double fastest_ = 0.0;   // of them all, m/s
  double widest_m_ = 0.0;  // radius of them all
};

}  // namespace dmrp::metrics
