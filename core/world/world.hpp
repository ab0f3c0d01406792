// SPDX-License-Identifier: MIT
// world.hpp: the simulated world of one trial. It owns no plugin and no clock: who steps it decides who moves how.
#pragma once

#include <dmrp/metric.h>
#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "core/people/population.hpp"
#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"
#include "core/scene/static_geometry.hpp"
#include "core/world/contact_events.hpp"
#include "core/world/solid_motion.hpp"

namespace dmrp::core {

struct RobotState {
  dmrp_pose pose{};
  dmrp_twist velocity{};    // actual
  dmrp_twist command{};     // in force, within the velocity limits
  std::uint32_t state = 0;  // DMRP_ROBOT_*
  std::uint32_t goal_index = 0;
  std::int64_t settling_since_ns = -1;  // the current goal's conditions hold since then; -1: they don't
  std::int64_t arrival_ns = -1;         // of the last goal
};

class World {
 public:
  World(const Scenario& scenario, const RobotSettings& robot, const SimulationSettings& simulation,
        std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes, std::uint64_t seed);

  // Finds the flows' routes itself, which takes longer than many a second of simulation.
  World(const Scenario& scenario, const RobotSettings& robot, const SimulationSettings& simulation,
        std::shared_ptr<const StaticGeometry> geometry, std::uint64_t seed);

  std::int64_t t_ns() const { return t_ns_; }
  const StaticGeometry& geometry() const { return *geometry_; }
  const RobotSettings& robot_settings() const { return robot_settings_; }
  const SimulationSettings& settings() const { return settings_; }

  std::span<const RobotState> robots() const { return robots_; }
  std::span<const dmrp_goal> goals(std::uint32_t robot) const { return goals_[robot]; }

  // All robots as others see them, by index; all people who are there likewise, by slot.
  std::span<const dmrp_agent> robot_agents() const { return robot_agents_; }
  std::span<const dmrp_agent> person_agents() const { return person_agents_; }

  // What a pedestrian model is told, by slot: parallel to person_agents().
  std::span<const dmrp_person> people() const { return population_.people(); }

  // There are no robots, nobody is left and nobody will come.
  bool is_deserted() const { return robots_.empty() && population_.is_over(t_ns_); }

  // Sets the command, clipped to the velocity limits, that is in force until the next one: from now on, or from the
  // first step after the latencies of control and actuation. Must be finite. Ignored for a robot that is not active.
  // Returns what is in force now.
  dmrp_twist set_command(std::uint32_t robot, const dmrp_twist& command);

  // Gives a robot up: it brakes and stands where it is.
  void fail(std::uint32_t robot);

  // One physics step: robots follow their commands within their accelerations, people move at these velocities
  // (parallel to people(), world frame, finite), bodies stop where they would get deeper into each other (people who
  // press into each other push each other: see solid_motion.hpp), robots arrive, people reach their regions. Recorded
  // people go along their tracks whatever velocities they are given: the track wins over everybody in the way, who can
  // move no nearer but is not pushed. Returns the contacts after it, ordered by kind, a, b; valid until the next step.
  std::span<const dmrp_contact> step(std::span<const dmrp_vec2> person_velocities);

  // Of the last step.
  std::span<const dmrp_contact> contacts() const { return contacts_; }

 private:
  // A command on its way.
  struct Coming {
    std::int64_t from_ns;
    dmrp_twist command;
  };

  std::int64_t command_latency_ns() const {
    return settings_.control_latency_ns + robot_settings_.actuation_latency_ns;
  }
  void stop(std::uint32_t robot);
  void take_up_commands();
  void propose_motion(std::span<const dmrp_vec2> person_velocities);
  void apply_motion();
  void check_arrival(std::uint32_t robot);
  void advance_people();
  void show_agents();
  void show_people();
  void place_bodies_of_people();
  void find_contacts();
  double step_s() const { return 1e-9 * static_cast<double>(settings_.step_ns); }

  RobotSettings robot_settings_;
  SimulationSettings settings_;
  dmrp_limits limits_;
  std::shared_ptr<const StaticGeometry> geometry_;
  std::int64_t t_ns_ = 0;
  std::vector<RobotState> robots_;
  std::vector<std::deque<Coming>> coming_;  // by robot, in order of time
  std::vector<std::vector<dmrp_goal>> goals_;
  std::vector<dmrp_vec2> robot_positions_;
  Population population_;
  SolidMotion motion_;
  ContactTracker tracker_;
  std::vector<SolidBody> bodies_;                  // robots, then people
  std::vector<dmrp_pose> proposed_poses_;          // of robots, unhindered
  std::vector<dmrp_vec2> proposed_displacements_;  // of robots
  std::vector<Overlap> overlaps_;
  std::vector<dmrp_agent> robot_agents_;
  std::vector<dmrp_agent> person_agents_;
  std::vector<dmrp_agent> person_agents_before_;  // the step before
  std::vector<dmrp_contact> contacts_;
};

}  // namespace dmrp::core
