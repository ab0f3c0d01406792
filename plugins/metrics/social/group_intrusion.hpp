// SPDX-License-Identifier: MIT
// group_intrusion.hpp: duration and number of intrusions of robots into groups of people.
#pragma once

#include <dmrp/toolkit/polygon.hpp>
#include <map>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

struct GroupIntrusions {
  TimeCount share;
  int count = 0;
  std::vector<std::uint32_t> inside;  // ids of the groups that it intruded at the last sample
};

class GroupIntrusion final : public ActiveTimeMetric<GroupIntrusions> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.group_intrusion", "Group intrusion")
        .summary("robots that cross between the members of a group")
        .source(
            "group intrusions as in HuNavSim, Perez-Higueras et al., RA-L 2023; a group's space as the hull of its "
            "members after Kendon, Conducting Interaction, 1990")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("group_intrusion_time", "%", lower_is_better, system_and_robots,
               "share of active time with groups present in which the robot's disc intersects the convex hull of the "
               "centres of a group (of two: a segment); undefined without groups",
               percent_range)
        .value("group_intrusions", "1", lower_is_better, system_and_robots,
               "number of times that the robot's disc began to intersect a group's hull; system: sum over robots; "
               "undefined without groups",
               never_negative);
  }

  void observe(const Sample& sample) override {
    find_groups(sample);
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "group_intrusion_time", [](const GroupIntrusions& own) { return own.share.percent(); });
    give_of_states(sink, "group_intrusions", &sum_of_defined, [](const GroupIntrusions& own) {
      return std::isnan(own.share.percent()) ? undefined : static_cast<double>(own.count);
    });
  }

 private:
  // A group of at least two people: the convex hull of their centres, a segment if they are collinear.
  struct Group {
    std::uint32_t id;
    std::vector<Vec2> hull;
  };

  // Andrew's monotone chain: counter-clockwise, without vertices on a side. One or two points if all are collinear.
  static std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
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
  static double distance_to_hull(const std::vector<Vec2>& hull, Vec2 point) {
    if (hull.size() < 3) return toolkit::distance(Segment{hull.front(), hull.back()}, point);
    return toolkit::distance(toolkit::PolygonView(hull), point);
  }

  void find_groups(const Sample& sample) {
    groups_.clear();
    std::map<std::uint32_t, std::vector<Vec2>> members;
    for (const Person& person : sample.people)
      if (person.group != 0) members[person.group].push_back(person.position);
    for (const auto& [id, positions] : members)
      if (positions.size() >= 2) groups_.push_back({id, convex_hull(positions)});
  }

  void add_step(GroupIntrusions& own, std::size_t robot, const Sample& sample) override {
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

  std::vector<Group> groups_;  // at the current sample, by id
};

}  // namespace dmrp::metrics
