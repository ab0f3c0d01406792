// SPDX-License-Identifier: MIT
#include "pedestrians/orca/wall_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/segment.hpp>
#include <limits>

namespace dmrp::pedestrians {

namespace {

// The leg of the cone over a disc: `side` is +1 for the left one, -1 for the right one.
Vec2 tangent(Vec2 center, double radius_m, double side) {
  const double squared_distance = toolkit::squared_norm(center);
  const double leg_m = std::sqrt(squared_distance - radius_m * radius_m);
  return (center * leg_m + toolkit::perpendicular(center) * (side * radius_m)) / squared_distance;
}

}  // namespace

void WallObstacles::start(Span<Segment> segments, Vec2 lower, Vec2 upper, double reach_m) {
  grid_.start(segments, lower, upper, reach_m);
  walls_.clear();
  for (const Segment& segment : segments)
    walls_.push_back({segment.from, segment.to, toolkit::normalized(segment.to - segment.from), {}, {}, true, true});
  near_.reserve(segments.size());

  for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
    Vec2 lowest = segments[begin].from;
    Vec2 highest = lowest;
    do {
      const Vec2 corner = segments[end].to;
      lowest = {std::min(lowest.x, corner.x), std::min(lowest.y, corner.y)};
      highest = {std::max(highest.x, corner.x), std::max(highest.y, corner.y)};
    } while (segments[end++].to != segments[begin].from && end < segments.size());

    // only the border is free inside; reversed, its free side is to the right too
    if (lowest == lower && highest == upper) {
      for (std::size_t i = begin; i < end; ++i) {
        std::swap(walls_[i].from, walls_[i].to);
        walls_[i].direction = -walls_[i].direction;
      }
    }
    link_outline(begin, end);
  }
}

void WallObstacles::link_outline(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    Wall& wall = walls_[i];
    const Wall* left = &walls_[i == begin ? end - 1 : i - 1];
    const Wall* right = &walls_[i + 1 == end ? begin : i + 1];
    if (left->to != wall.from) std::swap(left, right);
    wall.left_direction = left->direction;
    wall.right_direction = right->direction;
    wall.left_sticks_out = toolkit::cross(left->direction, wall.direction) >= 0.0;
    wall.right_sticks_out = toolkit::cross(wall.direction, right->direction) >= 0.0;
  }
}

void WallObstacles::append_half_planes(Vec2 position, Vec2 velocity, double radius_m, double max_speed,
                                       double horizon_s, std::vector<HalfPlane>& planes) {
  find_near(position, radius_m + max_speed * horizon_s);
  for (const Near& near : near_) {
    const Wall& wall = walls_[near.wall];
    HalfPlane plane;
    bool is_owned = false;
    Vec2 nearest;
    if (is_touching(wall, position, radius_m, nearest, is_owned)) {
      // motion along the wall or away from it is permitted
      if (is_owned) planes.push_back(half_plane({0.0, 0.0}, toolkit::normalized(-nearest)));
      continue;
    }
    View view;
    if (view_of(wall, position, radius_m, view) && border_nearest(wall, view, velocity, radius_m, horizon_s, plane))
      planes.push_back(plane);
  }
}

// Walls whose free side faces the position, nearest first.
void WallObstacles::find_near(Vec2 position, double range_m) {
  near_.clear();
  for (const std::uint32_t w : grid_.near(position)) {
    const Wall& wall = walls_[w];
    if (!(toolkit::cross(wall.direction, position - wall.from) < 0.0)) continue;
    const double squared_distance = toolkit::squared_distance(Segment{wall.from, wall.to}, position);
    if (squared_distance >= range_m * range_m) continue;
    // the grid lists walls by index; equal distances keep this order
    near_.push_back({squared_distance, w});
    for (std::size_t i = near_.size() - 1; i > 0 && near_[i].squared_distance < near_[i - 1].squared_distance; --i)
      std::swap(near_[i], near_[i - 1]);
  }
}

// `nearest`: the wall's nearest point, relative to the position. `is_owned`: this point is not the vertex of a concave
// corner; there, the two walls themselves are constraint enough.
bool WallObstacles::is_touching(const Wall& wall, Vec2 position, double radius_m, Vec2& nearest, bool& is_owned) {
  const double fraction = toolkit::closest_fraction({wall.from, wall.to}, position);
  nearest = toolkit::lerp(wall.from, wall.to, fraction) - position;
  is_owned = fraction <= 0.0 ? wall.left_sticks_out : fraction >= 1.0 ? wall.right_sticks_out : true;
  return toolkit::squared_norm(nearest) <= radius_m * radius_m;
}

