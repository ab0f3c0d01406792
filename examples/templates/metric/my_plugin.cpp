// SPDX-License-Identifier: MIT
// A complete metric: how fast robots drive while a person is near, and for how long; the closest approach is an event
// on the time line. Copy it, rename it, replace observe().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

class SpeedNearPeople final : public dmrp::Metric {
 public:
  // The id must stay the same in all versions. Begin it with a domain that you own; `dmrp.` is reserved.
  // Each value has a name that no other metric of the experiment has, a unit, the better direction, and its subjects.
  // channels() names the parts of the trace that the metric reads besides robots, plan and contacts.
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.my_plugin", "Speed near people", "0.1.0")
        .vendor("Example")
        .license("MIT")
        .summary("speed of robots while a person is near")
        .value("speed_near_people", "m/s", dmrp::Direction::lower_is_better, dmrp::Subjects::system_and_robots,
               "mean speed of a robot while a person is near; of the system: the mean over robots",
               dmrp::never_negative)
        .value("time_near_people", "s", dmrp::Direction::lower_is_better, dmrp::Subjects::system_and_robots,
               "time that a robot spends near a person; of the system: the sum over robots", dmrp::never_negative)
        .channels(DMRP_CHANNEL_PEOPLE);
  }

  // The keys that an experiment file may set under `params`.
  dmrp::Param<double> near_m =
      param("near", 1.2).unit("m").range(0.0, 100.0).doc("distance between the outlines of robot and person");

  // Metrics run over the trace after the trial, live and stored alike: begin(), observe() for each sample, finish().
  // The plan is nullptr if planning failed. Reset all state here: an instance measures many trials.
  void begin(const dmrp::MetricTrial&) override {
    encounters_.assign(world().robots().size(), {});
    closest_ = {};
  }

  // A sample stands for the step that ended with it; the first one, at t = 0, has no duration.
  void observe(const dmrp::Sample& sample) override {
    for (std::size_t i = 0; i < sample.robots.size(); ++i) {
      const dmrp::RobotSample& robot = sample.robots[i];
      if (robot.state != DMRP_ROBOT_ACTIVE || sample.people.empty()) continue;
      const double gap_m = gap_to_nearest_m(i, robot, sample);
      if (gap_m > near_m) continue;
      const double step_s = dmrp::seconds(sample.dt_ns);
      encounters_[i].time_s += step_s;
      encounters_[i].driven_m += std::hypot(robot.velocity.v_x, robot.velocity.v_y) * step_s;
    }
  }

  // Every declared name gets a value for the system, whatever happened; `undefined` where there is nothing to measure,
  // never 0.
  void finish(const dmrp::TrialEnd& /*end*/, dmrp::MetricSink& sink) override {
    double sum_of_speeds = 0.0;
    double time_s = 0.0;
    int near_somebody = 0;
    for (std::size_t i = 0; i < encounters_.size(); ++i) {
      const Encounters& robot = encounters_[i];
      const double speed = robot.time_s > 0.0 ? robot.driven_m / robot.time_s : dmrp::undefined;
      sink.robot("speed_near_people", i, speed);
      sink.robot("time_near_people", i, robot.time_s);
      time_s += robot.time_s;
      if (std::isnan(speed)) continue;
      sum_of_speeds += speed;
      ++near_somebody;
    }
    sink.system("speed_near_people", near_somebody > 0 ? sum_of_speeds / near_somebody : dmrp::undefined);
    sink.system("time_near_people", encounters_.empty() ? dmrp::undefined : time_s);
    if (closest_.gap_m <= near_m)
      sink.event({"closest_approach",
                  closest_.t_ns,
                  closest_.t_ns,
                  {dmrp::robot_subject(closest_.robot), dmrp::person_subject(closest_.person)},
                  "the smallest gap between a robot and a person in this trial",
                  closest_.place});
  }

 private:
  struct Encounters {
    double time_s = 0.0;
    double driven_m = 0.0;
  };
  struct Approach {
    double gap_m = std::numeric_limits<double>::infinity();
    std::int64_t t_ns = 0;
    std::size_t robot = 0;
    std::uint64_t person = 0;
    dmrp::Vec2 place = {0.0, 0.0};
  };

  // Also remembers the closest approach of the trial. The circle around a footprint stands for it.
  double gap_to_nearest_m(std::size_t index, const dmrp::RobotSample& robot, const dmrp::Sample& sample) {
    const dmrp::Vec2 at = toolkit::position(robot.pose);
    const double radius_m = world().robots()[index].footprint->radius_m;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const dmrp::Person& person : sample.people) {
      const double gap_m = toolkit::distance(at, person.position) - radius_m - person.radius_m;
      nearest_m = std::min(nearest_m, gap_m);
      if (gap_m < closest_.gap_m) closest_ = {gap_m, sample.t_ns, index, person.id, at};
    }
    return nearest_m;
  }

  std::vector<Encounters> encounters_;  // by robot
  Approach closest_;
};

}  // namespace

// All plugin classes of the library; once per library.
DMRP_PLUGINS(SpeedNearPeople)
