// SPDX-License-Identifier: MIT
// action_dependencies.hpp: in which order robots pass the cells that they share, as a graph over their moves.
//
// Hoenig, Kiesel, Tinka, Durham, Ayanian: Persistent and robust execution of MAPF schedules in warehouses, IEEE RA-L 4
// (2019): the action dependency graph. As used by SMART (Yan et al. 2025).
#pragma once

#include <dmrp/grid.h>
#include <dmrp/path.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Stages of a robot are the cells of its plan in order, a wait being part of its cell. The graph's nodes are the moves
// to the next stage (Hoenig et al. also have a node a wait, which nobody can depend on). Type 1: a robot takes its
// stages in order. Type 2: it may move to a cell when the robot that has the cell before it in the plan has reached its
// next stage; likewise to a diagonal's end when the two cells beside it are clear, and to a cell beside a diagonal when
// that is done.
//
// Nobody waits in a circle. Let the plan be free of vertex, swap and passing conflicts, and say that a move happens at
// the time at which the plan has it done. A type 1 dependency leads to a later move. So does a type 2 dependency, or to
// a move at the same time: who has the cell next is there at the earliest when the one before has just left it. A
// circle could then only be one of moves at one time, each into the cell that the next robot leaves: a rotation of
// three or more robots, for two would be a swap. Those moves are made to depend on each other's beginning: each robot
// has to stand in the cell that it leaves, which is an earlier move. All dependencies then lead forward in time.
class ActionDependencies {
 public:
  // Forgets what was before. Plans of step-wise planners, a path (at least one waypoint) a robot, each waypoint on a
  // cell and one step from its neighbours; `positions`: where the robots are, which may be another cell than their
  // first one.
  void set_plan(const dmrp_grid& grid, std::span<const std::vector<dmrp_waypoint>> paths,
                std::span<const dmrp_vec2> positions);

  // The robot has come to this stage. Of stages it has come to, the last one counts.
  void reached(std::size_t robot, std::uint32_t stage);

  // The last stage to which the robot may go by now: at least the next dependency's stage less one.
  std::uint32_t released(std::size_t robot);

  std::uint32_t stage_count(std::size_t robot) const {
    return static_cast<std::uint32_t>(robots_[robot].stages.size());
  }

 private:
  struct Dependency {
    std::uint32_t robot;
    std::uint32_t stage;  // that it must have come to
  };
  struct Stage {
    std::uint32_t cell;
    std::int64_t arrival_ns;
    std::vector<Dependency> needs;  // before the robot may move here
  };
  struct Robot {
    std::vector<Stage> stages;
    std::int64_t reached = -1;  // a stage; -1: on the way to the first
    std::uint32_t released = 0;
  };
  struct Claim;

  void find_stages(const dmrp_grid& grid, std::span<const std::vector<dmrp_waypoint>> paths);
  std::vector<Claim> find_claims(const dmrp_grid& grid, std::span<const dmrp_vec2> positions) const;
  void depend(const Claim& claim, const Claim& before);
  void loosen_rotations();
  const Dependency* simultaneous(std::uint32_t robot, std::uint32_t stage) const;

  std::vector<Robot> robots_;
};

}  // namespace dmrp::core