// False where only an end counts that belongs to the adjacent wall.
bool WallObstacles::view_of(const Wall& wall, Vec2 position, double radius_m, View& view) {
  view.left = wall.from - position;
  view.right = wall.to - position;
  Vec2 beside_left = wall.left_direction;
  Vec2 beside_right = wall.right_direction;
  bool left_sticks_out = wall.left_sticks_out;
  bool right_sticks_out = wall.right_sticks_out;

  // within a radius of the wall's line and beyond one end, only the disc of this end counts
  const bool near_line = -toolkit::cross(view.left, wall.direction) <= radius_m;
  const bool past_left = toolkit::dot(view.left, wall.direction) > 0.0;
  const bool past_right = toolkit::dot(view.right, wall.direction) < 0.0;
  view.end_on = near_line && (past_left || past_right);
  if (view.end_on && past_left) {
    if (!left_sticks_out) return false;
    view.right = view.left;
    right_sticks_out = left_sticks_out;
    beside_right = wall.direction;
  } else if (view.end_on) {
    if (!right_sticks_out) return false;
    view.left = view.right;
    left_sticks_out = right_sticks_out;
    beside_left = wall.direction;
  }

  view.left_leg = left_sticks_out ? tangent(view.left, radius_m, 1.0) : -wall.direction;
  view.right_leg = right_sticks_out ? tangent(view.right, radius_m, -1.0) : wall.direction;
  // where the adjacent wall extends beyond a leg, the obstacle continues along that wall
  view.left_leg_is_covered = left_sticks_out && toolkit::cross(view.left_leg, -beside_left) >= 0.0;
  view.right_leg_is_covered = right_sticks_out && toolkit::cross(view.right_leg, beside_right) <= 0.0;
  if (view.left_leg_is_covered) view.left_leg = -beside_left;
  if (view.right_leg_is_covered) view.right_leg = beside_right;
  return true;
}

// The half-plane at the point of the velocity obstacle's border that is nearest to the velocity. False where this point
// belongs to the adjacent wall.
bool WallObstacles::border_nearest(const Wall& wall, const View& view, Vec2 velocity, double radius_m, double horizon_s,
                                   HalfPlane& plane) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double radius = radius_m / horizon_s;
  const Vec2 from_left = velocity - view.left / horizon_s;  // from the centres of the truncating discs
  const Vec2 from_right = velocity - view.right / horizon_s;
  const double along_left_leg = toolkit::dot(from_left, view.left_leg);
  const double along_right_leg = toolkit::dot(from_right, view.right_leg);
  const bool before_left = toolkit::dot(from_left, wall.direction) < 0.0;
  const bool behind_right = toolkit::dot(from_right, wall.direction) > 0.0;

  const auto on_disc = [&](Vec2 from_center) {
    const Vec2 normal = toolkit::normalized(from_center);
    plane = half_plane(velocity - from_center + radius * normal, normal);
    return true;
  };
  if (view.end_on) {
    if (along_left_leg < 0.0 && along_right_leg < 0.0) return on_disc(from_left);
  } else {
    if (before_left && along_left_leg < 0.0) return on_disc(from_left);
    if (behind_right && along_right_leg < 0.0) return on_disc(from_right);
  }

  const auto off_line = [&](Vec2 from_center, Vec2 line) { return std::abs(toolkit::cross(line, from_center)); };
  const double off_cut = view.end_on || before_left || behind_right ? infinity : off_line(from_left, wall.direction);
  const double off_left_leg = along_left_leg < 0.0 ? infinity : off_line(from_left, view.left_leg);
  const double off_right_leg = along_right_leg < 0.0 ? infinity : off_line(from_right, view.right_leg);

  const auto on_line = [&](Vec2 from_center, Vec2 normal) {
    plane = half_plane(velocity - from_center + radius * normal, normal);
    return true;
  };
  if (off_cut <= off_left_leg && off_cut <= off_right_leg)
    return on_line(from_left, -toolkit::perpendicular(wall.direction));
  if (off_left_leg <= off_right_leg)
    return !view.left_leg_is_covered && on_line(from_left, toolkit::perpendicular(view.left_leg));
  return !view.right_leg_is_covered && on_line(from_right, -toolkit::perpendicular(view.right_leg));
}

}  // namespace dmrp::pedestrians
