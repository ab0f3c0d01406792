// SPDX-License-Identifier: MIT
// clearance.hpp: distances of robots to walls, robots and people, and the share of time below a safe distance.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/nearest_bodies.hpp"
#include "metrics/measure/nearest_wall.hpp"

namespace dmrp::metrics {

// Distances of one robot to one kind of neighbour.
struct ClearanceTo {
  double least_m = undefined;
  TimeMoments mean_m;

  void add(double distance_m, std::int64_t duration_ns) {
    least_m = std::fmin(least_m, distance_m);
    mean_m.add(distance_m, duration_ns);
  }
};

struct ClearanceOfRobot {
  NearestWall wall;
  NearestInTime robot, person;
  ClearanceTo walls, robots, people;
  TimeCount danger, danger_of_robots, danger_of_people;
};

class Clearance final : public ActiveTimeMetric<ClearanceOfRobot> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.clearance", "Clearance")
        .summary("surface distances to walls, robots and people, and the time below a safe distance")
        .source("Wen et al., MRPB 1.0, ICRA 2021: distance to obstacles, time in the dangerous area")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("clearance_static_min", "m", higher_is_better, system_and_robots,
               "minimum over active time of the surface distance to the nearest shape or border; system: minimum over "
               "robots; undefined if planning failed")
        .value("clearance_static_mean", "m", higher_is_better, system_and_robots,
               "mean over active time of the same distance; undefined if planning failed")
        .value("clearance_robot_min", "m", higher_is_better, system_and_robots,
               "minimum over active time of the surface distance to the nearest other robot, including parked ones; "
               "system: minimum over robots; undefined without another robot")
        .value("clearance_robot_mean", "m", higher_is_better, system_and_robots,
               "mean over active time of the same distance; undefined without another robot")
        .value("clearance_person_min", "m", higher_is_better, system_and_robots,
               "minimum over active time of the surface distance to the nearest person; system: minimum over robots; "
               "undefined without people")
        .value("clearance_person_mean", "m", higher_is_better, system_and_robots,
               "mean over active time with people present of the same distance; undefined without people")
        .value("danger_time", "%", lower_is_better, system_and_robots,
               "share of active time in which any of the three distances is below safe_distance_m; undefined if "
               "planning failed",
               percent_range)
        .value("danger_time_robot", "%", lower_is_better, system_and_robots,
               "share of active time in which the nearest robot is closer than safe_distance_m; undefined without "
               "another robot",
               percent_range)
        .value("danger_time_person", "%", lower_is_better, system_and_robots,
               "share of active time with people present in which the nearest is closer than safe_distance_m; "
               "undefined without people",
               percent_range);
  }

  Param<double> safe_distance_m = param("safe_distance_m", 0.3)
                                      .unit("m")
                                      .range(0.0, 100.0)
                                      .doc("d_safe: surface distances below this count as danger");

  void begin(const MetricTrial& trial) override {
    ActiveTimeMetric::begin(trial);
    for (ClearanceOfRobot& own : states_) own.wall.begin(world());
  }

  void observe(const Sample& sample) override {
    robots_.observe_robots(world(), sample);
    people_.observe_people(sample);
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_distances(sink, "clearance_static_min", "clearance_static_mean", &ClearanceOfRobot::walls);
    give_distances(sink, "clearance_robot_min", "clearance_robot_mean", &ClearanceOfRobot::robots);
    give_distances(sink, "clearance_person_min", "clearance_person_mean", &ClearanceOfRobot::people);
    give_mean(sink, "danger_time", [](const ClearanceOfRobot& own) { return own.danger.percent(); });
    give_mean(sink, "danger_time_robot", [](const ClearanceOfRobot& own) { return own.danger_of_robots.percent(); });
    give_mean(sink, "danger_time_person", [](const ClearanceOfRobot& own) { return own.danger_of_people.percent(); });
  }

 private:
  void give_distances(MetricSink& sink, const char* least, const char* mean, ClearanceTo ClearanceOfRobot::*to) const {
    give_of_states(sink, least, &least_of_defined, [&](const ClearanceOfRobot& own) { return (own.*to).least_m; });
    give_mean(sink, mean, [&](const ClearanceOfRobot& own) { return (own.*to).mean_m.mean(); });
  }

  void add_step(ClearanceOfRobot& own, std::size_t robot, const Sample& sample) override {
    const Outline& body = robots_[robot];
    const double to_wall_m = body.parts.empty() ? own.wall.find(body.disc.center).distance_m - body.disc.radius_m
                                                : distance_to_walls(body, world());
    own.walls.add(to_wall_m, sample.dt_ns);
    bool danger = to_wall_m < safe_distance_m;

    const auto add = [&](double distance_m, ClearanceTo& to, TimeCount& share) {
      if (std::isnan(distance_m)) return;
      to.add(distance_m, sample.dt_ns);
      share.add(distance_m < safe_distance_m, sample.dt_ns);
      danger = danger || distance_m < safe_distance_m;
    };
    const double travelled_m = robots_.travelled_m();
    add(own.robot.distance_m(body, travelled_m, robots_, robot), own.robots, own.danger_of_robots);
    add(own.person.distance_m(body, travelled_m, people_), own.people, own.danger_of_people);
    own.danger.add(danger, sample.dt_ns);
  }

  OutlinesInTime robots_, people_;
};

}  // namespace dmrp::metrics
