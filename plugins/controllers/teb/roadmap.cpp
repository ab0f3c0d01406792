// SPDX-License-Identifier: MIT
#include "controllers/teb/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>

namespace dmrp::controllers::teb {

namespace {

// At most this many obstacles on the straight line get points beside them, at this distance beyond the clearance.
constexpr std::size_t key_obstacles = 8;
constexpr double key_point_offset_m = 0.1;

// The distance from an obstacle's vertices, without its radius; 0 inside.
double distance_to(const Obstacle& obstacle, const Segment& leg) {
  if (obstacle.vertex_count == 1) return toolkit::distance(leg, obstacle.vertices[0]);
  if (obstacle.vertex_count == 2) return toolkit::distance(leg, Segment{obstacle.vertices[0], obstacle.vertices[1]});
  return toolkit::distance(toolkit::PolygonView(obstacle.vertices, obstacle.vertex_count), leg);
}

}  // namespace

void Roadmap::reserve(const Parameters& parameters) {
  const std::size_t vertices = parameters.roadmap_graph_no_samples + 2 * key_obstacles + 2;
  paths_per_vertex_ = static_cast<std::uint32_t>(parameters.max_number_classes + 1);
  vertices_.reserve(vertices);
  table_.resize(vertices * paths_per_vertex_);
  found_.reserve(paths_per_vertex_);
  centers_.reserve(256);
  marks_.reserve(512);
  needed_m_.reserve(256);
}

void Roadmap::search(const RoadmapQuery& query, const Parameters& parameters, toolkit::Stream& random) {
  found_.clear();
  distance_m_ = toolkit::distance(query.start, query.goal);
  if (distance_m_ < 1e-3) return;
  along_ = (query.goal - query.start) / distance_m_;
  place_obstacles(query);
  draw(query, parameters, random);
  const auto goal = static_cast<std::uint32_t>(vertices_.size() - 1);
  table_[0] = {0, 0.0, 0, none};
  vertices_[0].paths = 1;
  for (std::uint32_t to = 1; to <= goal; ++to) {
    for (std::uint32_t from = 0; from < to; ++from) {
      const Vec2 leg = vertices_[to].at - vertices_[from].at;
      const double progress_m = vertices_[to].progress_m - vertices_[from].progress_m;
      if (vertices_[from].paths == 0 || !(progress_m > parameters.obstacle_heading_threshold * toolkit::norm(leg)))
        continue;
      connect(from, to, query);
    }
  }
  for (std::uint32_t i = 0; i < vertices_[goal].paths; ++i) found_.push_back(goal * paths_per_vertex_ + i);
}

void Roadmap::path(std::size_t i, std::vector<Vec2>& points) const {
  points.clear();
  for (std::uint32_t k = table_[found_[i]].previous; table_[k].previous != none; k = table_[k].previous)
    points.push_back(vertices_[table_[k].vertex].at);
  std::reverse(points.begin(), points.end());
}

// Moves each obstacle to where it comes closest to a robot that drives straight to the goal.
void Roadmap::place_obstacles(const RoadmapQuery& query) {
  centers_.clear();
  needed_m_.clear();
  const double duration_s = distance_m_ / query.v_max;
  for (const Obstacle& obstacle : *query.obstacles) {
    const Vec2 relative = obstacle.velocity - query.v_max * along_;
    const double squared = toolkit::squared_norm(relative);
    double met_s = 0.0;
    if (obstacle.velocity != Vec2{0.0, 0.0} && squared > 0.0)
      met_s = std::clamp(-toolkit::dot(obstacle.center - query.start, relative) / squared, 0.0, duration_s);
    centers_.push_back(obstacle.center + met_s * obstacle.velocity);
    double needed_m = query.clearance_m;
    for (const Vec2 end : {query.start, query.goal}) {
      const double all_m = needed_m + obstacle.radius_m + obstacle.reach_m;
      if (toolkit::squared_distance(end, centers_.back()) > all_m * all_m) continue;
      const Vec2 unmoved = end - met_s * obstacle.velocity;
      needed_m = std::min(needed_m, distance_to(obstacle, {unmoved, unmoved}) - obstacle.radius_m - 1e-6);
    }
    needed_m_.push_back(needed_m);
  }
  marks_.clear();
  for (const Mark& mark : *query.marks)
    marks_.push_back(mark.at + centers_[mark.obstacle] - (*query.obstacles)[mark.obstacle].center);
}

// The start, the points between ordered by their progress, and the goal.
void Roadmap::draw(const RoadmapQuery& query, const Parameters& parameters, toolkit::Stream& random) {
  const double beyond_m = 0.5 * (parameters.roadmap_graph_area_length_scale - 1.0) * distance_m_;
  vertices_.clear();
  vertices_.push_back({query.start, 0.0});
  for (std::size_t i = 0; i < parameters.roadmap_graph_no_samples; ++i) {
    const double ahead_m = random.uniform(-beyond_m, distance_m_ + beyond_m);
    add_vertex(query, ahead_m, parameters.roadmap_graph_area_width * (random.uniform() - 0.5));
  }
  add_key_points(query);
  std::sort(vertices_.begin() + 1, vertices_.end(), [](const Vertex& a, const Vertex& b) {
    return a.progress_m < b.progress_m || (a.progress_m == b.progress_m && a.at.x < b.at.x);
  });
  vertices_.push_back({query.goal, distance_m_});
}

void Roadmap::add_key_points(const RoadmapQuery& query) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < centers_.size() && found < key_obstacles; ++k) {
    const Obstacle& obstacle = (*query.obstacles)[k];
    const Vec2 to_center = centers_[k] - query.start;
    const double aside_m = toolkit::cross(along_, to_center);
    const double ahead_m = toolkit::dot(along_, to_center);
    const double beside_m = query.clearance_m + obstacle.radius_m;
    if (std::abs(aside_m) > beside_m + obstacle.reach_m || ahead_m < 0.0 || ahead_m > distance_m_) continue;
    // its extent to the left and to the right of its centre
    double left_m = 0.0;
    double right_m = 0.0;
    for (std::uint32_t i = 0; i < obstacle.vertex_count; ++i) {
      const double reach_m = toolkit::cross(along_, obstacle.vertices[i] - obstacle.center);
      left_m = std::max(left_m, reach_m);
      right_m = std::max(right_m, -reach_m);
    }
    if (aside_m - right_m > beside_m || aside_m + left_m < -beside_m) continue;
    ++found;
    add_vertex(query, ahead_m, aside_m + left_m + beside_m + key_point_offset_m);
    add_vertex(query, ahead_m, aside_m - right_m - beside_m - key_point_offset_m);
  }
}

