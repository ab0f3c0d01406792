// SPDX-License-Identifier: MIT
// corridor_reasoning.hpp: corridor splits for the conflicts of one search. Builds its tables on first use.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "planners/conflict_search/symmetry/corridor.hpp"

namespace dmrp::planners {

class CorridorReasoning {
 public:
  // One of the two agents of a conflict, as the node that has the conflict knows it. `constraints` are the agent's.
  struct Party {
    std::int32_t agent;
    PathView path;
    const std::vector<Constraint>& constraints;
    const Mdd& mdd;
  };

  CorridorReasoning(const Problem& problem, const std::vector<TourTable>& tables, StopSignal& stop)
      : problem_(problem), tables_(tables), stop_(stop) {}

  // The passage of the conflict, if it has one. A cheap test before find_split(), which needs MDDs.
  std::optional<Passage> find_passage(const Conflict& conflict, PathView path_a, PathView path_b);
  std::optional<SymmetrySplit> find_split(const Passage& passage, const Conflict& conflict, const Party& a,
                                          const Party& b);

 private:
  struct Scratch {
    Scratch(const GridGraph& graph, StopSignal& stop)
        : tables{ConstraintTable(graph), ConstraintTable(graph)}, earliest_arrival(graph, &stop) {}

    std::array<ConstraintTable, 2> tables;
    EarliestArrival earliest_arrival;
  };

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  std::optional<Corridors> corridors_;
  std::optional<Scratch> scratch_;
};

}  // namespace dmrp::planners
