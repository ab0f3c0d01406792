// SPDX-License-Identifier: MIT
// large_neighborhood_search.hpp: makes a plan cheaper by planning a few robots at a time again.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/lns/neighborhoods.hpp"
#include "planners/sipp/sipp_search.hpp"

namespace dmrp::planners {

// MAPF-LNS (Li et al. 2021): removes the paths of some robots and plans them again one after the other in random order,
// by SIPP among all others. Keeps the new paths if their sum of costs is not higher. So the plan has no conflicts after
// every iteration and never gets dearer.
class LargeNeighborhoodSearch {
 public:
  // The paths have no conflicts.
  LargeNeighborhoodSearch(const Problem& problem, const std::vector<TourTable>& tables,
                          std::vector<std::vector<Location>> paths, std::uint64_t seed, StopSignal& stop);

  // For so many iterations (-1: without a limit), until `stop` is raised or no robot loses time.
  void run(std::int64_t iterations);

  ImprovingPlan& plan() { return plan_; }
  std::int64_t cost() const { return cost_; }
  std::int64_t iterations() const { return iterations_; }
  std::int64_t low_level_expanded() const { return low_level_.expanded(); }

 private:
  bool replan(const std::vector<std::int32_t>& agents);
  void replan_each_alone();

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  toolkit::Stream random_;
  ImprovingPlan plan_;
  SippSearch low_level_;
  Neighborhoods neighborhoods_;
  std::int64_t cost_ = 0;
  std::int64_t least_cost_ = 0;  // the sum of the robots' costs alone
  std::int64_t iterations_ = 0;
  std::vector<std::vector<Location>> kept_;  // the old paths of a neighborhood
};

}  // namespace dmrp::planners
