// SPDX-License-Identifier: MIT
// The conflicts of a plan, against a comparison of all pairs of robots in all steps.
#include "host/plans/plan_conflicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

namespace plan_conflicts_test {

using namespace dmrp::host;
using Cells = std::vector<PlanCell>;
using dmrp::toolkit::Stream;

// Robots without extent.
dmrp::core::StepOverlaps points(1.0, {});

PlanCell at(const Cells& cells, std::size_t step) {
  return cells[std::min(step, cells.size() - 1)];
}

const char* conflict(PlanCell a0, PlanCell a1, PlanCell b0, PlanCell b1) {
  const auto diagonal = [](PlanCell from, PlanCell to) { return from.column != to.column && from.row != to.row; };
  const auto passes = [&](PlanCell from, PlanCell to, PlanCell other) {
    return diagonal(from, to) && (other == PlanCell{from.column, to.row} || other == PlanCell{to.column, from.row});
  };
  if (a1 == b1) return "vertex";
  if (a0 == b1 && a1 == b0) return "swap";
  if (diagonal(a0, a1) && diagonal(b0, b1) && a0.column + a1.column == b0.column + b1.column &&
      a0.row + a1.row == b0.row + b1.row)
    return "crossing";
  return passes(a0, a1, b0) || passes(a0, a1, b1) || passes(b0, b1, a0) || passes(b0, b1, a1) ? "passing" : nullptr;
}

void note(PlanConflicts& found, const std::string& text) {
  if (found.count++ == 0) found.first = text;
}

PlanConflicts compare_all_steps(const std::vector<Cells>& cells) {
  PlanConflicts found;
  std::size_t makespan = 0;
  for (const Cells& path : cells) makespan = std::max(makespan, path.size());
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      if (at(cells[a], 0) == at(cells[b], 0)) note(found, fmt::format("robots {} and {} share a start", a, b));
      for (std::size_t step = 0; step + 1 < makespan; ++step)
        if (const char* kind =
                conflict(at(cells[a], step), at(cells[a], step + 1), at(cells[b], step), at(cells[b], step + 1)))
          note(found, fmt::format("{} conflict of robots {} and {} at step {}", kind, a, b, step + 1));
    }
  return found;
}

dmrp_vec2 position(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (t_ns >= path[i].t_ns) continue;
    const dmrp_waypoint& from = path[i - 1];
    const double share = static_cast<double>(t_ns - from.t_ns) / static_cast<double>(path[i].t_ns - from.t_ns);
    return {from.x + share * (path[i].x - from.x), from.y + share * (path[i].y - from.y)};
  }
  return {path.back().x, path.back().y};
}

PlanConflicts compare_all_discs(const PlannedPaths& paths, const std::vector<double>& radii_m) {
  PlanConflicts found;
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      std::vector<std::int64_t> times;
      for (const auto& w : paths[a]) times.push_back(w.t_ns);
      for (const auto& w : paths[b]) times.push_back(w.t_ns);
      std::sort(times.begin(), times.end());
      for (std::size_t i = 0; i < times.size(); ++i) {
        const std::int64_t to = i + 1 < times.size() ? times[i + 1] : times[i];
        const dmrp_vec2 a0 = position(paths[a], times[i]), a1 = position(paths[a], to);
        const dmrp_vec2 b0 = position(paths[b], times[i]), b1 = position(paths[b], to);
        const dmrp_vec2 offset{a0.x - b0.x, a0.y - b0.y};
        const dmrp_vec2 change{a1.x - a0.x - b1.x + b0.x, a1.y - a0.y - b1.y + b0.y};
        const double square = change.x * change.x + change.y * change.y;
        const double share =
            square > 0 ? std::clamp(-(offset.x * change.x + offset.y * change.y) / square, 0.0, 1.0) : 0.0;
        const double distance_m = std::hypot(offset.x + share * change.x, offset.y + share * change.y);
        if (distance_m < std::max(radii_m[a] + radii_m[b], 1e-3) - 1e-6)
          note(found, fmt::format("robots {} and {} come within {:.3f} m of each other at {:.2f} s", a, b, distance_m,
                                  static_cast<double>(times[i]) * 1e-9));
      }
    }
  return found;
}

