// SPDX-License-Identifier: MIT
// dispatcher.hpp: how a plan reaches the robots: what each is handed to drive, and how far it may go.
#pragma once

#include <dmrp/path.h>
#include <dmrp/robot.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/execution/action_dependencies.hpp"
#include "core/execution/progress.hpp"
#include "core/world/world.hpp"
#include "host/trial/planning.hpp"
#include "host/trial/variant_world.hpp"

namespace dmrp::host {

// What a robot is told of its task at a control tick, in the terms of dmrp_observation.
struct Guidance {
  dmrp_goal goal{};
  double progress_m = 0.0;
  std::uint32_t progress_waypoint = 0;
  std::uint32_t released_waypoint = 0;
};

// Of one trial. A plan's path becomes a robot's course, which leads to the goals themselves (path_to_drive()); progress
// is counted along it whatever the robot is handed.
// - dispatch = "full_path": a robot is handed its course, once a plan.
// - dispatch = "waypoint": one waypoint of it at a time, the next when the robot is within the goal's tolerance of it,
//   without waiting for others and without coming to rest. A wait is a waypoint that is reached at once: a dispatcher
//   that knows neither times nor others drops it. At a goal the robot has to arrive, as on a full path.
// - execution = "ordered": the course is released as far as the action dependency graph of the plan allows. A robot
//   counts as having reached a cell when it is within the goal's tolerance of its centre or has passed that.
class Dispatcher {
 public:
  // Both outlive it.
  Dispatcher(const VariantWorld& variant, const core::World& world);

  // A plan, which exists, takes effect.
  void take_up(const Plan& plan);

  // After every step of the world: robots make progress.
  void follow();

  // At every control tick: releases what may be released, and sends robots on.
  void direct();

  // The path that the robot is to be handed now, once; empty if what it has stands. Valid until the next plan.
  std::span<const dmrp_waypoint> hand_over(std::uint32_t robot);

  // After direct().
  Guidance guidance(std::uint32_t robot) const;

  // Where each robot is on its path, now and this much later.
  std::vector<OnTheWay> on_the_way(std::int64_t later_ns) const;

  std::span<const core::PathProgress> progress() const { return progress_; }
  std::span<const double> gained_m() const { return gained_m_; }

 private:
  struct Course {
    std::vector<dmrp_waypoint> path;    // empty of a robot that the plan does not move
    std::vector<std::uint32_t> stages;  // of its waypoints, where execution is ordered
    std::uint32_t released = 0;         // the last waypoint that may be passed
    std::uint32_t sent = 0;             // the waypoint that the robot is sent to, where dispatch is by waypoint
    bool is_new = false;                // what the robot is to be handed
  };

  bool ordered() const { return variant_.simulation.execution == core::Execution::ordered; }
  bool by_waypoint() const { return variant_.simulation.dispatch == core::Dispatch::waypoint; }
  bool is_near(std::uint32_t robot, const dmrp_waypoint& waypoint) const;
  bool ends_at_goal(std::uint32_t robot, std::uint32_t waypoint) const;
  void find_stages(Course& course) const;
  std::int64_t time_on_path_ns(std::uint32_t robot) const;
  void release();
  void send_on(std::uint32_t robot);

  const VariantWorld& variant_;
  const core::World& world_;
  std::vector<Course> courses_;
  std::vector<core::PathProgress> progress_;
  std::vector<double> gained_m_;
  core::ActionDependencies dependencies_;
};

}  // namespace dmrp::host
