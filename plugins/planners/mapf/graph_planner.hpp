// SPDX-License-Identifier: MIT
// graph_planner.hpp: the common part of planners of points on one grid: the problem on the graph, the distance tables,
// and cheap proofs that there is no plan come before the search.
#pragma once

#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

struct Preparation {
  Problem problem;
  std::vector<TourTable> tables;  // one for each agent

  // The sum of the robots' costs alone.
  double lower_bound() const {
    double sum = 0;
    for (std::size_t i = 0; i < tables.size(); ++i) sum += tables[i].distance(0, problem.agents[i].start);
    return sum;
  }
};

class GraphPlanner : public GlobalPlanner {
 public:
  Status start(const Start& start) override {
    seed_ = start.seed;
    return Status::ok;
  }
  Status plan(const PlanningProblem& host_problem, PlanSink& sink) final;

 protected:
  static Descriptor describe_planner(const char* id, const char* name, const char* version) {
    return Descriptor(id, name, version).vendor("dmrp").license("MIT").connectivity(DMRP_CONNECTIVITY_4);
  }

  virtual Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
                       PlanSink& sink) = 0;

  // For robots that differ or do not fit their cells (unequal_robots.hpp). Refuses them if not overridden.
  virtual Status plan_unequal(const PlanningProblem& host_problem, const std::string& unequal, StopSignal& stop,
                              PlanSink& sink);

  Status fail(Status status, const std::string& text) const {
    set_error(text);
    return status;
  }

  std::uint64_t seed() const { return seed_; }

 private:
  std::uint64_t seed_ = 0;
};

}  // namespace dmrp::planners
