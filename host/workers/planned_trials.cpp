// SPDX-License-Identifier: MIT
#include "host/workers/planned_trials.hpp"

#include <algorithm>
#include <utility>

namespace dmrp::host {

PlannedTrials::PlannedTrials(std::uint64_t first, std::uint64_t stride, std::uint64_t count,
                             std::vector<std::uint64_t> finished)
    : first_(first), stride_(stride), count_(count), finished_(std::move(finished)), next_(first), left_(all()) {
  for (const std::uint64_t trial : finished_)
    if (trial >= first_ && trial < count_ && (trial - first_) % stride_ == 0) --left_;
}

PlannedTrials::PlannedTrials(std::vector<std::uint64_t> listed) : PlannedTrials(0, 1, listed.size(), {}) {
  listed_ = std::move(listed);
}

std::uint64_t PlannedTrials::all() const {
  return first_ < count_ ? (count_ - first_ + stride_ - 1) / stride_ : 0;
}

std::uint64_t PlannedTrials::left() const {
  return left_;
}

bool PlannedTrials::is_finished(std::uint64_t trial) const {
  return std::binary_search(finished_.begin(), finished_.end(), trial);
}

std::optional<std::uint64_t> PlannedTrials::next() {
  if (left_ == 0) return std::nullopt;
  while (is_finished(next_)) next_ += stride_;
  --left_;
  const std::uint64_t trial = std::exchange(next_, next_ + stride_);
  return listed_.empty() ? trial : listed_[trial];
}

}  // namespace dmrp::host
