// SPDX-License-Identifier: MIT
// conflict_relation.hpp: which cells and steps two kinds of body cannot share, as a table over offsets of cells.
#pragma once

#include <cstdlib>
#include <vector>

#include "planners/large_agents/body.hpp"

namespace dmrp::planners {

// Entries are computed when they are first asked for. The bodies must outlive the relation.
class ConflictRelation {
 public:
  ConflictRelation(const Body& a, const Body& b, double cell_m);

  // Bodies that are more columns or rows apart do not overlap in the next step.
  std::int32_t reach() const { return reach_; }

  // Whether the bodies overlap during one step. `columns`, `rows`: from a's cell to b's cell at the beginning.
  bool overlap(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) {
    if (std::abs(columns) > reach_ || std::abs(rows) > reach_) return false;
    Entry& entry = entries_[index(columns, rows, a_does, b_does)];
    if (entry == Entry::unknown) entry = look_up(columns, rows, a_does, b_does);
    return entry == Entry::overlap;
  }

 private:
  enum class Entry : std::uint8_t { unknown, apart, overlap };

  std::size_t index(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) const {
    const auto side = static_cast<std::size_t>(2 * reach_ + 1);
    const std::size_t place =
        static_cast<std::size_t>(rows + reach_) * side + static_cast<std::size_t>(columns + reach_);
    return (place * motion_count + static_cast<std::size_t>(a_does)) * motion_count + static_cast<std::size_t>(b_does);
  }
  Entry look_up(std::int32_t columns, std::int32_t rows, Motion a_does, Motion b_does) const;

  const Body& a_;
  const Body& b_;
  double cell_m_;
  std::int32_t reach_;
  std::vector<Entry> entries_;
};

}  // namespace dmrp::planners
