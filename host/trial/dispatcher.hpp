// SPDX-License-Identifier: MIT
// dispatcher.hpp: passes a plan to the robots: to each the path up to where it must stop, or a waypoint.
#pragma once

#include <dmrp/path.h>
#include <dmrp/robot.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/execution/action_dependencies.hpp"
#include "core/execution/progress.hpp"
#include "core/execution/referee.hpp"
#include "core/world/world.hpp"
#include "host/plans/planning.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// The part of a robot's dmrp_observation that concerns its path.
struct Guidance {
  dmrp_goal goal{};
  double progress_m = 0.0;
  std::uint32_t progress_waypoint = 0;
};

// A path that a controller is to be handed.
struct PathUpdate {
  std::span<const dmrp_waypoint> waypoints;  // empty: it keeps the one that it has
  std::uint32_t flags = 0;                   // DMRP_PATH_PARTIAL
  std::uint32_t update_flags = 0;            // DMRP_PATH_CONTINUES
};

// For one trial. A robot's course is its planned path extended to the goals themselves (path_to_drive()). Progress is
// measured along the course in both modes of dispatch.
//
// The course is cut where the robot must stop: at its current goal, at the last waypoint that the order releases, before
// it returns to where it is (PathProgress::before_return()), and where it turns back, until it has been there. A
// controller that stops at the end of what it gets is right by construction.
// - dispatch = "full_path": the controller gets the course up to the cut, and again whenever the cut moves.
// - dispatch = "waypoint": the controller gets one waypoint at a time, and the next one when the robot is within the
//   goal's tolerance of it; the robot neither stops nor waits for others. A wait in the plan is reached at once, so it
//   has no effect. At a goal the robot has to arrive, as on a full path.
// - dispatch = "lockstep": the same with a barrier: the robots get their next waypoints together, when each of those that
//   are active is near its own. So a wait in the plan lasts as long as the others drive.
// - execution = "ordered": the course is released as far as the action dependency graph of the plan allows. A robot has
//   reached a cell when it is within the goal's tolerance of the cell's centre or has passed it.
class Dispatcher {
 public:
  // Both arguments outlive it.
  Dispatcher(const VariantWorld& variant, const core::World& world);

  // Puts a plan, which exists(), in force.
  void set_plan(const Plan& plan);

  // Measures the robots' progress; after every step of the world.
  void update_progress();

  // Releases waypoints and advances robots to the next ones; at every control tick, before the functions below.
  void update_targets();

  // The path that the robot's controller gets now. Returned once, valid until the next plan.
  PathUpdate take_new_path(std::uint32_t robot);

  Guidance guidance(std::uint32_t robot) const;

  // All robots on their courses, valid until the next update or plan.
  std::span<const core::CoursePlace> places() const { return places_; }

  // The robots on their paths, now and `later_ns` from now.
  std::vector<PathPosition> positions_on_paths(std::int64_t later_ns) const;

  std::span<const core::PathProgress> progress() const { return progress_; }

 private:
  struct Course {
    std::vector<dmrp_waypoint> path;    // empty for a robot that is not active
    std::vector<std::uint32_t> stages;  // of its waypoints, if execution is ordered
    std::uint32_t released = 0;         // the last waypoint that the order lets it pass
    std::vector<std::uint32_t> turns;   // waypoints at which the course turns back, that the robot has not reached
    std::uint32_t cut = 0;              // the last waypoint that the controller gets
    std::uint32_t target = 0;           // the waypoint that the robot drives to, if it gets waypoints
    std::int64_t early_visit = -1;      // the last waypoint at the last goal from which the course leaves and returns
    std::uint32_t behind = 0;           // waypoints at the beginning to which the robot need not drive back
    bool is_partial = false;            // it ends before the last goal
    bool is_new = false;                // the controller does not have it yet
    bool is_begun = false;              // the controller has had a path of this course
  };

  bool ordered() const { return variant_.simulation.execution == core::Execution::ordered; }
  bool by_waypoint() const { return variant_.simulation.dispatch != core::Dispatch::full_path; }
  bool in_lockstep() const { return variant_.simulation.dispatch == core::Dispatch::lockstep; }
  bool is_near(std::uint32_t robot, const dmrp_waypoint& waypoint) const;
  std::uint32_t waypoints_behind(std::uint32_t robot, const std::vector<dmrp_waypoint>& path) const;
  std::uint32_t goal_waypoint(std::uint32_t robot) const;
  bool ends_at_goal(std::uint32_t robot, std::uint32_t waypoint) const;
  bool is_held(std::uint32_t robot) const;
  void find_stages(Course& course) const;
  std::int64_t time_on_path_ns(std::uint32_t robot) const;
  void release();
  void cut(std::uint32_t robot);
  bool is_driving(std::uint32_t robot) const;
  bool is_at_target(std::uint32_t robot) const;
  std::optional<std::uint32_t> late_robot() const;
  void advance(std::uint32_t robot);
  void advance_together();
  core::CoursePlace place_of(std::uint32_t robot, std::optional<std::uint32_t> late) const;
  void update_places();

  const VariantWorld& variant_;
  const core::World& world_;
  std::vector<Course> courses_;
  std::vector<core::PathProgress> progress_;
  std::vector<core::CoursePlace> places_;
  std::uint64_t revision_ = 0;  // of the courses
  core::ActionDependencies dependencies_;
};

}  // namespace dmrp::host
