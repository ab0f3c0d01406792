// SPDX-License-Identifier: MIT
#include "planners/mapf/preparation.hpp"

#include "planners/mapf/solvability.hpp"
#include "planners/mapf/unequal_robots.hpp"

namespace dmrp::planners {

std::optional<Preparation> prepare(const PlanningProblem& host_problem, StopSignal& stop) {
  Preparation out{make_problem(host_problem, true), {}, {}};
  if (auto unequal = find_unequal_robots(host_problem)) {
    out.obstruction = refusal(*unequal);
    return out;
  }
  auto tables = make_tour_tables(out.problem, stop);
  if (!tables) return std::nullopt;
  out.tables = std::move(*tables);
  if (const auto robot = find_cut_off_robot(out.problem, out.tables))
    out.obstruction = "robot " + std::to_string(*robot) + " cannot reach its goal";
  else if (auto obstruction = find_obvious_obstruction(out.problem))
    out.obstruction = std::move(*obstruction);
  return out;
}

}  // namespace dmrp::planners
