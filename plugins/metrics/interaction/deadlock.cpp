// SPDX-License-Identifier: MIT
#include "metrics/interaction/deadlock.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <string>
#include <tuple>

#include "metrics/measure/bodies.hpp"
#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/time_span.hpp"
#include "metrics/measure/way_ahead.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

// The arc length at which the way first comes within reach_m of a point; infinity if it never does.
double first_within(const std::vector<Vec2>& way, Vec2 point, double reach_m) {
  double arc_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec2 apart = way[i - 1] - point;
    const double gap = toolkit::squared_norm(apart) - reach_m * reach_m;
    if (gap <= 0.0) return arc_m;
    const double length_m = toolkit::distance(way[i - 1], way[i]);
    const Vec2 along = toolkit::normalized(way[i] - way[i - 1]);
    const double approach_m = -toolkit::dot(apart, along);
    const double discriminant = approach_m * approach_m - gap;
    if (approach_m > 0.0 && discriminant >= 0.0) {
      const double entry_m = approach_m - std::sqrt(discriminant);
      if (entry_m <= length_m) return arc_m + entry_m;
    }
    arc_m += length_m;
  }
  return std::numeric_limits<double>::infinity();
}

// The cycles of a graph with at most one edge from each node. Each begins with its lowest index; ordered by that.
std::vector<std::vector<std::uint32_t>> find_cycles(const std::vector<std::uint32_t>& waits_for) {
  std::vector<std::vector<std::uint32_t>> cycles;
  std::vector<std::uint32_t> seen_from(waits_for.size(), nobody);
  for (std::uint32_t first = 0; first < waits_for.size(); ++first) {
    std::uint32_t at = first;
    while (at != nobody && seen_from[at] == nobody) {
      seen_from[at] = first;
      at = waits_for[at];
    }
    if (at == nobody || seen_from[at] != first) continue;
    // `at` lies on a new cycle
    std::vector<std::uint32_t> cycle = {at};
    for (std::uint32_t next = waits_for[at]; next != at; next = waits_for[next]) cycle.push_back(next);
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    cycles.push_back(cycle);
  }
  return cycles;
}

}  // namespace

Descriptor Deadlock::describe() {
  return describe_metric("dmrp.metric.deadlock", "Deadlock")
      .summary("robots that wait for each other in a lasting cycle")
      .source("own definition; cycles of the wait-for graph as in Coffman et al., System Deadlocks, 1971")
      .value("deadlocks", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of cycles of waiting robots that last at least lasting_s; an active robot that progressed by less "
             "than progress_m in window_s waits for the first robot within margin_m of the strip that its body sweeps "
             "along look_ahead_m of its path; robot: its cycles; undefined if planning failed")
      .value("deadlock_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "length of the union of these cycles; robot: of its cycles; undefined if planning failed");
}

void Deadlock::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  progress_.assign(world().robots().size(), {});
  for (RecentProgress& progress : progress_) progress.begin(std::llround(window_s * 1e9));
  open_.clear();
  last_ns_ = -1;
  deadlocks_.clear();
}

void Deadlock::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < progress_.size(); ++robot) progress_[robot].observe(sample, sample.robots[robot]);

  std::map<Cycle, std::int64_t> now;
  for (const Cycle& cycle : find_cycles(wait_graph(sample))) {
    const auto before = open_.find(cycle);
    now[cycle] = before != open_.end() ? before->second : sample.t_ns - sample.dt_ns;
  }
  for (const auto& [cycle, from_ns] : open_)
    if (now.count(cycle) == 0) close(cycle, from_ns, last_ns_);
  open_.swap(now);
  last_ns_ = sample.t_ns;
}

std::vector<std::uint32_t> Deadlock::wait_graph(const Sample& sample) const {
  std::vector<std::uint32_t> waits_for(progress_.size(), nobody);
  for (std::uint32_t robot = 0; robot < progress_.size(); ++robot)
    if (sample.plan && active_.in_step(robot) && progress_[robot].stalls(progress_m))
      waits_for[robot] = first_in_way(sample, robot);
  return waits_for;
}

std::uint32_t Deadlock::first_in_way(const Sample& sample, std::uint32_t robot) const {
  const RobotSample& own = sample.robots[robot];
  const Disc body = disc_of(world().robots()[robot], own);
  const std::vector<Vec2> way = way_ahead(Plan(*sample.plan).path(robot), body.center, own.progress_m, look_ahead_m);
  std::uint32_t first = nobody;
  double first_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t other = 0; other < progress_.size(); ++other) {
    if (other == robot) continue;
    const Disc there = disc_of(world().robots()[other], sample.robots[other]);
    const double at_m = first_within(way, there.center, body.radius_m + there.radius_m + margin_m);
    if (at_m < first_m) {
      first = other;
      first_m = at_m;
    }
  }
  return first;
}

void Deadlock::close(const Cycle& cycle, std::int64_t from_ns, std::int64_t to_ns) {
  if (to_ns - from_ns >= std::llround(lasting_s * 1e9)) deadlocks_.push_back({from_ns, to_ns, cycle});
}

void Deadlock::finish(const TrialEnd&, MetricSink& sink) {
  for (const auto& [cycle, from_ns] : open_) close(cycle, from_ns, last_ns_);
  std::sort(deadlocks_.begin(), deadlocks_.end(),
            [](const Event& a, const Event& b) { return std::tie(a.from_ns, a.cycle) < std::tie(b.from_ns, b.cycle); });

  UnionLength all;
  std::vector<UnionLength> own(progress_.size());
  std::vector<double> counts(progress_.size(), 0.0), times_s;
  for (const Event& deadlock : deadlocks_) {
    all.add(deadlock.from_ns, deadlock.to_ns);
    std::vector<Subject> robots;
    std::string text = "robots ";
    for (const std::uint32_t robot : deadlock.cycle) {
      own[robot].add(deadlock.from_ns, deadlock.to_ns);
      ++counts[robot];
      robots.push_back(robot_subject(robot));
      text += std::to_string(robot) + " -> ";
    }
    text += std::to_string(deadlock.cycle.front()) + " wait for each other";
    sink.event({"deadlocks", deadlock.from_ns, deadlock.to_ns, robots, text});
  }
  const bool measured = last_ns_ >= 0 && !progress_.empty();
  for (std::size_t robot = 0; robot < own.size(); ++robot) {
    if (!measured) counts[robot] = undefined;
    times_s.push_back(measured ? in_seconds(own[robot].value_ns()) : undefined);
    sink.robot("deadlocks", robot, counts[robot]);
    sink.robot("deadlock_time", robot, times_s[robot]);
  }
  sink.system("deadlocks", measured ? static_cast<double>(deadlocks_.size()) : undefined);
  sink.system("deadlock_time", measured ? in_seconds(all.value_ns()) : undefined);
}

}  // namespace dmrp::metrics
