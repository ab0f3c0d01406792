// SPDX-License-Identifier: MIT
// ORCA's parts: the linear programme against exhaustive search, half-planes against straight motion.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <optional>

#include "pedestrians/orca/wall_obstacles.hpp"
#include "reciprocal/linear_program.hpp"
#include "reciprocal/velocity_obstacle.hpp"

namespace orca_parts_test {

using namespace dmrp::pedestrians;
using namespace dmrp::reciprocal;
using dmrp::toolkit::cross;
using dmrp::toolkit::distance;
using dmrp::toolkit::dot;
using dmrp::toolkit::norm;
using dmrp::toolkit::squared_norm;
using dmrp::toolkit::Stream;

constexpr double max_speed = 1.5;

dmrp_vec2 in_disc(Stream& chance, double radius) {
  return radius * std::sqrt(chance.uniform()) * dmrp::toolkit::from_angle(chance.uniform(0.0, 6.28318));
}

// Half-planes whose borders pass the zero velocity at up to `furthest`, on either side.
std::vector<HalfPlane> random_planes(Stream& chance, std::size_t count, double nearest, double furthest) {
  std::vector<HalfPlane> planes;
  for (std::size_t i = 0; i < count; ++i) {
    const dmrp_vec2 normal = dmrp::toolkit::from_angle(chance.uniform(0.0, 6.28318));
    planes.push_back(half_plane(normal * -chance.uniform(nearest, furthest), normal));
  }
  return planes;
}

double greatest_violation(const std::vector<HalfPlane>& planes, std::size_t first, std::size_t end, dmrp_vec2 v) {
  double greatest = -100.0;
  for (std::size_t i = first; i < end; ++i) greatest = std::max(greatest, violation(planes[i], v));
  return greatest;
}

// The optimum is the wish, its projection on a border or on the circle, or a point where two of those meet.
std::optional<dmrp_vec2> nearest_by_exhaustion(const std::vector<HalfPlane>& planes, dmrp_vec2 wish) {
  std::vector<dmrp_vec2> candidates = {wish, dmrp::toolkit::normalized(wish) * max_speed};
  for (const HalfPlane& plane : planes) {
    const dmrp_vec2 d = plane.direction;
    candidates.push_back(plane.point + dot(wish - plane.point, d) * d);
    const dmrp_vec2 foot = plane.point - dot(plane.point, d) * d;
    const double half = std::sqrt(std::max(max_speed * max_speed - squared_norm(foot), 0.0));
    candidates.push_back(foot + half * d);
    candidates.push_back(foot - half * d);
    for (const HalfPlane& other : planes) {
      const double sine = cross(d, other.direction);
      if (sine != 0.0)
        candidates.push_back(plane.point + d * (cross(other.point - plane.point, other.direction) / sine));
    }
  }
  std::optional<dmrp_vec2> best;
  for (const dmrp_vec2 v : candidates) {
    if (norm(v) > max_speed + 1e-9 || greatest_violation(planes, 0, planes.size(), v) > 1e-9) continue;
    if (!best || distance(v, wish) < distance(*best, wish)) best = v;
  }
  return best;
}

// A room with a table, a shelf against the wall, two boxes side by side and a pillar of twelve sides.
std::vector<dmrp_segment> room() {
  std::vector<std::vector<dmrp_vec2>> outlines = {{{3.0, 3.0}, {5.0, 3.5}, {4.0, 5.0}},
                                                  {{0.0, 7.0}, {2.0, 7.0}, {2.0, 8.0}, {0.0, 8.0}},
                                                  {{6.0, 7.0}, {7.0, 7.0}, {7.0, 8.0}, {6.0, 8.0}},
                                                  {{7.0, 7.0}, {8.0, 7.0}, {8.0, 8.0}, {7.0, 8.0}},
                                                  {},
                                                  {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}}};
  for (int i = 0; i < 12; ++i)
    outlines[4].push_back(dmrp_vec2{7.5, 2.5} + 0.7 * dmrp::toolkit::from_angle(i * 0.523598775598));
  std::vector<dmrp_segment> segments;
  for (const auto& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      segments.push_back({outline[i], outline[(i + 1) % outline.size()]});
  return segments;
}

double distance_to_walls(const std::vector<dmrp_segment>& walls, const dmrp_segment& way) {
  double nearest = 100.0;
  for (const dmrp_segment& wall : walls) nearest = std::min(nearest, dmrp::toolkit::distance(wall, way));
  return nearest;
}

// The least distance within the horizon when both keep their velocities.
double nearest_approach(const Encounter& met, double horizon_s) {
  const dmrp_segment way = {{0.0, 0.0}, met.approach * horizon_s};
  return dmrp::toolkit::distance(way, met.apart);
}

TEST_CASE("the velocity nearest to the preferred one equals that of exhaustive search") {
  Stream chance(1, "planes");
  VelocityProgram program;
  int feasible = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto planes = random_planes(chance, 1 + chance.below(12), -0.6, 1.2);
    const dmrp_vec2 wish = in_disc(chance, 2.0);
    const dmrp_vec2 found = program.solve(planes, 0, max_speed, wish);
    CHECK(norm(found) <= max_speed + 1e-9);
    const auto expected = nearest_by_exhaustion(planes, wish);
    if (!expected) continue;
    ++feasible;
    CHECK(distance(found, *expected) < 1e-6);
  }
  CHECK(feasible > 500);
  CHECK(feasible < 2800);
}

