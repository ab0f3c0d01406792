// SPDX-License-Identifier: MIT
#include "planners/conflict_search/symmetry/corridor_reasoning.hpp"

namespace dmrp::planners {

std::optional<Passage> CorridorReasoning::find_passage(const Conflict& conflict, PathView path_a, PathView path_b) {
  if (!corridors_) corridors_.emplace(problem_.graph);
  return planners::find_passage(*corridors_, conflict, path_a, path_b);
}

std::optional<SymmetrySplit> CorridorReasoning::find_split(const Passage& passage, const Conflict& conflict,
                                                           const Party& a, const Party& b) {
  if (!scratch_) scratch_.emplace(problem_.graph, stop_);
  const auto known_of = [this](const Party& party, ConstraintTable& table) {
    const auto index = static_cast<std::size_t>(party.agent);
    table.fill(problem_.agents[index], party.constraints);
    return CorridorAgent{problem_.agents[index], tables_[index], table, party.mdd, party.path};
  };
  return find_corridor(problem_.graph, passage, conflict, known_of(a, scratch_->tables[0]),
                       known_of(b, scratch_->tables[1]), scratch_->earliest_arrival);
}

}  // namespace dmrp::planners
