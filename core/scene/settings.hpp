// SPDX-License-Identifier: MIT
// settings.hpp: the settings of an experiment that hold for all its trials: simulation, types of robot, sensors.
// The defaults are those of the benchmark's method.
#pragma once

#include <dmrp/robot.h>
#include <dmrp/robot_event.h>

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace dmrp::core {

enum class Tracking { none, visible, all };  // the agents that a controller observes; visible: in range and in sight

// A controller gets the whole path, or one waypoint at a time; in lockstep, when all robots are at theirs.
enum class Dispatch { full_path, waypoint, lockstep };

enum class Execution { free, ordered };  // ordered: robots pass shared cells in the plan's order

struct LidarSettings {
  std::uint32_t beams = 360;
  double field_of_view_rad = 2.0 * std::numbers::pi;  // centred on the robot's heading
  double range_min_m = 0.0;                           // nearer hits are reported at this range
  double range_max_m = 10.0;
  double noise_sd_m = 0.0;     // standard deviation of the range error
  double dropout_share = 0.0;  // share of beams that report no hit
};

struct CostmapSettings {
  double resolution_m = 0.05;
  double window_m = 6.0;          // side of the square around the robot
  double obstacle_range_m = 4.0;  // hits nearer than this mark cells
  double raytrace_range_m = 4.5;  // beams clear cells up to this range
  double inflation_radius_m = 0.55;
  double cost_scaling = 5.0;  // 1/m
};

// The errors of a robot's pose estimate (odometry.hpp). All zero: the estimate is exact.
struct OdometrySettings {
  std::array<double, 4> noise = {0.0, 0.0, 0.0, 0.0};  // a1 (1), a2 (rad^2/m^2), a3 (1), a4 (m^2/rad^2)
  std::int64_t fix_period_ns = 0;                      // between two corrections to the true pose; 0: never
};

enum class Drive : std::uint32_t {
  differential = DMRP_KINEMATICS_DIFFERENTIAL,
  holonomic = DMRP_KINEMATICS_HOLONOMIC,
  ackermann = DMRP_KINEMATICS_ACKERMANN,
};

// The vertices of a convex polygon, counter-clockwise.
using ConvexPolygon = std::vector<dmrp_vec2>;

// A type of robot.
struct RobotSettings {
  std::string type;                  // its name; "": the default type
  double radius_m = 0.25;            // of the disc, or of the circle around the origin that contains the parts
  std::vector<ConvexPolygon> parts;  // the footprint is their union; none: a disc
  Drive drive = Drive::differential;
  double v_min = 0.0;                     // m/s
  double recovery_v_min = 0.0;            // m/s; in a recovery the robot may drive backwards this fast, too
  double v_max = 0.8;                     // m/s
  double v_y_max = 0.0;                   // m/s; holonomic only
  double omega_max = 1.0;                 // rad/s
  double a_max = 1.0;                     // m/s^2
  double alpha_max = 1.0;                 // rad/s^2
  double wheelbase_m = 0.0;               // Ackermann only, as the next two
  double steering_max = 0.6;              // rad
  double steering_rate_max = 1.0;         // rad/s
  std::int64_t actuation_latency_ns = 0;  // from a command to its effect
  OdometrySettings odometry;
  LidarSettings lidar;
  CostmapSettings costmap;
};

struct GoalSettings {
  double tolerance_m = 0.2;
  double tolerance_rad = 0.2;    // if the goal has a heading
  double tolerance_speed = 0.1;  // m/s
  double settle_s = 0.5;
};

// The reasons for a new plan, 0 switches a reason off; and what is asked of the planner.
struct ReplanSettings {
  std::int64_t period_ns = 0;                    // time since the last call of the planner
  std::int64_t period_steps = 0;                 // the same in steps of the plan
  double stray_m = 0.0;                          // an active robot is farther than this from its place on its path
  std::int64_t stall_ns = 0;                     // an active robot gained less than least_progress_m in this time
  std::int64_t min_interval_ns = 2'000'000'000;  // between a call of the planner and one for straying or stalling
  std::uint32_t window_steps = 0;                // plans are for so many steps; 0: for the whole way
  std::string fallback;                          // id of the planner that is asked where the other has no plan; or ""
};

// A step of the recovery ladder.
enum class RecoveryStep : std::uint32_t {
  clear_costmap = DMRP_RECOVERY_CLEAR_COSTMAP,
  spin = DMRP_RECOVERY_SPIN,
  wait = DMRP_RECOVERY_WAIT,
  backup = DMRP_RECOVERY_BACKUP,
  replan = DMRP_RECOVERY_REPLAN,
};

// What a robot does that makes no progress (recovery.hpp). Names and defaults, except that of `retries`, are nav2's.
struct RecoverySettings {
  std::uint32_t retries = 0;  // recoveries of a robot on its way to a goal; 0: none
  std::vector<RecoveryStep> steps = {RecoveryStep::clear_costmap, RecoveryStep::spin, RecoveryStep::wait,
                                     RecoveryStep::backup, RecoveryStep::replan};
  double required_movement_radius_m = 0.5;                   // a robot that moved no farther than this
  std::int64_t movement_time_allowance_ns = 10'000'000'000;  // in this time makes no progress
  std::int64_t failure_tolerance_ns = 300'000'000;           // for which a controller may have no command
  double spin_dist_rad = 1.57;
  std::int64_t wait_duration_ns = 5'000'000'000;
  double backup_dist_m = 0.30;
  double backup_speed = 0.05;  // m/s
};

enum class LocalRoute { path, around };  // around: the path is led around what stands on it

// What robots do for their controllers.
struct NavigationSettings {
  LocalRoute route = LocalRoute::path;
  bool monitor = false;  // collision_monitor.hpp
  // Controllers observe the state that their robot will be in when the command that they answer takes effect.
  bool compensate_latency = false;
};

// What planners plan for. A point is a disc of radius planning_margin_m to walls, and has no extent to other robots.
enum class PlanningBody { footprint, point };

struct SimulationSettings {
  std::int64_t step_ns = 20'000'000;
  std::int64_t control_period_ns = 100'000'000;  // a multiple of step_ns
  std::int64_t control_latency_ns = 0;           // from the state that a controller observes to its command
  std::int64_t planning_latency_ns = 0;          // from the state that a planner gets to the effect of its plan
  std::int64_t step_duration_ns = 1'800'000'000;
  std::int64_t time_limit_ns = 180'000'000'000;
  double grid_resolution_m = 1.0;
  double planning_margin_m = 0.10;  // a cell is free if the clearance at its centre is at least radius + this
  PlanningBody planning_body = PlanningBody::footprint;
  Tracking tracking = Tracking::visible;
  double tracking_range_m = 10.0;
  double tracking_velocity_noise_sd = 0.0;  // m/s, for each component
  GoalSettings goal;
  Dispatch dispatch = Dispatch::full_path;
  Execution execution = Execution::free;
  ReplanSettings replan;
  RecoverySettings recovery;
  NavigationSettings navigation;
  bool oscillation_fails = false;  // a robot that circled on its way has failed even if it arrives
};

}  // namespace dmrp::core
