// SPDX-License-Identifier: MIT
#include "planners/large_agents/body.hpp"

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <limits>

namespace dmrp::planners {

namespace {

using Polygon = std::vector<dmrp_vec2>;

// Bodies that touch do not overlap. Less than the tolerance of a validator, so that no plan depends on it.
constexpr double touching_m = 1e-9;

// What a body covers of the plane during a motion, relative to its place: a disc, or polygons.
struct Cover {
  double radius_m = 0;
  std::vector<Polygon> polygons;  // none: the disc
};

// The directions in which a body may head.
std::vector<int> headings_of(Motion motion) {
  switch (motion) {
    case Motion::stands_at_any_heading:
      return {};
    case Motion::east:
    case Motion::west:
    case Motion::stands_east_west:
      return {0, 2};
    default:
      return {1, 3};
  }
}

// A quarter turn is exact, so that outlines which touch do not overlap.
dmrp_vec2 turned(dmrp_vec2 point, int quarters) {
  for (int i = 0; i < quarters; ++i) point = toolkit::perpendicular(point);
  return point;
}

Cover cover_of(const Body& body, Motion motion) {
  Cover cover{body.radius_m, {}};
  for (const int heading : headings_of(motion))
    for (Polygon part : body.parts) {
      for (dmrp_vec2& vertex : part) vertex = turned(vertex, heading);
      cover.polygons.push_back(std::move(part));
    }
  return cover;
}

double extent(const Polygon& polygon, dmrp_vec2 direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const dmrp_vec2 vertex : polygon) farthest = std::max(farthest, toolkit::dot(vertex, direction));
  return farthest;
}

// The part of a line at which it has not yet left a half-plane; empty if first > last.
struct Stretch {
  double first = 0;
  double last = 1;

  void clip(double at_first, double at_last, double limit) {
    if (at_first >= limit && at_last >= limit) {
      first = 2;
    } else if (at_first >= limit) {
      first = std::max(first, (limit - at_first) / (at_last - at_first));
    } else if (at_last >= limit) {
      last = std::min(last, (limit - at_first) / (at_last - at_first));
    }
  }
};

// `line`: the places of a relative to b.
bool polygons_overlap(const Polygon& a, const Polygon& b, const dmrp_segment& line) {
  Stretch inside;
  const auto clip = [&](dmrp_vec2 normal) {
    const double limit = extent(b, normal) + extent(a, -normal) - touching_m;
    inside.clip(toolkit::dot(line.from, normal), toolkit::dot(line.to, normal), limit);
  };
  const auto outward = [](const Polygon& polygon, std::size_t i) {
    const dmrp_segment edge = toolkit::PolygonView(polygon).edge(i);
    return -toolkit::perpendicular(toolkit::normalized(edge.to - edge.from));
  };
  for (std::size_t i = 0; i < b.size() && inside.first < inside.last; ++i) clip(outward(b, i));
  for (std::size_t i = 0; i < a.size() && inside.first < inside.last; ++i) clip(-outward(a, i));
  return inside.first < inside.last;
}

bool covers_overlap(const Cover& a, const Cover& b, const dmrp_segment& line) {
  const dmrp_segment back = {-line.from, -line.to};  // the places of b relative to a
  if (a.polygons.empty() && b.polygons.empty())
    return toolkit::distance(line, dmrp_vec2{0.0, 0.0}) < a.radius_m + b.radius_m - touching_m;
  if (a.polygons.empty())
    return std::any_of(b.polygons.begin(), b.polygons.end(), [&](const Polygon& polygon) {
      return toolkit::distance(toolkit::PolygonView(polygon), line) < a.radius_m - touching_m;
    });
  if (b.polygons.empty()) return covers_overlap(b, a, back);
  for (const Polygon& one : a.polygons)
    for (const Polygon& two : b.polygons)
      if (polygons_overlap(one, two, line)) return true;
  return false;
}

}  // namespace

Body::Body(const dmrp_footprint& footprint) : radius_m(footprint.radius_m) {
  for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
    const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
    parts.emplace_back(part.vertices, part.vertices + part.vertex_count);
  }
}

bool Body::operator==(const Body& other) const {
  const auto same_point = [](dmrp_vec2 p, dmrp_vec2 q) { return p.x == q.x && p.y == q.y; };
  const auto same_part = [&](const Polygon& p, const Polygon& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), same_point);
  };
  return radius_m == other.radius_m &&
         std::equal(parts.begin(), parts.end(), other.parts.begin(), other.parts.end(), same_part);
}

std::array<std::int32_t, 2> way_of(Motion motion) {
  switch (motion) {
    case Motion::east:
      return {1, 0};
    case Motion::north:
      return {0, 1};
    case Motion::west:
      return {-1, 0};
    case Motion::south:
      return {0, -1};
    default:
      return {0, 0};
  }
}

bool overlap_during(const Body& a, Motion a_does, const Body& b, Motion b_does, dmrp_vec2 b_from_a, double cell_m) {
  const auto way = [cell_m](Motion motion) {
    const std::array<std::int32_t, 2> cells = way_of(motion);
    return dmrp_vec2{cells[0] * cell_m, cells[1] * cell_m};
  };
  const dmrp_segment line = {-b_from_a, way(a_does) - way(b_does) - b_from_a};
  if (!(toolkit::distance(line, dmrp_vec2{0.0, 0.0}) < a.radius_m + b.radius_m - touching_m)) return false;
  return covers_overlap(cover_of(a, a_does), cover_of(b, b_does), line);
}

}  // namespace dmrp::planners
