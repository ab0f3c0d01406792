// SPDX-License-Identifier: MIT
// ending.hpp: decides when a trial ends and why a robot failed.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/world/world.hpp"

namespace dmrp::core {

inline constexpr std::int64_t stall_window_ns = 20'000'000'000;
inline constexpr double stall_progress_m = 0.2;
inline constexpr double oscillation_travel_m = 1.0;
inline constexpr double oscillation_turn_rad = 4.0 * 3.14159265358979323846;
inline constexpr std::int64_t controller_silence_ns = 5'000'000'000;

// Monitors the robots of one trial.
// - Deadlock: no unfinished robot gained stall_progress_m in the last stall_window_ns. Ends the trial.
// - Oscillation of a robot: over the same window it gained less than stall_progress_m but travelled more than
//   oscillation_travel_m or turned more than oscillation_turn_rad. The record stays even if it arrives later.
//   Time in which it recovers counts for neither: its window begins again when it ends (restart()).
// - Controller failure: no command for controller_silence_ns.
class EndingMonitor {
 public:
  EndingMonitor(std::uint32_t robot_count, std::int64_t time_limit_ns);

  // Records that a controller gave a command.
  void command_given(std::uint32_t robot, std::int64_t t_ns) { robots_[robot].last_command_ns = t_ns; }

  // The robot recovers: its window begins now, and it has a command.
  void restart(std::uint32_t robot, std::int64_t t_ns);

  // Takes the robots at t = 0 and after every step, with the gain of each along its paths (PathProgress::gained_m).
  // Returns DMRP_ENDING_* once the trial is over, 0 until then. A trial without robots is over when the world is
  // `deserted` (World::is_deserted()).
  std::uint32_t update(std::int64_t t_ns, std::span<const RobotState> robots, std::span<const double> gained_m,
                       bool deserted = false);

  // DMRP_FAILURE_* of a robot so far. The caller must call World::fail() for a robot whose controller failed.
  std::uint32_t failure(std::uint32_t robot) const { return robots_[robot].failure; }

  // The outcome of every robot, after update() has returned an ending.
  std::vector<dmrp_robot_end> robot_ends(std::uint32_t ending, std::span<const RobotState> robots) const;

 private:
  struct Moment {
    std::int64_t t_ns;
    double gained_m;
    double travelled_m;
    double turned_rad;
  };
  struct Watched {
    std::deque<Moment> history;  // the last stall_window_ns
    dmrp_pose last_pose{};
    double travelled_m = 0.0;
    double turned_rad = 0.0;
    std::int64_t last_command_ns = 0;
    std::uint32_t failure = DMRP_FAILURE_NONE;
  };

  static bool watch(Watched& watched, std::int64_t t_ns, const RobotState& robot, double gained_m);

  std::int64_t time_limit_ns_;
  std::vector<Watched> robots_;
};

}  // namespace dmrp::core