void Roadmap::add_vertex(const RoadmapQuery& query, double ahead_m, double aside_m) {
  const Vec2 at = query.start + ahead_m * along_ + aside_m * toolkit::perpendicular(along_);
  if (is_clear(at, at, query)) vertices_.push_back({at, ahead_m});
}

// Extends every path to `from` by the leg to `to`.
void Roadmap::connect(std::uint32_t from, std::uint32_t to, const RoadmapQuery& query) {
  const Vec2 a = vertices_[from].at;
  const Vec2 b = vertices_[to].at;
  if (!is_clear(a, b, query)) return;
  const Signature step = step_signature(a, b, marks_);
  const double length_m = toolkit::distance(a, b);
  for (std::uint32_t i = 0; i < vertices_[from].paths; ++i) {
    const std::uint32_t previous = from * paths_per_vertex_ + i;
    keep(to, {table_[previous].signature + step, table_[previous].length_m + length_m, to, previous});
  }
}

// Keeps the shortest path of each class, sorted by length, up to paths_per_vertex_.
void Roadmap::keep(std::uint32_t vertex, const Partial& path) {
  Partial* const first = table_.data() + vertex * paths_per_vertex_;
  std::uint32_t& count = vertices_[vertex].paths;
  std::uint32_t place = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first[i].signature != path.signature) continue;
    if (!(path.length_m < first[i].length_m)) return;
    place = i;
    break;
  }
  if (place == count) {
    if (count == paths_per_vertex_) {
      if (!(path.length_m < first[count - 1].length_m)) return;
      --place;
    } else {
      ++count;
    }
  }
  for (; place > 0 && path.length_m < first[place - 1].length_m; --place) first[place] = first[place - 1];
  first[place] = path;
}

bool Roadmap::is_clear(Vec2 from, Vec2 to, const RoadmapQuery& query) const {
  const Segment leg = {from, to};
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    const Obstacle& obstacle = (*query.obstacles)[k];
    const double needed_m = needed_m_[k] + obstacle.radius_m;
    const double all_m = needed_m + obstacle.reach_m;
    if (toolkit::squared_distance(leg, centers_[k]) > all_m * all_m) continue;
    const Vec2 moved = centers_[k] - obstacle.center;
    if (distance_to(obstacle, {from - moved, to - moved}) < needed_m) return false;
  }
  return true;
}

}  // namespace dmrp::controllers::teb
