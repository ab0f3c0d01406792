// SPDX-License-Identifier: MIT
// cpp/local_controller.hpp: the base class of local controllers; the contract is in ../local_controller.h.
#pragma once

#include <cstdint>

#include "../local_controller.h"
#include "path.hpp"
#include "plugin_base.hpp"

namespace dmrp {

using Agent = dmrp_agent;

// dmrp_observation with references and spans. Valid until step() returns.
struct Observation {
  explicit Observation(const dmrp_observation& c)
      : robot(c.robot),
        t_ns(c.t_ns),
        dt_ns(c.dt_ns),
        pose(c.pose),
        velocity(c.velocity),
        applied(c.applied),
        goal(*c.goal),
        goal_index(c.goal_index),
        goal_count(c.goal_count),
        progress_m(c.progress_m),
        progress_waypoint(c.progress_waypoint),
        limits(*c.limits),
        footprint(*c.footprint),
        agents(c.agents, c.agent_count, c.agent_stride),
        steering_angle(c.steering_angle) {}

  std::uint32_t robot;
  std::int64_t t_ns;
  std::int64_t dt_ns;
  Pose pose;
  Twist velocity;
  Twist applied;
  const Goal& goal;
  std::uint32_t goal_index;
  std::uint32_t goal_count;
  double progress_m;
  std::uint32_t progress_waypoint;
  const Limits& limits;
  const Footprint& footprint;
  Span<Agent> agents;
  double steering_angle;
};

struct Command {
  double v_x = 0.0;    // m/s
  double v_y = 0.0;    // m/s
  double omega = 0.0;  // rad/s
};

class LocalController : public Plugin {
 public:
  // The path ends where the robot must stop. Throw to report an error.
  virtual void set_path(Path path, std::uint64_t revision) = 0;
  virtual Status step(const Observation& now, Command& command) = 0;

  DMRP_LOCAL static constexpr std::uint32_t interface_kind = DMRP_KIND_LOCAL_CONTROLLER;
  static constexpr dmrp_local_controller interface_table() {
    return {sizeof(dmrp_local_controller), 0, &call_set_path, &call_step, nullptr};
  }

 private:
  static std::int32_t call_set_path(dmrp_instance* self, const dmrp_path_update* update) {
    auto& controller = detail::from_instance<LocalController>(self);
    return PluginAccess::guarded(controller, [&] {
      controller.set_path(Path(*update->path, update->flags), update->revision);
      return Status::ok;
    });
  }
  static std::int32_t call_step(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* out) {
    auto& controller = detail::from_instance<LocalController>(self);
    return PluginAccess::guarded(controller, [&] {
      Command command;
      const Status status = controller.step(Observation(*observation), command);
      out->v_x = command.v_x;
      out->v_y = command.v_y;
      out->omega = command.omega;
      return status;
    });
  }
};

// All active robots at one control tick, and the command of each. Valid until step() returns.
class Fleet {
 public:
  explicit Fleet(const dmrp_fleet& c) : c_(&c) {}

  std::size_t size() const { return c_->count; }
  Observation operator[](std::size_t i) const {
    return Observation(*DMRP_AT(dmrp_observation, c_->observations, c_->observation_stride, i));
  }
  // The robot of observation i gets this command; zero if none is given.
  void command(std::size_t i, const Command& command) {
    dmrp_command& out = *DMRP_AT_OUT(dmrp_command, c_->commands, c_->command_stride, i);
    out.v_x = command.v_x;
    out.v_y = command.v_y;
    out.omega = command.omega;
  }
  // There is no admissible command for it: the host brakes.
  void brake(std::size_t i) {
    DMRP_AT_OUT(dmrp_command, c_->commands, c_->command_stride, i)->status = DMRP_NO_SOLUTION;
  }

 private:
  const dmrp_fleet* c_;
};

// One instance that drives all robots.
class CentralController : public Plugin {
 public:
  virtual void set_path(std::uint32_t robot, Path path, std::uint64_t revision) = 0;
  virtual Status step(Fleet& fleet) = 0;

  DMRP_LOCAL static constexpr std::uint32_t interface_kind = DMRP_KIND_LOCAL_CONTROLLER;
  DMRP_LOCAL static constexpr std::uint32_t interface_flags = DMRP_FLAG_CENTRAL;
  static constexpr dmrp_local_controller interface_table() {
    return {sizeof(dmrp_local_controller), 0, &call_set_path, nullptr, &call_step_all};
  }

 private:
  static std::int32_t call_set_path(dmrp_instance* self, const dmrp_path_update* update) {
    auto& controller = detail::from_instance<CentralController>(self);
    return PluginAccess::guarded(controller, [&] {
      controller.set_path(update->robot, Path(*update->path, update->flags), update->revision);
      return Status::ok;
    });
  }
  static std::int32_t call_step_all(dmrp_instance* self, const dmrp_fleet* c) {
    auto& controller = detail::from_instance<CentralController>(self);
    return PluginAccess::guarded(controller, [&] {
      Fleet fleet(*c);
      return controller.step(fleet);
    });
  }
};

}  // namespace dmrp
