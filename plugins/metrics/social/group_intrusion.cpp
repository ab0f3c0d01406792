// SPDX-License-Identifier: MIT
#include "metrics/social/group_intrusion.hpp"

#include <algorithm>
#include <dmrp/toolkit/polygon.hpp>
#include <map>

#include "metrics/measure/bodies.hpp"
#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

// Andrew's monotone chain: counter-clockwise, without vertices on a side. One or two points if all are collinear.
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2 && toolkit::orientation(hull[hull.size() - 2], hull.back(), *point) <= 0.0)
        hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // the first point of the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

// 0 inside.
double distance_to_hull(const std::vector<Vec2>& hull, Vec2 point) {
  if (hull.size() < 3) return toolkit::distance(Segment{hull.front(), hull.back()}, point);
  return toolkit::distance(toolkit::PolygonView(hull), point);
}

}  // namespace

Descriptor GroupIntrusion::describe() {
  return describe_metric("dmrp.metric.group_intrusion", "Group intrusion")
      .summary("robots that cross between the members of a group")
      .source(
          "group intrusions as in HuNavSim, Perez-Higueras et al., RA-L 2023; a group's space as the hull of its "
          "members after Kendon, Conducting Interaction, 1990")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("group_intrusion_time", "%", Direction::lower_is_better, Subjects::system_and_robots,
             "share of active time with groups present in which the robot's disc intersects the convex hull of the "
             "centres of a group (of two: a segment); undefined without groups")
      .value(
          "group_intrusions", "1", Direction::lower_is_better, Subjects::system_and_robots,
          "number of times that the robot's disc began to intersect a group's hull; system: sum over robots; undefined "
          "without groups");
}

void GroupIntrusion::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  intrusions_.assign(world().robots().size(), {});
}

void GroupIntrusion::find_groups(const Sample& sample) {
  groups_.clear();
  std::map<std::uint32_t, std::vector<Vec2>> members;
  for (const Person& person : sample.people)
    if (person.group != 0) members[person.group].push_back(person.position);
  for (const auto& [id, positions] : members)
    if (positions.size() >= 2) groups_.push_back({id, convex_hull(positions)});
}

void GroupIntrusion::observe(const Sample& sample) {
  active_.observe(sample);
  find_groups(sample);
  for (std::size_t robot = 0; robot < intrusions_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    Intrusions& own = intrusions_[robot];
    const Disc body = disc_of(world().robots()[robot], sample.robots[robot]);
    std::vector<std::uint32_t> inside;
    for (const Group& group : groups_) {
      if (!(distance_to_hull(group.hull, body.center) < body.radius_m)) continue;
      inside.push_back(group.id);
      own.count += std::find(own.inside.begin(), own.inside.end(), group.id) == own.inside.end();
    }
    if (!groups_.empty()) own.share.add(!inside.empty(), sample.dt_ns);
    own.inside.swap(inside);
  }
}

void GroupIntrusion::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "group_intrusion_time",
            values_of(intrusions_, [](const Intrusions& own) { return own.share.percent(); }));
  give(sink, "group_intrusions",
       values_of(intrusions_,
                 [](const Intrusions& own) {
                   return std::isnan(own.share.percent()) ? undefined : static_cast<double>(own.count);
                 }),
       &sum_of_defined);
}

}  // namespace dmrp::metrics