TEST_CASE("without a common velocity, walls hold and the greatest violation of the other planes is minimal") {
  Stream chance(2, "planes");
  VelocityProgram program;
  int infeasible = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t hard = chance.below(4);
    auto planes = random_planes(chance, hard, 0.0, 0.8);
    for (const HalfPlane& soft : random_planes(chance, 3 + chance.below(8), -1.0, 0.5)) planes.push_back(soft);
    if (nearest_by_exhaustion(planes, {0.0, 0.0})) continue;
    ++infeasible;
    const dmrp_vec2 found = program.solve(planes, hard, max_speed, in_disc(chance, 1.5));
    const double at_found = greatest_violation(planes, hard, planes.size(), found);
    CHECK(norm(found) <= max_speed + 1e-7);
    CHECK(greatest_violation(planes, 0, hard, found) <= 1e-7);
    for (int sample = 0; sample < 500; ++sample) {
      const dmrp_vec2 v = sample % 2 == 0 ? in_disc(chance, max_speed) : found + in_disc(chance, 0.02);
      if (norm(v) > max_speed || greatest_violation(planes, 0, hard, v) > 0.0) continue;
      if (greatest_violation(planes, hard, planes.size(), v) < at_found - 1e-7)
        FAIL("round " << round << " did better");
    }
  }
  CHECK(infeasible > 100);
}

TEST_CASE("walls on both sides leave the velocity along them") {
  VelocityProgram program;
  const std::vector<HalfPlane> squeezed = {half_plane({0.0, 0.0}, {0.6, 0.8}), half_plane({0.0, 0.0}, {-0.6, -0.8}),
                                           half_plane({0.3, 0.0}, {-1.0, 0.0})};
  const dmrp_vec2 along = program.solve(squeezed, 2, max_speed, {1.0, -1.0});
  CHECK(along.x == Approx(0.3).margin(1e-9));
  CHECK(along.y == Approx(-0.225).margin(1e-9));
}

TEST_CASE("two people who each make half of the change do not meet within the horizon") {
  Stream chance(3, "encounters");
  for (int round = 0; round < 3000; ++round) {
    const dmrp_vec2 mine = in_disc(chance, max_speed);
    const dmrp_vec2 theirs = in_disc(chance, max_speed);
    const dmrp_vec2 apart = dmrp::toolkit::from_angle(chance.uniform(0.0, 6.28318)) * chance.uniform(0.61, 4.0);
    const Encounter met = {apart, mine - theirs, 0.6};
    const HalfPlane for_me = give_way(escape(met, 2.0, 0.02), mine, 0.5);
    const HalfPlane for_them = give_way(escape({-apart, theirs - mine, 0.6}, 2.0, 0.02), theirs, 0.5);
    VelocityProgram program;
    const dmrp_vec2 my_next = program.solve({for_me}, 0, 10.0, mine);
    const dmrp_vec2 their_next = program.solve({for_them}, 0, 10.0, theirs);
    CHECK(nearest_approach({apart, my_next - their_next, 0.6}, 2.0) >= 0.6 - 1e-9);
    // a velocity without a conflict stays as it is
    if (nearest_approach(met, 2.0) > 0.6) CHECK(my_next == mine);
  }
}

