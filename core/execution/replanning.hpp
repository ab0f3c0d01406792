// SPDX-License-Identifier: MIT
// replanning.hpp: decides when to call the planner again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/execution/progress.hpp"
#include "core/scene/settings.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

// Whether anything in these settings asks the planner again.
bool can_replan(const SimulationSettings& settings);

class ReplanMonitor {
 public:
  // The first call of the planner is at t = 0.
  ReplanMonitor(const ReplanSettings& settings, std::size_t robot_count);

  // Call it at every control tick with what all robots gained (Referee::gained_m()) and their progress. If it returns
  // true, the planner counts as called, and stall times start again.
  bool due(std::int64_t t_ns, std::span<const RobotState> robots, std::span<const double> gained_m,
           std::span<const PathProgress> progress);

 private:
  struct Watched {
    double gained_m = 0.0;
    std::int64_t since_ns = 0;
  };

  bool off_course(std::int64_t t_ns, double gained_m, const PathProgress& progress, Watched& watched) const;

  ReplanSettings settings_;
  std::int64_t asked_ns_ = 0;
  std::vector<Watched> robots_;
};

}  // namespace dmrp::core
