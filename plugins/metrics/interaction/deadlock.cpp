// SPDX-License-Identifier: MIT
#include "metrics/interaction/deadlock.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/time_span.hpp"

namespace dmrp::metrics {
namespace {

// The cycles of a graph with at most one edge from each node. Each begins with its lowest index; ordered by that.
std::vector<std::vector<std::uint32_t>> find_cycles(const std::vector<std::uint32_t>& waits_for) {
  std::vector<std::vector<std::uint32_t>> cycles;
  std::vector<std::uint32_t> seen_from(waits_for.size(), DMRP_NOBODY);
  for (std::uint32_t first = 0; first < waits_for.size(); ++first) {
    std::uint32_t at = first;
    while (at != DMRP_NOBODY && seen_from[at] == DMRP_NOBODY) {
      seen_from[at] = first;
      at = waits_for[at];
    }
    if (at == DMRP_NOBODY || seen_from[at] != first) continue;
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
      .value(
          "deadlocks", "1", Direction::lower_is_better, Subjects::system_and_robots,
          "number of cycles of robots, each held or blocked by the next one for the host's referee "
          "(dmrp/robot_event.h), that last at least lasting_s; robot: its cycles; undefined if planning failed, and in "
          "traces of hosts before the referee")
      .value("deadlock_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "length of the union of these cycles; robot: of its cycles; undefined as deadlocks");
}

void Deadlock::begin(const dmrp_plan*) {
  classes_.begin(world().robots().size());
  open_.clear();
  last_ns_ = -1;
  deadlocks_.clear();
}

void Deadlock::observe(const Sample& sample) {
  classes_.observe(sample);
  std::map<Cycle, std::int64_t> now;
  for (const Cycle& cycle : find_cycles(wait_graph())) {
    const auto before = open_.find(cycle);
    now[cycle] = before != open_.end() ? before->second : sample.t_ns - sample.dt_ns;
  }
  for (const auto& [cycle, from_ns] : open_)
    if (now.count(cycle) == 0) close(cycle, from_ns, last_ns_);
  open_.swap(now);
  last_ns_ = sample.t_ns;
}

std::vector<std::uint32_t> Deadlock::wait_graph() const {
  std::vector<std::uint32_t> waits_for(world().robots().size(), DMRP_NOBODY);
  for (std::size_t robot = 0; robot < waits_for.size(); ++robot) {
    const auto now = classes_.in_step(robot);
    const bool waits = now && (now->kind == DMRP_CLASS_HELD || now->kind == DMRP_CLASS_BLOCKED_ROBOT);
    if (waits && now->other < waits_for.size()) waits_for[robot] = now->other;
  }
  return waits_for;
}

void Deadlock::close(const Cycle& cycle, std::int64_t from_ns, std::int64_t to_ns) {
  if (to_ns - from_ns >= std::llround(lasting_s * 1e9)) deadlocks_.push_back({from_ns, to_ns, cycle});
}

void Deadlock::finish(const TrialEnd&, MetricSink& sink) {
  for (const auto& [cycle, from_ns] : open_) close(cycle, from_ns, last_ns_);
  std::sort(deadlocks_.begin(), deadlocks_.end(),
            [](const Event& a, const Event& b) { return std::tie(a.from_ns, a.cycle) < std::tie(b.from_ns, b.cycle); });

  UnionLength all;
  std::vector<UnionLength> own(world().robots().size());
  std::vector<double> counts(own.size(), 0.0), times_s;
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
  const bool measured = classes_.are_known();
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
