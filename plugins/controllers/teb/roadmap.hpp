// SPDX-License-Identifier: MIT
// roadmap.hpp: finds paths between two points that pass the obstacles on different sides.
//
// teb_local_planner's probabilistic roadmap: points sampled in the area between start and goal, joined by legs that
// lead toward the goal and are free. Upstream searches it depth first. Here dynamic programming visits the points in
// the order of their progress, and each point keeps the shortest path of every class to it: the same classes, each with
// its shortest path, in bounded time. In addition to the samples there are points left and right of obstacles on the
// straight line, as in upstream's simple exploration: random samples rarely hit gaps a little wider than the robot.
#pragma once

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <vector>

#include "controllers/teb/homotopy_signature.hpp"

namespace dmrp::controllers::teb {

// The input of a search. Does not own what it refers to.
struct RoadmapQuery {
  Vec2 start = {0.0, 0.0};
  Vec2 goal = {0.0, 0.0};
  double v_max = 1.0;                                // m/s, to predict where the robot meets moving obstacles
  double clearance_m = 0.0;                          // of legs from obstacles
  const std::vector<Obstacle>* obstacles = nullptr;  // some may move
  const std::vector<Mark>* marks = nullptr;          // of the obstacles
};

class Roadmap {
 public:
  void reserve(const Parameters& parameters);

  // Samples the points and finds the paths.
  void search(const RoadmapQuery& query, const Parameters& parameters, toolkit::Stream& random);

  // The number of paths: at most max_number_classes + 1, the shortest first.
  std::size_t size() const { return found_.size(); }

  // The points of path `i` between start and goal.
  void path(std::size_t i, std::vector<Vec2>& points) const;

 private:
  static constexpr std::uint32_t none = UINT32_MAX;

  struct Vertex {
    Vec2 at;
    double progress_m;        // along the line from start to goal
    std::uint32_t paths = 0;  // to this vertex, in table_ from vertex index * paths_per_vertex_ on
  };
  struct Partial {  // the last leg of a path from the start to a vertex
    Signature signature = 0;
    double length_m = 0.0;
    std::uint32_t vertex = 0;
    std::uint32_t previous = none;  // the path that it extends
  };

  void place_obstacles(const RoadmapQuery& query);
  void draw(const RoadmapQuery& query, const Parameters& parameters, toolkit::Stream& random);
  void add_key_points(const RoadmapQuery& query);
  void add_vertex(const RoadmapQuery& query, double ahead_m, double aside_m);
  void connect(std::uint32_t from, std::uint32_t to, const RoadmapQuery& query);
  void keep(std::uint32_t vertex, const Partial& path);
  bool is_clear(Vec2 from, Vec2 to, const RoadmapQuery& query) const;

  std::uint32_t paths_per_vertex_ = 0;
  double distance_m_ = 0.0;       // from start to goal ...
  Vec2 along_ = {1.0, 0.0};       // ... and the direction
  std::vector<Vec2> centers_;     // of the obstacles at the predicted meeting
  std::vector<Vec2> marks_;       // likewise
  std::vector<double> needed_m_;  // clearance of legs from each obstacle; less if the start or the goal is closer
  std::vector<Vertex> vertices_;
  std::vector<Partial> table_;
  std::vector<std::uint32_t> found_;  // the entries of the goal
};

}  // namespace dmrp::controllers::teb
