// SPDX-License-Identifier: MIT
// lattice_search.hpp: A* on the state lattice, with the heuristic-guided pruning of motions (section III of the paper).
#ifndef DMRP_CONTROLLERS_E3MOP_LATTICE_SEARCH_HPP
#define DMRP_CONTROLLERS_E3MOP_LATTICE_SEARCH_HPP

#include <dmrp/values.h>

#include <cstdint>
#include <vector>

#include "controllers/e3mop/free_space.hpp"
#include "controllers/e3mop/goal_distances.hpp"
#include "controllers/e3mop/lattice.hpp"
#include "controllers/e3mop/lattice_frame.hpp"

namespace dmrp::controllers::e3mop {

// What a search moves through. All of it outlives the search.
struct SearchSpace {
  const LatticeFrame& frame;
  const MotionSet& motions;
  const FreeSpace& free_space;
  GoalDistances& goal;  // its seeds are the goal's cells: any heading is good there
};

struct SearchSettings {
  double v_max = 1.0;                // m/s, of the robot
  double omega_max = 1.0;            // rad/s
  bool pruning = true;               // drop motions that lead away from the heuristic's way
  std::int32_t max_expanded = 3000;  // states
  double first_turn_s = 0.0;  // what turning in place costs at the start beyond its own time: a moving robot stops
};

struct SearchResult {
  bool found = false;
  Ticks cost = 0;
  std::int32_t expanded = 0;  // states
  // The way; where none was found, the way to the state that came nearest to the goal by the heuristic. Places at most
  // 0.05 m apart, headings along the lattice's directions and the arcs between them. Turns in place repeat the place.
  std::vector<dmrp_pose> poses;
};

// A lower bound of the cost from a cell at this distance of the heuristic's grid to the goal.
Ticks cost_to_go(std::int32_t distance, double resolution_m, double v_max);

// Keeps its buffers: no allocation once it has seen its largest frame and longest path.
class LatticeSearch {
 public:
  // Makes room for frames up to this one and for the paths in them.
  void reserve(const LatticeFrame& frame, SearchResult& result);

  // From the pose, whose place must be the frame's centre.
  void find(const dmrp_pose& start, const SearchSpace& space, const SearchSettings& settings, SearchResult& result);

 private:
  struct Node {
    std::uint32_t search;  // the search that this belongs to
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
  static bool is_clear(dmrp_vec2 from, const Motion& motion, const SearchSpace& space);
  void trace(std::int32_t node, const SearchSpace& space, SearchResult& result);

  std::uint32_t search_ = 0;
  std::vector<Node> nodes_;
  std::vector<Open> open_;  // a heap
  std::vector<std::int32_t> way_;
};

}  // namespace dmrp::controllers::e3mop

#endif
