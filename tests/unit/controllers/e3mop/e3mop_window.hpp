// SPDX-License-Identifier: MIT
// e3mop_window.hpp: a robot's window onto a scenario's static geometry, and the lattice search in it.
#pragma once

#include <dmrp/toolkit/distance_transform.hpp>
#include <dmrp/toolkit/random.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controllers/e3mop/free_space.hpp"
#include "controllers/e3mop/lattice_search.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/scenario/read_scenario.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace dmrp::test {

inline const dmrp_limits e3mop_limits = differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
inline const dmrp_footprint e3mop_disc = disc_footprint(0.25);

// A window of 6 m at 0.05 m whose lethal cells are those that an obstacle reaches into, with its distance field.
class Window {
 public:
  static constexpr std::uint32_t cells = 120;
  static constexpr double resolution_m = 0.05;

  // `is_occupied(point)` is asked for every cell's centre.
  template <class IsOccupied>
  Window(dmrp_pose robot_pose, IsOccupied&& is_occupied) : robot(robot_pose) {
    const auto lattice = [](double at) { return resolution_m * (std::floor(at / resolution_m) - cells / 2); };
    const dmrp_vec2 origin = {lattice(robot.x), lattice(robot.y)};
    lethal.resize(cells * cells);
    for (std::uint32_t i = 0; i < lethal.size(); ++i)
      lethal[i] = is_occupied(origin + resolution_m * dmrp_vec2{i % cells + 0.5, i / cells + 0.5});
    toolkit::DistanceTransform transform;
    distances = transform.compute(cells, cells, resolution_m, lethal.data(), 6.0);
    const dmrp_field c = {sizeof(c), cells, cells, 0, 0, resolution_m, origin, 6.0, distances.data()};
    field.read(c);
  }

  dmrp_pose robot;
  std::vector<std::uint8_t> lethal;
  std::vector<float> distances;
  controllers::e3mop::ClearanceField field;
};

// A lattice of 0.1 m in a window, with a goal.
class LatticeProblem {
 public:
  LatticeProblem(const Window& window, const controllers::e3mop::MotionSet& motion_set, dmrp_vec2 goal_at,
                 double padding_m = 0.05)
      : motions(motion_set), free_space(window.field, Footprint(e3mop_disc), padding_m, window.robot) {
    frame.center = toolkit::position(window.robot);
    frame.resolution_m = motions.resolution_m();
    frame.half_cells = static_cast<std::int32_t>(2.9 / frame.resolution_m);
    open_cells.assign(static_cast<std::size_t>(frame.cell_count()), 0);
    for (std::int32_t cell = 0; cell < frame.cell_count(); ++cell) {
      const dmrp_vec2 at = frame.point_of(cell);
      open_cells[static_cast<std::size_t>(cell)] = frame.inside(frame.column_of(cell), frame.row_of(cell)) &&
                                                   window.field.of_cell(at) >= e3mop_disc.inscribed_radius_m;
    }
    goal_cell = frame.cell_of(goal_at);
    goal.begin(frame, open_cells);
    for (const std::int32_t row : {-1, 0, 1})
      for (const std::int32_t column : {-1, 0, 1})
        if (frame.inside(frame.column_of(goal_cell) + column, frame.row_of(goal_cell) + row))
          goal.seed(goal_cell + row * frame.stride() + column);
  }

  controllers::e3mop::SearchResult search(const dmrp_pose& start, bool pruning) {
    controllers::e3mop::SearchSettings settings;
    settings.v_max = e3mop_limits.v_max;
    settings.omega_max = e3mop_limits.omega_max;
    settings.pruning = pruning;
    settings.max_expanded = 1 << 20;
    controllers::e3mop::SearchResult result;
    searcher.find(start, {frame, motions, free_space, goal}, settings, result);
    return result;
  }

  const controllers::e3mop::MotionSet& motions;
  controllers::e3mop::LatticeFrame frame;
  controllers::e3mop::FreeSpace free_space;
  std::vector<std::uint8_t> open_cells;
  controllers::e3mop::GoalDistances goal;
  controllers::e3mop::LatticeSearch searcher;
  std::int32_t goal_cell = -1;
};

}  // namespace dmrp::test
