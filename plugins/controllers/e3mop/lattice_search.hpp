// SPDX-License-Identifier: MIT
// lattice_search.hpp: A* on the state lattice, with the heuristic-guided pruning of motions (section III of the paper).
#pragma once

#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

#include "controllers/e3mop/free_space.hpp"
#include "controllers/e3mop/goal_distances.hpp"
#include "controllers/e3mop/lattice.hpp"
#include "controllers/e3mop/lattice_frame.hpp"

namespace dmrp::controllers::e3mop {

// The input of a search. Does not own what it refers to.
struct SearchSpace {
  const LatticeFrame& frame;
  const MotionSet& motions;
  const FreeSpace& free_space;
  GoalDistances& goal;  // seeded with the goal's cells; the search accepts any heading there
};

struct SearchSettings {
  double v_max = 1.0;                // m/s, of the robot
  double omega_max = 1.0;            // rad/s
  bool pruning = true;               // drop motions that lead away from the heuristic's shortest path
  std::int32_t max_expanded = 3000;  // states
  double first_turn_s = 0.0;  // additional cost of a turn in place at the start: a moving robot has to stop first
};

struct SearchResult {
  bool found = false;
  Ticks cost = 0;
  std::int32_t expanded = 0;  // states
  // The path; if none was found, the path to the state closest to the goal by the heuristic. Poses are at most 0.05 m
  // apart; headings follow the lattice's directions and the arcs between them. Turns in place repeat the position.
  std::vector<Pose> poses;
};

// A lower bound of the cost to the goal from a cell with this heuristic distance.
Ticks cost_to_go(std::int32_t distance, double resolution_m, double v_max);

// Reuses its buffers: does not allocate once they have grown to the largest frame and the longest path.
class LatticeSearch {
 public:
  // Allocates for frames up to this size and for paths in them.
  void reserve(const LatticeFrame& frame, SearchResult& result);

  // Searches from a pose whose position is the frame's centre.
  void find(const Pose& start, const SearchSpace& space, const SearchSettings& settings, SearchResult& result);

 private:
  struct Node {
    std::uint32_t search;  // the number of the search that set this node
    Ticks cost;
    std::int32_t parent;  // -1: the start
    std::int16_t motion;
    bool expanded;
  };
  struct Open {
    Ticks total;  // cost and cost to go
    Ticks to_go;
    std::int32_t node;  // cell * direction_count + heading
  };

  void begin(const LatticeFrame& frame);
  void offer(std::int32_t node, Ticks cost, Ticks to_go, std::int32_t parent, std::int16_t motion);
  void expand(std::int32_t node, const SearchSpace& space, const SearchSettings& settings);
  static bool is_clear(Vec2 from, const Motion& motion, const SearchSpace& space);
  void trace(std::int32_t node, const SearchSpace& space, SearchResult& result);

  std::uint32_t search_ = 0;
  std::vector<Node> nodes_;
  std::vector<Open> open_;  // a heap
  std::vector<std::int32_t> path_;
};

}  // namespace dmrp::controllers::e3mop