TEST_CASE("two people who overlap separate within one step") {
  const Encounter met = {{0.5, 0.0}, {1.0, 0.0}, 0.6};
  const Escape away = escape(met, 2.0, 0.02);
  const dmrp_vec2 next = met.approach + away.change;
  CHECK(norm(met.apart - 0.02 * next) == Approx(0.6));
}

TEST_CASE("no permitted velocity leads into a wall within the horizon") {
  const auto walls = room();
  WallObstacles obstacles;
  const double horizon_s = GENERATE(0.15, 1.0, 2.0);
  obstacles.start({walls.data(), walls.size()}, {0.0, 0.0}, {10.0, 10.0}, 5.0);
  Stream chance(4, "places", static_cast<int>(100.0 * horizon_s));
  int permitted = 0;
  int forbidden = 0;
  int places = 0;
  std::vector<HalfPlane> planes;
  while (places < 1500) {
    const dmrp_vec2 at = {chance.uniform(0.3, 9.7), chance.uniform(0.3, 9.7)};
    const bool in_a_box = (at.x < 2.3 && at.y > 6.7 && at.y < 8.3) ||
                          (at.x > 5.7 && at.x < 8.3 && at.y > 6.7 && at.y < 8.3) ||
                          distance(at, dmrp_vec2{7.5, 2.5}) < 1.0 || distance(at, dmrp_vec2{4.0, 3.8}) < 0.6;
    if (in_a_box || distance_to_walls(walls, {at, at}) < 0.3) continue;
    ++places;
    planes.clear();
    obstacles.append_half_planes(at, in_disc(chance, max_speed), 0.3, max_speed, horizon_s, planes);
    CHECK(greatest_violation(planes, 0, planes.size(), {0.0, 0.0}) <= 1e-9);
    for (int sample = 0; sample < 20; ++sample) {
      const dmrp_vec2 v = in_disc(chance, max_speed);
      if (greatest_violation(planes, 0, planes.size(), v) > 0.0) {
        ++forbidden;
        continue;
      }
      ++permitted;
      const double clearance = distance_to_walls(walls, {at, at + horizon_s * v});
      if (clearance < 0.3 - 1e-9)
        FAIL("from " << at.x << ", " << at.y << " at " << v.x << ", " << v.y << ": " << clearance << " m");
    }
  }
  CHECK(permitted > 5000);
  CHECK(forbidden > 100);
}

TEST_CASE("walls do not slow people who walk along them or toward a corner") {
  const auto walls = room();
  WallObstacles obstacles;
  obstacles.start({walls.data(), walls.size()}, {0.0, 0.0}, {10.0, 10.0}, 5.0);
  std::vector<HalfPlane> planes;
  obstacles.append_half_planes({5.0, 0.31}, {1.3, 0.0}, 0.3, 1.3, 1.0, planes);
  CHECK(greatest_violation(planes, 0, planes.size(), {1.3, 0.0}) <= 0.0);
  // 1.5 to 2 m from both walls of a corner, and no contact within 1 s
  planes.clear();
  obstacles.append_half_planes({8.0, 8.5}, {0.9, 0.7}, 0.3, 1.5, 1.0, planes);
  CHECK(greatest_violation(planes, 0, planes.size(), {0.9, 0.7}) <= 0.0);
  // faster than the corner allows: the result just touches both walls
  planes.clear();
  obstacles.append_half_planes({9.0, 9.0}, {1.0, 1.0}, 0.3, 1.5, 1.0, planes);
  VelocityProgram program;
  const dmrp_vec2 v = program.solve(planes, planes.size(), 1.5, {1.0, 1.0});
  CHECK(v.x == Approx(0.7));
  CHECK(v.y == Approx(0.7));
}

}  // namespace orca_parts_test
