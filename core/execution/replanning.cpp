// SPDX-License-Identifier: MIT
#include "core/execution/replanning.hpp"

#include <algorithm>
#include <cassert>

#include "core/execution/referee.hpp"

namespace dmrp::core {

bool can_replan(const SimulationSettings& settings) {
  const ReplanSettings& replan = settings.replan;
  const auto& steps = settings.recovery.steps;
  return replan.period_ns > 0 || replan.period_steps > 0 || replan.stray_m > 0.0 || replan.stall_ns > 0 ||
         !replan.fallback.empty() ||
         (settings.recovery.retries > 0 && std::find(steps.begin(), steps.end(), RecoveryStep::replan) != steps.end());
}

ReplanMonitor::ReplanMonitor(const ReplanSettings& settings, std::size_t robot_count)
    : settings_(settings), robots_(robot_count) {}

bool ReplanMonitor::due(std::int64_t t_ns, std::span<const RobotState> robots, std::span<const double> gained_m,
                        std::span<const PathProgress> progress) {
  assert(robots.size() == robots_.size() && gained_m.size() == robots_.size() && progress.size() == robots_.size());
  bool any_off_course = false;
  bool any_active = false;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    if (robots[i].state != DMRP_ROBOT_ACTIVE) continue;
    any_active = true;
    if (off_course(t_ns, gained_m[i], progress[i], robots_[i])) any_off_course = true;
  }
  const std::int64_t waited_ns = t_ns - asked_ns_;
  const bool periodic = settings_.period_ns > 0 && waited_ns >= settings_.period_ns;
  if (!any_active || !(periodic || (any_off_course && waited_ns >= settings_.min_interval_ns))) return false;
  asked_ns_ = t_ns;
  for (Watched& watched : robots_) watched.since_ns = t_ns;
  return true;
}

// Whether the robot strays or stalls.
bool ReplanMonitor::off_course(std::int64_t t_ns, double gained_m, const PathProgress& progress,
                               Watched& watched) const {
  if (gained_m - watched.gained_m >= least_progress_m) watched = {gained_m, t_ns};
  const bool strays = settings_.stray_m > 0.0 && progress.off_path_m() > settings_.stray_m;
  const bool stalls = settings_.stall_ns > 0 && t_ns - watched.since_ns >= settings_.stall_ns;
  return strays || stalls;
}

}  // namespace dmrp::core
