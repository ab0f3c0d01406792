// SPDX-License-Identifier: MIT
#include "planners/mapf/unequal_robots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace dmrp::planners {

namespace {

// Rounding must not make robots large that just fit.
constexpr double touching_m = 1e-9;

std::string with_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string name_of(std::uint32_t robot) {
  return "robot " + std::to_string(robot);
}

bool same_cells(const dmrp_grid& a, const dmrp_grid& b) {
  const std::size_t cells = std::size_t{a.width} * a.height;
  return a.free == b.free || (std::memcmp(a.free, b.free, cells) == 0 && std::memcmp(a.edges, b.edges, cells) == 0);
}

std::size_t count_free(const dmrp_grid& grid) {
  const std::size_t cells = std::size_t{grid.width} * grid.height;
  return static_cast<std::size_t>(std::count_if(grid.free, grid.free + cells, [](auto free) { return free != 0; }));
}

// Two robots of different grids.
std::optional<std::string> find_other_grid(const PlanningProblem& problem) {
  for (std::uint32_t i = 1; i < problem.robots.size(); ++i) {
    const dmrp_grid& first = *problem.robots[0].grid;
    const dmrp_grid& other = *problem.robots[i].grid;
    if (same_cells(first, other)) continue;
    return name_of(0) + " (" + std::to_string(count_free(first)) + " free cells) and " + name_of(i) + " (" +
           std::to_string(count_free(other)) + " free cells) have different grids";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_unequal_robots(const PlanningProblem& problem) {
  if (problem.robots.size() < 2) return std::nullopt;
  const auto radius_m = [&](std::uint32_t robot) { return problem.robots[robot].robot->footprint->radius_m; };
  std::array<std::uint32_t, 2> largest = {0, 1};
  if (radius_m(1) > radius_m(0)) std::swap(largest[0], largest[1]);
  for (std::uint32_t i = 2; i < problem.robots.size(); ++i) {
    if (!(radius_m(i) > radius_m(largest[1]))) continue;
    largest[1] = i;
    if (radius_m(i) > radius_m(largest[0])) std::swap(largest[0], largest[1]);
  }
  // robots that leave a cell and enter it at a right angle come within cell / sqrt(2) of each other
  const double sum_m = radius_m(largest[0]) + radius_m(largest[1]);
  const double apart_m = problem.grid.resolution_m / std::sqrt(2.0);
  if (sum_m > apart_m + touching_m) {
    const auto shown = [&](std::uint32_t robot) {
      return name_of(robot) + " (radius " + with_digits(radius_m(robot)) + " m)";
    };
    const auto [low, high] = std::minmax(largest[0], largest[1]);
    return shown(low) + " and " + shown(high) + " can touch without meeting in a cell: radii of " + with_digits(sum_m) +
           " m together, at most " + with_digits(apart_m) + " m fit cells of " +
           with_digits(problem.grid.resolution_m) + " m";
  }
  return find_other_grid(problem);
}

}  // namespace dmrp::planners
