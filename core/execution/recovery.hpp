// SPDX-License-Identifier: MIT
// recovery.hpp: what a robot does by itself when it makes no progress, or when its controller has no command.
//
// After nav2's default behaviour tree, navigate_to_pose_w_replanning_and_recovery.xml, its SimpleProgressChecker and its
// behaviours Spin, Wait and BackUp (Macenski, Martin, White, Gines Clavero: The Marathon 2: a navigation system, IROS
// 2020; github.com/ros-navigation/navigation2). Names and defaults are theirs. Differences: docs/dispatch.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/settings.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

// Of the behaviours Spin and BackUp, as nav2 has them.
inline constexpr std::int64_t recovery_look_ahead_ns = 2'000'000'000;  // simulate_ahead_time
inline constexpr std::int64_t recovery_allowance_ns = 10'000'000'000;  // time_allowance
inline constexpr double spin_slowest = 0.4, spin_fastest = 1.0;        // rad/s
inline constexpr double spin_acceleration = 3.2;                       // rad/s^2

struct RecoveryAction {
  dmrp_twist command{};
  std::optional<RecoveryStep> begins;  // the step that begins with this action
};

// The recoveries of all robots in a trial.
//
// A recovery begins when its robot has gained (Referee::gained_m()) no more than required_movement_radius_m for longer
// than movement_time_allowance_ns, or when its controller had no command for longer than failure_tolerance_ns, and the robot
// has had fewer than `retries` on its way to its present goal. The robot brakes, and takes the step of the ladder after
// the one that it took last; the first one follows the last. A step that fails hands over to the next one in the same
// recovery. A recovery is over when a step has succeeded or all have failed, and the robot stands.
//
//   clear_costmap  forgets what the costmap remembers; fails if the robot has no costmap
//   spin           turns by spin_dist_rad to the left; fails if the robot cannot turn on the spot
//   wait           for wait_duration_ns
//   backup         drives backwards by backup_dist_m; fails if the robot cannot drive backwards
//   replan         asks for a new plan
//
// Spin and backup also fail if the way of the next recovery_look_ahead_ns is not clear (clear_way.hpp), or after
// recovery_allowance_ns.
class RecoveryLadder {
 public:
  // `world` outlives it. `has_costmap`: by robot.
  RecoveryLadder(const World& world, std::vector<bool> has_costmap);

  // What the robot does until the next control tick; nothing if its controller is to drive, or if it is not active. Call
  // it at every control tick with what the robot has gained. `waits`: at its goal, or for others as the plan says, which
  // is no lack of progress.
  std::optional<RecoveryAction> act(std::uint32_t robot, double gained_m, bool waits);

  // What the controller answered at this control tick.
  void controller_answered(std::uint32_t robot, bool has_command);

  bool is_recovering(std::uint32_t robot) const { return robots_[robot].phase != Phase::none; }

 private:
  enum class Phase { none, braking, acting, settling };  // settling: brakes after the last step
  enum class Outcome { goes_on, succeeded, failed };

  struct Climber {
    Phase phase = Phase::none;
    bool begins = false;           // the step `next`, which has not acted yet
    std::size_t next = 0;          // of the settings' steps
    std::size_t failed = 0;        // steps of this recovery
    std::uint32_t recoveries = 0;  // on the way to this goal
    std::uint32_t goal_index = 0;
    std::optional<double> gained_m;  // when it was seen to gain last
    std::int64_t gained_ns = 0;      // that time
    std::int64_t command_ns = 0;     // of the controller's last command
    bool controller_fails = false;
    // of the step that acts
    std::int64_t step_ns = 0;  // its beginning
    dmrp_pose step_pose{};
    double turned_rad = 0.0;
    double last_theta = 0.0;
  };

  const RecoverySettings& settings() const { return world_.settings().recovery; }
  RecoveryStep step_of(const Climber& climber) const { return settings().steps[climber.next]; }
  bool is_stuck(std::uint32_t robot, double gained_m, bool waits);
  bool is_able(std::uint32_t robot, RecoveryStep step) const;
  bool begin_step(std::uint32_t robot);
  bool step_failed(std::uint32_t robot);
  void finish(std::uint32_t robot);
  Outcome act_step(std::uint32_t robot, dmrp_twist& command);
  Outcome spin(std::uint32_t robot, dmrp_twist& command);
  Outcome back_up(std::uint32_t robot, dmrp_twist& command) const;
  bool is_clear(std::uint32_t robot, const dmrp_twist& command, double remaining) const;
  RecoveryAction action(std::uint32_t robot, const dmrp_twist& command);

  const World& world_;
  std::vector<bool> has_costmap_;
  std::vector<Climber> robots_;
};

}  // namespace dmrp::core
