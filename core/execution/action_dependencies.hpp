// SPDX-License-Identifier: MIT
// action_dependencies.hpp: in which order robots pass the cells that they share, as a graph over their moves.
//
// Hoenig, Kiesel, Tinka, Durham, Ayanian: Persistent and robust execution of MAPF schedules in warehouses, IEEE RA-L 4
// (2019): the action dependency graph.
#pragma once

#include <dmrp/grid.h>
#include <dmrp/path.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// The stages of a robot are the cells of its plan in order, a wait being part of its cell. The graph's nodes are the
// moves to the next stage. Type 1: a robot takes its stages in order. Type 2: it may move to a cell when the robot that
// has the cell before it in the plan has come to its own next stage. A diagonal move has the two cells beside it, too,
// until it is done. A robot that is not in its first cell has the cell where it is until it gets there.
//
// Nobody waits in a circle. Let the plan be free of vertex, swap and passing conflicts, and give a move the time at
// which the plan has it done. A type 1 dependency leads to a later move. So does a type 2 dependency, or to a move at
// the same time: who has the cell next gets there at the earliest when the one before has just left it. A circle could
// then only be one of moves at one time, each into the cell that the next robot leaves: a rotation of three or more
// robots, since two would be a swap. Such moves are released together: none depends on the others any more, but each
// on what any of them depends on besides, and on all robots standing in the cells that they leave, to which they moved
// earlier. All dependencies then lead forward in time.
class ActionDependencies {
 public:
  // Forgets the plan before. A valid plan of a step-wise planner: a path (at least one waypoint) a robot. `positions`:
  // where the robots are.
  void set_plan(const dmrp_grid& grid, std::span<const std::vector<dmrp_waypoint>> paths,
                std::span<const dmrp_vec2> positions);

  // The robot has come to this stage, and so to those before.
  void reached(std::size_t robot, std::uint32_t stage);

  // The last stage to which the robot may go.
  std::uint32_t released(std::size_t robot);

 private:
  struct Need {
    std::size_t robot;
    std::int64_t stage;  // that it must have come to
  };
  struct Stage {
    std::uint32_t cell;
    std::int64_t arrival_ns;
    std::vector<Need> needs;  // before the robot may move here
  };
  struct Robot {
    std::vector<Stage> stages;
    std::int64_t reached = -1;  // -1: on the way to the first stage
    std::uint32_t released = 0;
  };
  struct Move {
    std::size_t robot;
    std::size_t stage;
  };

  // That a robot has a cell: from its move to a stage until it has come to another.
  struct Claim {
    std::uint32_t cell;
    std::int64_t arrival_ns;
    std::size_t robot;
    std::size_t from;
    std::size_t until;
    bool visits;  // the cell is a stage; else the robot only passes
  };

  std::vector<Claim> find_claims(const dmrp_grid& grid, std::span<const dmrp_vec2> positions) const;
  void depend(const Claim& claim, const Claim& before);
  const Need* simultaneous_need(Move move) const;
  std::vector<Move> rotation_through(Move move) const;
  void release_together(const std::vector<Move>& rotation);
  void loosen_rotations();

  std::vector<Robot> robots_;
};

}  // namespace dmrp::core