// Robots that walk at random among few cells, each for its own number of steps.
std::vector<Cells> random_walks(std::uint64_t seed) {
  Stream random(seed, "walks");
  const bool diagonal = random.chance(0.5);
  const auto size = 2 + static_cast<std::int32_t>(random.below(12));
  std::vector<Cells> cells(1 + random.below(12));
  for (Cells& path : cells) {
    const auto draw = [&] { return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(size))); };
    path.push_back({draw(), draw()});
    for (std::uint64_t steps = random.below(9); steps > 0; --steps) {
      auto dx = static_cast<std::int32_t>(random.below(3)) - 1;
      const auto dy = static_cast<std::int32_t>(random.below(3)) - 1;
      if (!diagonal && dy != 0) dx = 0;
      path.push_back({std::clamp(path.back().column + dx, 0, size - 1), std::clamp(path.back().row + dy, 0, size - 1)});
    }
  }
  return cells;
}

// Discs with few or many waypoints, slow or fast, some of them at common times.
PlannedPaths random_discs(std::uint64_t seed, std::vector<double>& radii_m) {
  Stream random(seed, "discs");
  const double size_m = random.uniform(3.0, 40.0);
  PlannedPaths paths(1 + random.below(10));
  for (auto& path : paths) {
    radii_m.push_back(random.chance(0.2) ? 0.0 : random.uniform(0.1, 1.0));
    std::int64_t t_ns = 500'000'000;
    for (std::uint64_t count = 1 + random.below(8); count > 0; --count) {
      dmrp_waypoint w{};
      w.x = random.uniform(-size_m, size_m);
      w.y = random.uniform(-size_m, size_m);
      if (!path.empty() && random.chance(0.3)) w = path.back();
      w.t_ns = t_ns;
      path.push_back(w);
      t_ns += random.chance(0.5) ? 1'000'000'000 : 1 + static_cast<std::int64_t>(random.below(5'000'000'000));
    }
  }
  return paths;
}

TEST_CASE("conflicts of random walks are those that a comparison of all pairs finds") {
  std::uint64_t conflicts = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    const auto cells = random_walks(seed);
    const PlanConflicts expected = compare_all_steps(cells);
    const PlanConflicts found = find_step_conflicts(cells, points);
    REQUIRE(found.count == expected.count);
    REQUIRE(found.first == expected.first);
    conflicts += found.count;
  }
  CHECK(conflicts > 10'000);
}

TEST_CASE("overlaps of random discs are those that a comparison of all pairs finds") {
  std::uint64_t conflicts = 0;
  int without = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    std::vector<double> radii_m;
    const PlannedPaths paths = random_discs(seed, radii_m);
    const PlanConflicts expected = compare_all_discs(paths, radii_m);
    const PlanConflicts found = find_disc_conflicts(paths, radii_m);
    REQUIRE(found.count == expected.count);
    REQUIRE(found.first == expected.first);
    conflicts += found.count;
    without += found.count == 0;
  }
  CHECK(conflicts > 5'000);
  CHECK(without > 300);
}

TEST_CASE("points that meet are in conflict, and those that pass each other are not") {
  const auto way = [](dmrp_vec2 from, dmrp_vec2 to) {
    return std::vector<dmrp_waypoint>{{from.x, from.y, 0.0, 0, 0, 0}, {to.x, to.y, 0.0, 4'000'000'000, 0, 0}};
  };
  const auto conflicts = [&](dmrp_vec2 from, dmrp_vec2 to) {
    return find_disc_conflicts({way({0, 0}, {4, 0}), way(from, to)}, {0.0, 0.0}).count;
  };
  CHECK(conflicts({2, -2}, {2, 2}) == 1);         // they cross at 2 s
  CHECK(conflicts({4, 0}, {0, 0}) == 1);          // head-on
  CHECK(conflicts({2, -2.01}, {2, 1.99}) == 0);   // 1 cm later
  CHECK(conflicts({0, 0.002}, {4, 0.002}) == 0);  // side by side
}

TEST_CASE("plans without robots have no conflicts") {
  CHECK(find_step_conflicts({}, points).count == 0);
  CHECK(find_disc_conflicts({}, {}).count == 0);
}

}  // namespace plan_conflicts_test
