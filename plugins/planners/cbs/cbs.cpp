// SPDX-License-Identifier: MIT
#include "cbs.hpp"

#include "../mapf/solvability.hpp"
#include "search.hpp"

namespace dmrp::planners {

Descriptor Cbs::describe() {
  return Descriptor("dmrp.planner.cbs", "CBS", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("paths without conflicts, of least sum of costs")
      .source(
          "Sharon, Stern, Felner, Sturtevant: Conflict-based search for optimal multi-agent pathfinding, AIJ 2015; "
          "prioritized conflicts and bypass: Boyarski et al., IJCAI 2015")
      .connectivity(DMRP_CONNECTIVITY_4);
}

Status Cbs::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  const Problem problem = make_problem(host_problem, true);
  StopSignal stop([this] { return should_stop(); });
  const auto tables = make_tour_tables(problem, stop);
  if (!tables) return Status::timeout;
  if (const auto robot = find_cut_off_robot(problem, *tables)) {
    set_error("robot " + std::to_string(*robot) + " cannot reach its goal");
    return Status::no_solution;
  }
  if (const auto obstruction = find_obvious_obstruction(problem)) {
    set_error(*obstruction);
    return Status::no_solution;
  }

  CbsSearch search(problem, *tables, node_limit, stop);
  const CbsSearch::Result result = search.run();
  const CbsStatistics statistics = search.statistics();
  sink.statistic("lower_bound", statistics.lower_bound);
  sink.statistic("high_level_expanded", static_cast<double>(statistics.high_level_expanded));
  sink.statistic("high_level_generated", static_cast<double>(statistics.high_level_generated));
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  switch (result) {
    case CbsSearch::Result::solved:
      sink.statistic("cost", statistics.lower_bound);
      write_paths(host_problem, problem, search.solution(), sink);
      return Status::ok;
    case CbsSearch::Result::unsolvable:
      set_error(search.obstruction());
      return Status::no_solution;
    case CbsSearch::Result::stopped:
      set_error("stopped by the host");
      return Status::timeout;
    case CbsSearch::Result::node_limit:
      set_error("no plan within node_limit = " + std::to_string(*node_limit) + " nodes");
      return Status::timeout;
  }
  return Status::error;
}

}  // namespace dmrp::planners
