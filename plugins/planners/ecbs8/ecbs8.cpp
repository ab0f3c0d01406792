// SPDX-License-Identifier: MIT
#include "planners/ecbs8/ecbs8.hpp"

#include <algorithm>
#include <numbers>

#include "planners/ecbs8/search.hpp"
#include "planners/mapf/solvability.hpp"
#include "planners/mapf/unequal_robots.hpp"

namespace dmrp::planners {

Descriptor Ecbs8::describe() {
  return Descriptor("dmrp.planner.ecbs8", "ECBS-8", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("paths without conflicts, with diagonals, of cost within a factor of the least")
      .source(
          "Barer, Sharon, Stern, Felner: Suboptimal variants of the conflict-based search algorithm for the "
          "multi-agent pathfinding problem, SoCS 2014; on eight directions: Hu et al., ICRA 2026, algorithm 1")
      .connectivity(DMRP_CONNECTIVITY_8);
}

namespace {

// The sum over all paths, waits included.
double length_of(const ecbs8::Graph& graph, const std::vector<PathView>& paths) {
  std::int64_t straight = 0;
  std::int64_t diagonal = 0;
  for (const PathView path : paths)
    for (std::size_t t = 1; t < path.size(); ++t) {
      bool is_diagonal = false;
      for (Direction d = 0; d < ecbs8::Graph::direction_count; ++d)
        if (graph.neighbor(path[t - 1], d) == path[t] && path[t] != path[t - 1])
          is_diagonal = ecbs8::Graph::is_diagonal(d);
      ++(is_diagonal ? diagonal : straight);
    }
  return static_cast<double>(straight) + std::numbers::sqrt2 * static_cast<double>(diagonal);
}

}  // namespace

Status Ecbs8::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  using namespace ecbs8;
  if (const auto unequal = find_unequal_robots(host_problem)) {
    set_error(refusal(*unequal));
    return Status::no_solution;
  }
  const ecbs8::Problem problem = make_problem<8>(host_problem, true);
  StopSignal stop([this] { return should_stop(); });
  const auto distances = make_tour_distances(problem, stop);
  if (!distances) return Status::timeout;
  if (const auto robot = find_cut_off_robot(problem, *distances)) {
    set_error("robot " + std::to_string(*robot) + " cannot reach its goal");
    return Status::no_solution;
  }
  if (const auto obstruction = find_obvious_obstruction(problem)) {
    set_error(*obstruction);
    return Status::no_solution;
  }

  Search search(problem, *distances, *suboptimality, *node_limit, stop);
  const Search::Result result = search.run();
  const Statistics statistics = search.statistics();
  sink.statistic("high_level_expanded", static_cast<double>(statistics.high_level_expanded));
  sink.statistic("high_level_generated", static_cast<double>(statistics.high_level_generated));
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  if (result != Search::Result::solved) {
    Cost alone = 0;  // a search that was stopped early has proved less
    for (std::size_t i = 0; i < problem.agents.size(); ++i)
      alone += (*distances)[i].distance(0, problem.agents[i].start);
    sink.statistic("lower_bound", as_number(std::max(statistics.lower_bound, alone)));
  }
  switch (result) {
    case Search::Result::solved:
      // The search's integer unit is off by 10^-11. The reported cost is exact, and the bound does not exceed it.
      sink.statistic("cost", length_of(problem.graph, search.solution()));
      sink.statistic("lower_bound",
                     std::min(as_number(statistics.lower_bound), length_of(problem.graph, search.solution())));
      write_paths(host_problem, problem, search.solution(), sink);
      return Status::ok;
    case Search::Result::unsolvable:
      set_error(search.obstruction());
      return Status::no_solution;
    case Search::Result::stopped:
      set_error("stopped by the host");
      return Status::timeout;
    case Search::Result::node_limit:
      set_error("no plan within node_limit = " + std::to_string(*node_limit) + " nodes");
      return Status::timeout;
  }
  return Status::error;
}

}  // namespace dmrp::planners
