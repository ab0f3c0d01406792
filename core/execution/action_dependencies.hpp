// SPDX-License-Identifier: MIT
// action_dependencies.hpp: the order in which robots pass shared cells, as a graph over their moves.
//
// Hoenig, Kiesel, Tinka, Durham, Ayanian: Persistent and robust execution of MAPF schedules in warehouses, IEEE RA-L 4
// (2019): the action dependency graph.
#pragma once

#include <dmrp/grid.h>
#include <dmrp/path.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dmrp::core {

// The stages of a robot are the cells of its plan in order; a wait is part of its cell. The nodes of the graph are the
// moves to the next stage. Type 1: a robot takes its stages in order. Type 2: it may move to a cell after the robot
// that occupies the cell before it in the plan has reached its own next stage. A diagonal move also occupies the two
// cells beside it until it ends. A robot outside its first cell occupies the cell where it is until it reaches the
// first.
//
// The graph has no cycle. Assume that the plan has no vertex, swap or passing conflicts, and assign to each move the
// time of its end in the plan. A type 1 dependency leads to a later move. A type 2 dependency leads to a later move or
// to one at the same time, because a robot enters a cell at the earliest when the previous robot has just left it. So a
// cycle can only consist of simultaneous moves, each into the cell that the next robot leaves: a rotation of at least
// three robots, since two would be a swap. The moves of a rotation are released together: they no longer depend on each
// other, but each depends on all other dependencies of the rotation and on all its robots having reached the cells that
// they leave, which happens earlier. All dependencies then lead forward in time.
class ActionDependencies {
 public:
  // Replaces the plan. `paths`: a valid plan of a step-wise planner with one path (at least one waypoint) per robot.
  // `positions`: the present positions of the robots.
  void set_plan(const dmrp_grid& grid, std::span<const std::vector<dmrp_waypoint>> paths,
                std::span<const dmrp_vec2> positions);

  // Records that the robot has reached this stage and all before it.
  void reached(std::size_t robot, std::uint32_t stage);

  // The last stage to which the robot may go.
  std::uint32_t released(std::size_t robot);

  // The robot for which it waits there; nothing at its last stage.
  std::optional<std::uint32_t> holder(std::size_t robot) const;

  std::uint32_t last_stage(std::size_t robot) const {
    return static_cast<std::uint32_t>(robots_[robot].stages.size()) - 1;
  }

 private:
  struct Dependency {
    std::size_t robot;
    std::int64_t stage;  // that this robot must have reached
  };
  struct Stage {
    std::uint32_t cell;
    std::int64_t arrival_ns;
    std::vector<Dependency> dependencies;  // of the move to this stage
  };
  struct Robot {
    std::vector<Stage> stages;
    std::int64_t reached = -1;  // stage; -1: on the way to the first
    std::uint32_t released = 0;
  };
  struct Move {
    std::size_t robot;
    std::size_t stage;
  };

  // A robot's occupation of a cell, from its move to stage `from` until it reaches stage `until`.
  struct Claim {
    std::uint32_t cell;
    std::int64_t arrival_ns;
    std::size_t robot;
    std::size_t from;
    std::size_t until;
    bool visits;  // the cell is a stage; otherwise the robot only passes
  };

  std::vector<Claim> find_claims(const dmrp_grid& grid, std::span<const dmrp_vec2> positions) const;
  void add_dependency(const Claim& claim, const Claim& before);
  const Dependency* simultaneous_dependency(Move move) const;
  std::vector<Move> rotation_through(Move move) const;
  void release_together(const std::vector<Move>& rotation);
  void merge_rotations();
  bool is_met(const Dependency& dependency) const { return robots_[dependency.robot].reached >= dependency.stage; }

  std::vector<Robot> robots_;
};

}  // namespace dmrp::core
