// SPDX-License-Identifier: MIT
#include "planners/large_agents/conflict_relation.hpp"

#include <cmath>

namespace dmrp::planners {

ConflictRelation::ConflictRelation(const Body& a, const Body& b, double cell_m)
    : a_(a),
      b_(b),
      cell_m_(cell_m),
      // each may move by one cell toward the other
      reach_(static_cast<std::int32_t>(std::ceil((a.radius_m + b.radius_m) / cell_m)) + 2) {
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  entries_.assign(side * side * motion_count * motion_count, Entry::unknown);
}

ConflictRelation::Entry ConflictRelation::look_up(std::int32_t columns, std::int32_t rows, Motion a_does,
                                                  Motion b_does) const {
  const dmrp_vec2 b_from_a = {columns * cell_m_, rows * cell_m_};
  return overlap_during(a_, a_does, b_, b_does, b_from_a, cell_m_) ? Entry::overlap : Entry::apart;
}

}  // namespace dmrp::planners
