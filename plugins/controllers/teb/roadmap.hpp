// SPDX-License-Identifier: MIT
// roadmap.hpp: finds ways between two points that pass the obstacles on different sides.
//
// As teb_local_planner's probabilistic roadmap: points drawn from the area between start and goal, joined where the leg
// leads toward the goal and is clear. Upstream searches it depth first; here the points are passed in the order of
// their progress, and each keeps the shortest way of every class to it: the same classes, by their shortest ways, in
// bounded time. Beside what is drawn, there are points left and right of what stands on the straight way, as in
// upstream's simpler exploration: gaps a little wider than the robot are hit by chance too seldom.
#ifndef DMRP_CONTROLLERS_TEB_ROADMAP_HPP
#define DMRP_CONTROLLERS_TEB_ROADMAP_HPP

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "controllers/teb/homotopy_signature.hpp"

namespace dmrp::controllers::teb {

// What the roadmap is asked.
struct RoadmapQuery {
  Vec2 start = {0.0, 0.0};
  Vec2 goal = {0.0, 0.0};
  double v_max = 1.0;                                // m/s, for where what moves is met
  double clearance_m = 0.0;                          // that legs keep from obstacles' outlines
  const std::vector<Obstacle>* obstacles = nullptr;  // some may move
  const std::vector<Mark>* marks = nullptr;          // theirs
};

class Roadmap {
 public:
  void reserve(const ClassTuning& tuning);

  // Draws the points and finds the ways.
  void search(const RoadmapQuery& query, const ClassTuning& tuning, toolkit::Stream& random);

  // At most max_number_classes + 1, the shortest first.
  std::size_t size() const { return ways_.size(); }

  // The points of a way between start and goal.
  void way(std::size_t i, std::vector<Vec2>& points) const;

 private:
  static constexpr std::uint32_t none = UINT32_MAX;

  struct Vertex {
    Vec2 at;
    double progress_m;       // along the line from start to goal
    std::uint32_t ways = 0;  // kept at this vertex, from vertex index * ways_each_ on
  };
  struct Way {
    Signature signature = 0;
    double length_m = 0.0;
    std::uint32_t vertex = 0;
    std::uint32_t previous = none;  // the way that it continues
  };

  void place_obstacles(const RoadmapQuery& query);
  void draw(const RoadmapQuery& query, const ClassTuning& tuning, toolkit::Stream& random);
  void add_key_points(const RoadmapQuery& query);
  void add_vertex(const RoadmapQuery& query, double ahead_m, double aside_m);
  void connect(std::uint32_t from, std::uint32_t to, const RoadmapQuery& query);
  void keep(std::uint32_t vertex, const Way& way);
  bool is_clear(Vec2 from, Vec2 to, const RoadmapQuery& query) const;

  std::uint32_t ways_each_ = 0;
  double distance_m_ = 0.0;       // from start to goal ...
  Vec2 along_ = {1.0, 0.0};       // ... and the direction
  std::vector<Vec2> centers_;     // of the obstacles, where they are met
  std::vector<Vec2> marks_;       // likewise
  std::vector<double> needed_m_;  // that legs keep from the outlines; less where the start or the goal is nearer
  std::vector<Vertex> vertices_;
  std::vector<Way> table_;
  std::vector<std::uint32_t> ways_;  // at the goal
};

}  // namespace dmrp::controllers::teb

#endif
