// SPDX-License-Identifier: MIT
#include "metrics/interaction/person_standoff.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <string>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor PersonStandoff::describe() {
  return describe_metric("dmrp.metric.person_standoff", "Person stand-off")
      .summary("share of failed robots that stood before a person who stood before them")
      .source("own definition")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("person_standoff", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "of a robot that failed: 1 if it and a person who wants to walk were within distance_m of each other for "
             "lasting_s without moving by more than moved_m, else 0; undefined if it succeeded or planning failed; "
             "system: mean over failed robots");
}

void PersonStandoff::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  measured_.assign(world().robots().size(), false);
  open_.assign(world().robots().size(), {});
  standoffs_.assign(world().robots().size(), {});
}

bool PersonStandoff::continues(const Standing& standing, Vec2 robot, const Person& person) const {
  return standing.person == person.id && toolkit::distance(standing.robot_at, robot) <= moved_m &&
         toolkit::distance(standing.person_at, person.position) <= moved_m;
}

void PersonStandoff::close(std::size_t robot, const Standing& standing) {
  if (standing.to_ns - standing.from_ns >= std::llround(lasting_s * 1e9)) standoffs_[robot].push_back(standing);
}

void PersonStandoff::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < open_.size(); ++robot) {
    if (active_.in_step(robot)) measured_[robot] = true;
    std::vector<Standing> now;
    const Vec2 place = toolkit::position(sample.robots[robot].pose);
    for (const Person& person : sample.people) {
      if (!active_.at_instant(robot) || person.desired_speed <= 0.0 ||
          toolkit::distance(place, person.position) > distance_m)
        continue;
      const auto before = std::find_if(open_[robot].begin(), open_[robot].end(),
                                       [&](const Standing& one) { return continues(one, place, person); });
      now.push_back(before != open_[robot].end()
                        ? *before
                        : Standing{person.id, sample.t_ns, sample.t_ns, place, person.position});
      now.back().to_ns = sample.t_ns;
    }
    for (const Standing& before : open_[robot])
      if (std::none_of(now.begin(), now.end(), [&](const Standing& one) {
            return one.person == before.person && one.from_ns == before.from_ns;
          }))
        close(robot, before);
    open_[robot] = std::move(now);
  }
}

void PersonStandoff::finish(const TrialEnd& end, MetricSink& sink) {
  std::vector<double> values;
  for (std::size_t robot = 0; robot < open_.size(); ++robot) {
    for (const Standing& standing : open_[robot]) close(robot, standing);
    for (const Standing& standoff : standoffs_[robot])
      sink.event({"person_standoff",
                  standoff.from_ns,
                  standoff.to_ns,
                  {robot_subject(robot)},
                  "robot " + std::to_string(robot) + " and person " + std::to_string(standoff.person) +
                      " stand before each other"});
    const bool succeeded = end.robots[robot].arrival_ns >= 0 && end.robots[robot].failure == DMRP_FAILURE_NONE;
    const bool counts = measured_[robot] && !succeeded;
    values.push_back(!counts ? undefined : standoffs_[robot].empty() ? 0.0 : 1.0);
  }
  give_mean(sink, "person_standoff", values);
}

}  // namespace dmrp::metrics
