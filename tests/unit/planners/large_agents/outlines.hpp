// SPDX-License-Identifier: MIT
// Whether the outlines of two robots overlap during a step, by moving them in small pieces of time. Shares no code with
// the planners or the host.
#pragma once

#include <cmath>
#include <vector>

#include "tests/support/outline_overlap.hpp"
#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

// The outlines that a robot may have while it goes from one cell to another: its polygon heading ahead or back, or,
// where it stands, the circle around it.
inline std::vector<Outline> outlines_of(const CaseRobot& robot, CellXY from, CellXY to) {
  if (robot.outline.empty() || from == to) return {{robot.radius_m, {}}};
  const double c = to.x - from.x;
  const double s = to.y - from.y;
  Outline ahead{robot.radius_m, {}};
  Outline back{robot.radius_m, {}};
  for (const dmrp_vec2 p : robot.outline) {
    ahead.corners.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
    back.corners.push_back({-c * p.x + s * p.y, -s * p.x - c * p.y});
  }
  return {ahead, back};
}

// The greatest depth of an overlap during a step, both ends included, at which the robots may have any heading.
inline double deepest_overlap(const CaseRobot& a, CellXY a0, CellXY a1, const CaseRobot& b, CellXY b0, CellXY b1) {
  constexpr int pieces = 100;
  const auto between = [](CellXY from, CellXY to, double share) {
    return dmrp_vec2{PlanningCase::resolution_m * (from.x + share * (to.x - from.x)),
                     PlanningCase::resolution_m * (from.y + share * (to.y - from.y))};
  };
  double deepest = -1e9;
  for (const double end : {0.0, 1.0})
    deepest = std::max(deepest,
                       overlap_depth({a.radius_m, {}}, between(a0, a1, end), {b.radius_m, {}}, between(b0, b1, end)));
  for (int i = 0; i <= pieces; ++i)
    for (const Outline& of_a : outlines_of(a, a0, a1))
      for (const Outline& of_b : outlines_of(b, b0, b1)) {
        const double share = static_cast<double>(i) / pieces;
        deepest = std::max(deepest, overlap_depth(of_a, between(a0, a1, share), of_b, between(b0, b1, share)));
      }
  return deepest;
}

// The same as a yes or no, for the robots of a case with at most `side` columns and rows; remembers what it has found.
class StepOverlap {
 public:
  explicit StepOverlap(const PlanningCase& c)
      : case_(c), known_(c.robots.size() * c.robots.size() * (2 * side + 1) * (2 * side + 1) * 25, -1) {}

  bool operator()(std::size_t a, CellXY a0, CellXY a1, std::size_t b, CellXY b0, CellXY b1) {
    const auto way = [](CellXY from, CellXY to) { return 2 + (to.x - from.x) + 2 * (to.y - from.y); };  // 0 to 4
    auto index = static_cast<int>(a * case_.robots.size() + b);
    index = index * (2 * side + 1) + b0.x - a0.x + side;
    index = index * (2 * side + 1) + b0.y - a0.y + side;
    signed char& known = known_[static_cast<std::size_t>((index * 5 + way(a0, a1)) * 5 + way(b0, b1))];
    if (known < 0) known = deepest_overlap(case_.robots[a], a0, a1, case_.robots[b], b0, b1) > 1e-6;
    return known > 0;
  }

 private:
  static constexpr int side = 12;
  const PlanningCase& case_;
  std::vector<signed char> known_;
};

}  // namespace dmrp::test
