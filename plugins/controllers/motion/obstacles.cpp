// SPDX-License-Identifier: MIT
#include "controllers/motion/obstacles.hpp"

#include <dmrp/abi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::controllers {

namespace {

using toolkit::PolygonView;

struct Witness {
  double distance_m = 0.0;      // negative inside
  Vec2 normal = {1.0, 0.0};     // unit vector from the obstacle to the robot
  Vec2 lever_end = {0.0, 0.0};  // the point whose motion gives the derivative by the robot's heading
};

void bound(Obstacle& obstacle) {
  Vec2& lower = obstacle.lower;
  Vec2& upper = obstacle.upper;
  lower = upper = obstacle.vertices[0];
  for (std::uint32_t i = 1; i < obstacle.vertex_count; ++i) {
    lower = {std::min(lower.x, obstacle.vertices[i].x), std::min(lower.y, obstacle.vertices[i].y)};
    upper = {std::max(upper.x, obstacle.vertices[i].x), std::max(upper.y, obstacle.vertices[i].y)};
  }
  obstacle.center = 0.5 * (lower + upper);
  obstacle.reach_m = 0.0;
  for (std::uint32_t i = 0; i < obstacle.vertex_count; ++i)
    obstacle.reach_m = std::max(obstacle.reach_m, toolkit::distance(obstacle.center, obstacle.vertices[i]));
}

// From a shape without its radius to a point.
Witness to_point(const Vec2* vertices, std::uint32_t count, Vec2 point) {
  Vec2 nearest = vertices[0];
  bool inside = false;
  if (count == 2) nearest = toolkit::closest_point(Segment{vertices[0], vertices[1]}, point);
  if (count > 2) {
    const PolygonView polygon(vertices, count);
    nearest = toolkit::closest_border_point(polygon, point);
    inside = toolkit::contains(polygon, point);
  }
  const Vec2 away = point - nearest;
  const double distance_m = toolkit::norm(away);
  Witness witness;
  witness.lever_end = point;
  witness.distance_m = inside ? -distance_m : distance_m;
  if (distance_m > 0.0) witness.normal = (inside ? -1.0 : 1.0) * away / distance_m;
  return witness;
}

double lowest_along(PolygonView polygon, Vec2 direction) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2 vertex : polygon) lowest = std::min(lowest, toolkit::dot(vertex, direction));
  return lowest;
}

Vec2 vertex_lowest_along(PolygonView polygon, Vec2 direction) {
  return *std::min_element(polygon.begin(), polygon.end(), [direction](Vec2 a, Vec2 b) {
    return toolkit::dot(a, direction) < toolkit::dot(b, direction);
  });
}

// The largest gap along the normal of any side of two convex shapes: positive if a side separates them, otherwise minus
// the depth of their overlap.
Witness across_sides(PolygonView robot, PolygonView obstacle) {
  Witness deepest;
  deepest.distance_m = -std::numeric_limits<double>::infinity();
  const auto try_normal = [&](Vec2 normal, bool of_robot) {  // from the obstacle to the robot
    const double gap_m = lowest_along(robot, normal) + lowest_along(obstacle, -normal);
    if (!(gap_m > deepest.distance_m)) return;
    // contact of a robot side with an obstacle corner, or of a robot corner with an obstacle side
    deepest = {gap_m, normal, of_robot ? vertex_lowest_along(obstacle, -normal) : vertex_lowest_along(robot, normal)};
  };
  const auto outward = [](const Segment& edge) {
    return toolkit::normalized(-toolkit::perpendicular(edge.to - edge.from));
  };
  for (std::size_t i = 0; i < robot.size(); ++i) try_normal(-outward(robot.edge(i)), true);
  if (obstacle.size() >= 2)
    for (std::size_t i = 0; i < obstacle.size(); ++i) try_normal(outward(obstacle.edge(i)), false);
  return deepest;
}

// Between two convex shapes, both in the world frame.
Witness to_polygon(PolygonView robot, const Vec2* vertices, std::uint32_t count) {
  const PolygonView obstacle(vertices, count);
  const Witness sides = across_sides(robot, obstacle);
  if (sides.distance_m <= 0.0) return sides;
  // separated: a corner of one shape is closest to the other
  Witness nearest;
  nearest.distance_m = std::numeric_limits<double>::infinity();
  for (const Vec2 corner : robot) {
    const Witness witness = to_point(vertices, count, corner);
    if (witness.distance_m < nearest.distance_m) nearest = witness;
  }
  for (const Vec2 corner : obstacle) {
    const Vec2 on_robot = toolkit::closest_border_point(robot, corner);
    const Vec2 away = on_robot - corner;
    const double distance_m = toolkit::norm(away);
    if (distance_m < nearest.distance_m && distance_m > 0.0) nearest = {distance_m, away / distance_m, on_robot};
  }
  return nearest;
}

