// SPDX-License-Identifier: MIT
// planned_trials.hpp: the trials that a run has still to do, without a list of them: there can be millions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace dmrp::host {

// Of the trials FIRST, FIRST + STRIDE, ... below COUNT those that are not finished, in order.
class PlannedTrials {
 public:
  // `finished` is sorted.
  PlannedTrials(std::uint64_t first, std::uint64_t stride, std::uint64_t count, std::vector<std::uint64_t> finished);

  // These, in the order given.
  explicit PlannedTrials(std::vector<std::uint64_t> listed);

  std::uint64_t all() const;   // finished or not
  std::uint64_t left() const;  // that next() has not given yet
  std::optional<std::uint64_t> next();

 private:
  bool is_finished(std::uint64_t trial) const;

  std::uint64_t first_;
  std::uint64_t stride_;
  std::uint64_t count_;
  std::vector<std::uint64_t> finished_;
  std::vector<std::uint64_t> listed_;  // if not empty: the trials are places in it
  std::uint64_t next_;
  std::uint64_t left_;
};

}  // namespace dmrp::host
