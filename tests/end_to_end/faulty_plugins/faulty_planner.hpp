// SPDX-License-Identifier: MIT
// faulty_planner.hpp: returns a fixed plan for the world `crossing`, with one fault.
#pragma once

#include <limits>

#include "tests/end_to_end/faulty_plugins/misbehave.hpp"

namespace dmrp::test {

class FaultyPlanner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.planner.faulty", "Faulty planner", "1.0.0")
        .license("MIT")
        .connectivity(DMRP_CONNECTIVITY_4);
  }

  dmrp::Param<std::string> fault = param("fault", "none").doc("what is wrong with it");

  // Logs each call.
  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    log(dmrp::LogLevel::info, "plans");
    if (const dmrp::Status status = misbehave(fault); status != dmrp::Status::ok) return status;
    if (*fault == "no_solution") return dmrp::Status::no_solution;
    if (*fault == "timeout") return dmrp::Status::timeout;

    // eastward along y = 2.5 | southward along x = 3.5, after the other has passed
    std::vector<dmrp::Vec2> eastward = line({0.5, 2.5}, {1.0, 0.0}, 7);
    std::vector<dmrp::Vec2> southward = line({3.5, 5.5}, {0.0, -1.0}, 6);
    if (*fault != "conflict") southward.insert(southward.begin(), 2, southward.front());
    if (*fault == "restless") southward.insert(southward.begin(), calls_++, southward.front());
    if (*fault == "teleport") eastward.erase(eastward.begin() + 3);
    if (*fault == "wrong_start") eastward.erase(eastward.begin());
    if (*fault == "wrong_end") eastward.pop_back();
    if (*fault == "beside_centre") eastward[3].y += 0.1;
    if (*fault == "into_wall") eastward.insert(eastward.begin() + 1, {{1.5, 2.5}, {1.5, 3.5}});
    if (*fault == "nan") eastward[3].x = std::numeric_limits<double>::quiet_NaN();
    if (*fault == "wrong_cost") sink.statistic("cost", 12.0);
    sink.path(0, timed(eastward, problem));
    if (*fault == "path_twice") sink.path(0, timed(eastward, problem));
    if (*fault != "missing_path") sink.path(1, timed(southward, problem));
    return dmrp::Status::ok;
  }

 private:
  std::size_t calls_ = 0;  // in all trials

  static std::vector<dmrp::Vec2> line(dmrp::Vec2 from, dmrp::Vec2 step, int count) {
    std::vector<dmrp::Vec2> points;
    for (int i = 0; i < count; ++i) points.push_back({from.x + i * step.x, from.y + i * step.y});
    return points;
  }

  std::vector<dmrp::Waypoint> timed(const std::vector<dmrp::Vec2>& points, const dmrp::PlanningProblem& problem) const {
    std::vector<dmrp::Waypoint> path;
    std::int64_t t_ns = problem.effective_from_ns;
    for (const dmrp::Vec2& point : points) {
      path.push_back({point.x, point.y, std::numeric_limits<double>::quiet_NaN(), t_ns, 0, 0});
      if (*fault != "no_time") t_ns += problem.step_duration_ns;
    }
    return path;
  }
};

}  // namespace dmrp::test
