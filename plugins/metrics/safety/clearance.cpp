// SPDX-License-Identifier: MIT
#include "metrics/safety/clearance.hpp"

#include <cmath>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/surface_distance.hpp"

namespace dmrp::metrics {

Descriptor Clearance::describe() {
  const auto higher = Direction::higher_is_better;
  const auto lower = Direction::lower_is_better;
  const auto robots = Subjects::system_and_robots;
  return describe_metric("dmrp.metric.clearance", "Clearance")
      .summary("surface distances to walls, robots and people, and the time below a safe distance")
      .source("Wen et al., MRPB 1.0, ICRA 2021: distance to obstacles, time in the dangerous area")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("clearance_static_min", "m", higher, robots,
             "minimum over active time of the surface distance to the nearest shape or border; system: minimum over "
             "robots; undefined if planning failed")
      .value("clearance_static_mean", "m", higher, robots,
             "mean over active time of the same distance; undefined if planning failed")
      .value("clearance_robot_min", "m", higher, robots,
             "minimum over active time of the surface distance to the nearest other robot, including parked ones; "
             "system: minimum over robots; undefined without another robot")
      .value("clearance_robot_mean", "m", higher, robots,
             "mean over active time of the same distance; undefined without another robot")
      .value("clearance_person_min", "m", higher, robots,
             "minimum over active time of the surface distance to the nearest person; system: minimum over robots; "
             "undefined without people")
      .value("clearance_person_mean", "m", higher, robots,
             "mean over active time with people present of the same distance; undefined without people")
      .value("danger_time", "%", lower, robots,
             "share of active time in which any of the three distances is below safe_distance_m; undefined if planning "
             "failed")
      .value("danger_time_robot", "%", lower, robots,
             "share of active time in which the nearest robot is closer than safe_distance_m; undefined without "
             "another robot")
      .value("danger_time_person", "%", lower, robots,
             "share of active time with people present in which the nearest is closer than safe_distance_m; undefined "
             "without people");
}

void Clearance::Distances::add(double distance_m, std::int64_t duration_ns) {
  least_m = std::fmin(least_m, distance_m);
  mean_m.add(distance_m, duration_ns);
}

void Clearance::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  distances_.assign(world().robots().size(), {});
  for (RobotDistances& distances : distances_) distances.wall.begin(world());
}

void Clearance::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < distances_.size(); ++robot)
    if (active_.in_step(robot)) measure(sample, robot);
}

void Clearance::measure(const Sample& sample, std::size_t robot) {
  RobotDistances& distances = distances_[robot];
  const Outline own = outline_of(world().robots()[robot], sample.robots[robot]);
  const double to_static_m = own.parts.empty() ? distances.wall.find(own.disc.center).distance_m - own.disc.radius_m
                                               : distance_to_walls(own, world());
  distances.to_static.add(to_static_m, sample.dt_ns);
  bool danger = to_static_m < safe_distance_m;

  NearestBody nearest_robot(own);
  for (std::size_t other = 0; other < distances_.size(); ++other)
    if (other != robot) nearest_robot.add(outline_of(world().robots()[other], sample.robots[other]));
  NearestBody nearest_person(own);
  for (const Person& person : sample.people) nearest_person.add(outline_of(person));

  const auto add = [&](double distance_m, Distances& to, TimeShare& share) {
    if (std::isnan(distance_m)) return;
    to.add(distance_m, sample.dt_ns);
    share.add(distance_m < safe_distance_m, sample.dt_ns);
    danger = danger || distance_m < safe_distance_m;
  };
  add(nearest_robot.distance_m(), distances.to_robots, distances.danger_robots);
  add(nearest_person.distance_m(), distances.to_people, distances.danger_people);
  distances.danger.add(danger, sample.dt_ns);
}

void Clearance::finish(const TrialEnd&, MetricSink& sink) {
  const auto give_distances = [&](const char* least, const char* mean, Distances RobotDistances::*to) {
    give(sink, least, values_of(distances_, [&](const RobotDistances& robot) { return (robot.*to).least_m; }),
         &least_of_defined);
    give_mean(sink, mean,
              values_of(distances_, [&](const RobotDistances& robot) { return (robot.*to).mean_m.mean(); }));
  };
  give_distances("clearance_static_min", "clearance_static_mean", &RobotDistances::to_static);
  give_distances("clearance_robot_min", "clearance_robot_mean", &RobotDistances::to_robots);
  give_distances("clearance_person_min", "clearance_person_mean", &RobotDistances::to_people);
  const auto give_share = [&](const char* name, TimeShare RobotDistances::*share) {
    give_mean(sink, name, values_of(distances_, [&](const RobotDistances& robot) { return (robot.*share).percent(); }));
  };
  give_share("danger_time", &RobotDistances::danger);
  give_share("danger_time_robot", &RobotDistances::danger_robots);
  give_share("danger_time_person", &RobotDistances::danger_people);
}

}  // namespace dmrp::metrics
