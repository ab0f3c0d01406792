// SPDX-License-Identifier: MIT
#include "host/plan/plan_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <iterator>
#include <numbers>

namespace dmrp::host {

namespace {

// Rounding of coordinates is neither a move nor a turn.
constexpr double same_place_cells = 1e-6;

// In cells of the grid: integers are centres, (0, 0) that of the lower left cell.
dmrp_vec2 cell_point(const dmrp_grid& grid, const dmrp_waypoint& w) {
  const dmrp_vec2 point = {(w.x - grid.origin.x) / grid.resolution_m - 0.5,
                           (w.y - grid.origin.y) / grid.resolution_m - 0.5};
  const dmrp_vec2 center = {std::round(point.x), std::round(point.y)};
  return toolkit::distance(point, center) < same_place_cells ? center : point;
}

// The waypoints of a robot, in cells, up to where it finally rests at its last goal.
std::vector<dmrp_vec2> way_of(const dmrp_planning_problem& problem, const std::vector<dmrp_waypoint>& path) {
  std::vector<dmrp_vec2> way;
  for (const dmrp_waypoint& w : path) way.push_back(cell_point(*problem.grid, w));
  // on a tour the robot may pass its last goal on the way to others
  while (way.size() > 1 && way[way.size() - 2] == way.back() &&
         path[way.size() - 2].goal_index == path.back().goal_index)
    way.pop_back();
  return way;
}

bool turns(dmrp_vec2 from, dmrp_vec2 to) {
  const double product = toolkit::norm(from) * toolkit::norm(to);
  return toolkit::dot(from, to) < 0.0 || std::fabs(toolkit::cross(from, to)) > same_place_cells * product;
}

std::int64_t count_turns(const std::vector<dmrp_vec2>& way) {
  std::int64_t count = 0;
  dmrp_vec2 direction = {0.0, 0.0};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const dmrp_vec2 move = way[i] - way[i - 1];
    if (move == dmrp_vec2{0.0, 0.0}) continue;
    if (direction != dmrp_vec2{0.0, 0.0} && turns(direction, move)) ++count;
    direction = move;
  }
  return count;
}

// Counts steps before multiplying: sums of integers have no rounding.
double step_cost(const std::vector<std::vector<dmrp_vec2>>& ways) {
  std::int64_t straight = 0;
  std::int64_t diagonal = 0;
  for (const auto& way : ways)
    for (std::size_t i = 1; i < way.size(); ++i)
      ++(way[i].x != way[i - 1].x && way[i].y != way[i - 1].y ? diagonal : straight);
  return static_cast<double>(straight) + std::numbers::sqrt2 * static_cast<double>(diagonal);
}

double length_in_cells(const std::vector<std::vector<dmrp_vec2>>& ways) {
  double length = 0.0;
  for (const auto& way : ways)
    for (std::size_t i = 1; i < way.size(); ++i) length += toolkit::distance(way[i - 1], way[i]);
  return length;
}

double step_of(const dmrp_planning_problem& problem, const dmrp_waypoint& w) {
  return static_cast<double>(w.t_ns - problem.effective_from_ns) / static_cast<double>(problem.step_duration_ns);
}

}  // namespace

PlanFigures figures_of(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity) {
  PlanFigures figures;
  std::vector<std::vector<dmrp_vec2>> ways;
  for (const auto& path : paths) {
    ways.push_back(way_of(problem, path));
    figures.turns += count_turns(ways.back());
    const double arrival = std::ceil(step_of(problem, path[ways.back().size() - 1]));
    figures.makespan = std::max(figures.makespan, static_cast<std::int64_t>(arrival));
  }
  figures.cost = connectivity == DMRP_CONNECTIVITY_ANY ? length_in_cells(ways) : step_cost(ways);
  return figures;
}

std::string paths_csv(const dmrp_planning_problem& problem, const PlannedPaths& paths) {
  std::string csv = "agent,t,x,y\n";
  const double top_row = problem.grid->height - 1.0;
  for (std::size_t agent = 0; agent < paths.size(); ++agent) {
    const auto way = way_of(problem, paths[agent]);
    for (std::size_t i = 0; i < way.size(); ++i)
      fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", agent, step_of(problem, paths[agent][i]), way[i].x,
                     top_row - way[i].y);
  }
  return csv;
}

}  // namespace dmrp::host
