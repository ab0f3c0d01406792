// SPDX-License-Identifier: MIT
#include "roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>

namespace dmrp::controllers::teb {

void Roadmap::reserve(const ClassTuning& tuning) {
  const std::size_t vertices = tuning.roadmap_graph_no_samples + 2;
  ways_each_ = static_cast<std::uint32_t>(tuning.max_number_classes + 1);
  vertices_.reserve(vertices);
  table_.resize(vertices * ways_each_);
  ways_.reserve(ways_each_);
  places_.reserve(256);
}

void Roadmap::search(const RoadmapQuery& query, const ClassTuning& tuning, toolkit::Stream& random) {
  ways_.clear();
  if (toolkit::distance(query.start, query.goal) < 1e-3) return;
  place_obstacles(query);
  draw(query, tuning, random);
  const auto goal = static_cast<std::uint32_t>(vertices_.size() - 1);
  table_[0] = {0, 0.0, 0, none};
  vertices_[0].ways = 1;
  for (std::uint32_t to = 1; to <= goal; ++to) {
    for (std::uint32_t from = 0; from < to; ++from) {
      const Vec2 leg = vertices_[to].at - vertices_[from].at;
      const double progress_m = vertices_[to].progress_m - vertices_[from].progress_m;
      if (vertices_[from].ways == 0 || !(progress_m > tuning.obstacle_heading_threshold * toolkit::norm(leg))) continue;
      connect(from, to, query);
    }
  }
  for (std::uint32_t i = 0; i < vertices_[goal].ways; ++i) ways_.push_back(goal * ways_each_ + i);
}

void Roadmap::way(std::size_t i, std::vector<Vec2>& points) const {
  points.clear();
  for (std::uint32_t k = table_[ways_[i]].previous; table_[k].previous != none; k = table_[k].previous)
    points.push_back(vertices_[table_[k].vertex].at);
  std::reverse(points.begin(), points.end());
}

// What moves is met where it comes nearest to a robot that drives straight to the goal.
void Roadmap::place_obstacles(const RoadmapQuery& query) {
  places_.clear();
  const Vec2 way = query.goal - query.start;
  const double duration_s = toolkit::norm(way) / query.v_max;
  const Vec2 velocity = way / duration_s;
  for (const Obstacle& obstacle : *query.obstacles) {
    const Vec2 relative = obstacle.velocity - velocity;
    const double squared = toolkit::squared_norm(relative);
    double met_s = 0.0;
    if (obstacle.velocity != Vec2{0.0, 0.0} && squared > 0.0)
      met_s = std::clamp(-toolkit::dot(obstacle.center - query.start, relative) / squared, 0.0, duration_s);
    places_.push_back(obstacle.center + met_s * obstacle.velocity);
  }
}

// Start, samples by their progress, goal.
void Roadmap::draw(const RoadmapQuery& query, const ClassTuning& tuning, toolkit::Stream& random) {
  const double distance_m = toolkit::distance(query.start, query.goal);
  const Vec2 along = (query.goal - query.start) / distance_m;
  const double beyond_m = 0.5 * (tuning.roadmap_graph_area_length_scale - 1.0) * distance_m;
  vertices_.clear();
  vertices_.push_back({query.start, 0.0});
  for (std::size_t i = 0; i < tuning.roadmap_graph_no_samples; ++i) {
    const double ahead_m = random.uniform(-beyond_m, distance_m + beyond_m);
    const double aside_m = tuning.roadmap_graph_area_width * (random.uniform() - 0.5);
    const Vec2 at = query.start + ahead_m * along + aside_m * toolkit::perpendicular(along);
    if (is_clear(at, at, query)) vertices_.push_back({at, ahead_m});
  }
  std::sort(vertices_.begin() + 1, vertices_.end(), [](const Vertex& a, const Vertex& b) {
    return a.progress_m < b.progress_m || (a.progress_m == b.progress_m && a.at.x < b.at.x);
  });
  vertices_.push_back({query.goal, distance_m});
}

// Continues every way to `from` by the leg to `to`.
void Roadmap::connect(std::uint32_t from, std::uint32_t to, const RoadmapQuery& query) {
  const Vec2 a = vertices_[from].at;
  const Vec2 b = vertices_[to].at;
  if (!is_clear(a, b, query)) return;
  const Signature step = step_signature(a, b, places_);
  const double length_m = toolkit::distance(a, b);
  for (std::uint32_t i = 0; i < vertices_[from].ways; ++i) {
    const std::uint32_t previous = from * ways_each_ + i;
    keep(to, {table_[previous].signature + step, table_[previous].length_m + length_m, to, previous});
  }
}

// The shortest of each class, sorted by length; no more than there is room for.
void Roadmap::keep(std::uint32_t vertex, const Way& way) {
  Way* const first = table_.data() + vertex * ways_each_;
  std::uint32_t& count = vertices_[vertex].ways;
  std::uint32_t place = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first[i].signature != way.signature) continue;
    if (!(way.length_m < first[i].length_m)) return;
    place = i;
    break;
  }
  if (place == count) {
    if (count == ways_each_) {
      if (!(way.length_m < first[count - 1].length_m)) return;
      --place;
    } else {
      ++count;
    }
  }
  for (; place > 0 && way.length_m < first[place - 1].length_m; --place) first[place] = first[place - 1];
  first[place] = way;
}

bool Roadmap::is_clear(Vec2 from, Vec2 to, const RoadmapQuery& query) const {
  const Segment leg = {from, to};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Obstacle& obstacle = (*query.obstacles)[k];
    const double needed_m = query.clearance_m + obstacle.radius_m;
    const double all_m = needed_m + obstacle.reach_m;
    const double to_center_squared = toolkit::squared_distance(leg, places_[k]);
    if (to_center_squared > all_m * all_m) continue;
    if (obstacle.vertex_count == 1) return false;
    const double distance_m = obstacle.vertex_count == 2
                                  ? toolkit::distance(leg, Segment{obstacle.vertices[0], obstacle.vertices[1]})
                                  : toolkit::distance(toolkit::PolygonView(obstacle.vertices, obstacle.vertex_count), leg);
    if (distance_m < needed_m) return false;
  }
  return true;
}

}  // namespace dmrp::controllers::teb