// A footprint with a part of more corners counts as its circumscribed circle.
constexpr std::size_t most_corners = 32;

bool counts_as_disc(const Footprint& footprint) {
  const Span<Polygon> all = parts(footprint);
  return all.empty() ||
         std::any_of(all.begin(), all.end(), [](const Polygon& part) { return part.vertex_count > most_corners; });
}

// Between a part of a footprint, whose origin is at this pose, and a shape without its radius.
Witness to_part(const Polygon& part, Vec2 at, Vec2 heading, const Obstacle& obstacle) {
  std::array<Vec2, most_corners> corners;
  const auto [c, s] = heading;
  for (std::size_t i = 0; i < part.vertex_count; ++i) {
    const Vec2 corner = part.vertices[i];
    corners[i] = at + Vec2{c * corner.x - s * corner.y, s * corner.x + c * corner.y};
  }
  return to_polygon(PolygonView(corners.data(), part.vertex_count), obstacle.vertices, obstacle.vertex_count);
}

}  // namespace

void ObstacleSet::clear() {
  vertices_.clear();
  obstacles_.clear();
}

void ObstacleSet::gather(const Observation& now, const dmrp_obstacle_cluster_list* clusters, double slow_m_s) {
  clear();
  const auto add = [this](const Vec2* vertices, std::uint32_t count) -> Obstacle& {
    vertices_.insert(vertices_.end(), vertices, vertices + count);
    Obstacle& obstacle = obstacles_.emplace_back();
    obstacle.vertex_count = count;
    return obstacle;
  };
  if (clusters) {
    for (std::uint32_t i = 0; i < clusters->count; ++i) {
      const auto& cluster = *DMRP_AT(dmrp_obstacle_cluster, clusters->clusters, clusters->stride, i);
      add(cluster.vertices, cluster.vertex_count);
    }
  }
  for (const Agent& agent : now.agents) {
    const Vec2 center = toolkit::position(agent.pose);
    Obstacle& obstacle = add(&center, 1);
    obstacle.radius_m = agent.radius_m;
    obstacle.is_agent = true;
    obstacle.is_robot = agent.kind == DMRP_AGENT_ROBOT;
    if (toolkit::norm(agent.velocity) >= slow_m_s) obstacle.velocity = agent.velocity;
  }
  // vertices_ no longer reallocates: set the pointers
  const Vec2* next = vertices_.data();
  for (Obstacle& obstacle : obstacles_) {
    obstacle.vertices = next;
    next += obstacle.vertex_count;
    bound(obstacle);
  }
}

Vec2 displacement(const Obstacle& obstacle, double ahead_s) {
  return ahead_s * obstacle.velocity;
}

double least_distance(const Footprint& footprint, Vec2 robot, const Obstacle& obstacle, double ahead_s) {
  // The circle around the vertices is wide beside a long obstacle; from outside of their box, that says more.
  constexpr double rounding_m = 1e-9;
  const Vec2 moved = displacement(obstacle, ahead_s);
  const Vec2 at = robot - moved;
  const Vec2 beside = {std::max({obstacle.lower.x - at.x, at.x - obstacle.upper.x, 0.0}),
                       std::max({obstacle.lower.y - at.y, at.y - obstacle.upper.y, 0.0})};
  double least_m = toolkit::distance(robot, obstacle.center + moved) - obstacle.reach_m;
  if (beside != Vec2{0.0, 0.0}) least_m = std::max(least_m, toolkit::norm(beside) - rounding_m);
  return least_m - obstacle.radius_m - footprint.radius_m;
}

Separation separation(const Footprint& footprint, const Pose& robot, const Obstacle& obstacle, double ahead_s) {
  // in the obstacle's moving frame
  const Vec2 at = toolkit::position(robot) - displacement(obstacle, ahead_s);
  if (counts_as_disc(footprint)) {
    const Witness witness = to_point(obstacle.vertices, obstacle.vertex_count, at);
    return {witness.distance_m - obstacle.radius_m - footprint.radius_m, witness.normal, 0.0};
  }
  const Vec2 heading = {std::cos(robot.theta), std::sin(robot.theta)};
  Witness nearest;
  nearest.distance_m = std::numeric_limits<double>::infinity();
  for (const Polygon& part : parts(footprint)) {
    const Witness witness = to_part(part, at, heading, obstacle);
    if (!(witness.distance_m >= nearest.distance_m)) nearest = witness;  // NaN stays NaN
  }
  const Vec2 lever = toolkit::perpendicular(nearest.lever_end - at);
  return {nearest.distance_m - obstacle.radius_m, nearest.normal, toolkit::dot(nearest.normal, lever)};
}

}  // namespace dmrp::controllers
