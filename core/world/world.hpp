// SPDX-License-Identifier: MIT
// world.hpp: the simulated world of one trial. It owns no plugins and no clock: the caller steps it with velocities.
#pragma once

#include <dmrp/pedestrian_model.h>
#include <dmrp/sample.h>

#include <cassert>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "core/people/population.hpp"
#include "core/scene/robot_types.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/world/collision_checks.hpp"
#include "core/world/contact_events.hpp"
#include "core/world/drive.hpp"
#include "core/world/solid_motion.hpp"

namespace dmrp::core {

struct RobotState {
  dmrp_pose pose{};
  dmrp_twist velocity{};      // actual
  dmrp_twist command{};       // in effect, within the velocity limits
  double steering_rad = 0.0;  // Ackermann only
  std::uint32_t state = 0;    // DMRP_ROBOT_*
  std::uint32_t goal_index = 0;
  std::int64_t settling_since_ns = -1;  // since then the robot meets the current goal's conditions; -1: it does not
  std::int64_t arrival_ns = -1;         // at the last goal; -1: not yet
  std::uint64_t clipped_commands = 0;   // commands beyond the ability of its drive
};

class World {
 public:
  World(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
        std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes, std::uint64_t seed);

  // Computes the flows' routes itself, which takes longer than seconds of simulation.
  World(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
        std::shared_ptr<const StaticGeometry> geometry, std::uint64_t seed);

  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::int64_t t_ns() const { return t_ns_; }
  const StaticGeometry& geometry() const { return *geometry_; }
  const RobotSettings& robot_settings(std::uint32_t robot) const {
    assert(robot < robots_.size());
    return *settings_of_[robot];
  }
  const SimulationSettings& settings() const { return settings_; }

  std::span<const RobotState> robots() const { return robots_; }
  std::span<const dmrp_goal> goals(std::uint32_t robot) const { return goals_[robot]; }

  // Robots by index and present people by slot, as others see them.
  std::span<const dmrp_agent> robot_agents() const { return robot_agents_; }
  std::span<const dmrp_agent> person_agents() const { return person_agents_; }

  // The input of pedestrian models, by slot: parallel to person_agents().
  std::span<const dmrp_person> people() const { return population_.people(); }

  // Whether the person at this place of people() follows a track.
  bool is_recorded(std::size_t place) const { return population_.is_recorded(place); }

  // There are no robots and no people, and no people will appear.
  bool is_deserted() const { return robots_.empty() && population_.is_over(t_ns_); }

  // Sets the robot's command, clipped to the ability of its drive. It takes effect at once, or at the first step after the
  // latencies of control and actuation, and stays until the next one. Must be finite. Has no effect on a robot that is
  // not active. Returns the command that is in effect now.
  dmrp_twist set_command(std::uint32_t robot, const dmrp_twist& command);

  // As set_command(); the robot may drive backwards as fast as its type allows in a recovery, until the next command.
  dmrp_twist set_recovery_command(std::uint32_t robot, const dmrp_twist& command);

  // Returns the time from a command to its effect.
  std::int64_t command_latency_ns(std::uint32_t robot) const {
    return settings_.control_latency_ns + robot_settings(robot).actuation_latency_ns;
  }

  // The command that is in effect at this time, now or later, if no other one is set.
  dmrp_twist command_at(std::uint32_t robot, std::int64_t t_ns) const;

  // The robot as it will be when a command that is made now takes effect, if nothing is in its way.
  DriveState state_at_command(std::uint32_t robot) const;

  // The next goal of an active robot, which it has, becomes current.
  void visit(std::uint32_t robot);

  // Ends the robot's task: it brakes and stays where it stops. park(): at its last goal; fail(): anywhere.
  void park(std::uint32_t robot);
  void fail(std::uint32_t robot);

  // One physics step. Robots follow their commands within their acceleration limits; people move at the given
  // velocities (parallel to people(), world frame, finite). Bodies stop where they would move deeper into each other,
  // and people push people (solid_motion.hpp). Then people arrive at regions. Recorded people
  // follow their tracks, whatever their velocities: bodies in their way cannot approach them, but are not pushed.
  // Returns the contacts after the step, ordered by kind, a, b; valid until the next step.
  std::span<const dmrp_contact> step(std::span<const dmrp_vec2> person_velocities);

  // Of the last step.
  std::span<const dmrp_contact> contacts() const { return contacts_; }

 private:
  // A command that has not taken effect.
  struct PendingCommand {
    std::int64_t from_ns;
    dmrp_twist command;
  };

  dmrp_twist take_command(std::uint32_t robot, const dmrp_twist& command);
  void stop(std::uint32_t robot);
  void apply_due_commands();
  void propose_motion(std::span<const dmrp_vec2> person_velocities);
  void turn(std::size_t robot);
  void apply_motion();
  void check_goal(std::uint32_t robot);
  void advance_people();
  void update_agents();
  void update_person_agents();
  void place_bodies_of_people();
  void find_contacts();
  double step_s() const { return 1e-9 * static_cast<double>(settings_.step_ns); }

  RobotTypes types_;
  std::vector<const RobotSettings*> settings_of_;  // by robot, in types_
  std::vector<dmrp_limits> limits_;                // by robot, for the command in force
  SimulationSettings settings_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::int64_t t_ns_ = 0;
  std::vector<RobotState> robots_;
  std::vector<std::deque<PendingCommand>> pending_commands_;  // by robot, in order of time
  std::vector<std::vector<dmrp_goal>> goals_;
  std::vector<dmrp_vec2> robot_positions_;
  Population population_;
  SolidMotion motion_;
  CollisionChecks checks_;
  ContactTracker tracker_;
  std::vector<SolidBody> bodies_;                  // robots, then people
  std::vector<SolidOutline> outlines_;             // of robots; empty if all are discs
  std::vector<DriveState> proposed_;               // of robots, without contacts
  std::vector<dmrp_vec2> proposed_displacements_;  // of robots
  std::vector<Overlap> overlaps_;
  std::vector<dmrp_agent> robot_agents_;
  std::vector<dmrp_agent> person_agents_;
  std::vector<dmrp_agent> person_agents_before_;  // of the previous step
  std::vector<dmrp_contact> contacts_;
  std::vector<dmrp_vec2> normals_;  // of contacts_
  std::vector<double> turning_;     // of outlines_, rad/s
};

}  // namespace dmrp::core
