// SPDX-License-Identifier: MIT
// recent_progress.hpp: the progress of a robot along its paths within a sliding time window.
#pragma once

#include <cstdint>
#include <deque>
#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

// Use one object for each robot. A switch to a new path is not progress.
class RecentProgress {
 public:
  void begin(std::int64_t window_ns) {
    window_ns_ = window_ns;
    gained_m_ = 0.0;
    history_.clear();
  }

  void observe(const Sample& sample, const RobotSample& robot) {
    const std::uint64_t revision = sample.plan ? sample.plan->revision : 0;
    if (!history_.empty() && revision == revision_) gained_m_ += robot.progress_m - progress_m_;
    revision_ = revision;
    progress_m_ = robot.progress_m;
    history_.push_back({sample.t_ns, gained_m_});
    // keep one moment that is at least a whole window old
    while (history_.size() > 1 && history_[1].t_ns <= sample.t_ns - window_ns_) history_.pop_front();
  }

  // Whether the progress in the window that ends with the last sample is below `progress_m`. False until a whole window
  // has been observed.
  bool stalls(double progress_m) const {
    return !history_.empty() && history_.back().t_ns - history_.front().t_ns >= window_ns_ &&
           gained_m_ - history_.front().gained_m < progress_m;
  }

  // The beginning of the window.
  std::int64_t since_ns() const { return history_.front().t_ns; }

 private:
  struct Moment {
    std::int64_t t_ns;
    double gained_m;
  };

  std::int64_t window_ns_ = 0;
  std::uint64_t revision_ = 0;
  double progress_m_ = 0.0;
  double gained_m_ = 0.0;
  std::deque<Moment> history_;
};

}  // namespace dmrp::metrics
