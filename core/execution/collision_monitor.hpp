// SPDX-License-Identifier: MIT
// collision_monitor.hpp: reduces a controller's command so that its robot can still stop before what it senses.
//
// Passive motion safety: if a collision occurs, the robot is at rest (Bouraine, Fraichard, Salhi: Provably safe
// navigation for mobile robots with limited field-of-views in dynamic environments, Autonomous Robots 32, 2012). Its
// place between controller and base, and that it scales a command instead of choosing one, are those of nav2's
// collision_monitor (github.com/ros-navigation/navigation2).
#pragma once

#include <dmrp/values.h>

#include <cstdint>

#include "core/world/world.hpp"

namespace dmrp::core {

// The gap that the monitor keeps, m. More than what a robot comes nearer between two tested poses: of 5400 random drives
// among what stands, none touched it; at 0.005 one of the first 360 did. Less than the 0.025 m that a robot of 0.25 m
// radius has to either side in a door of 0.55 m.
inline constexpr double monitor_gap_m = 0.01;

struct MonitoredCommand {
  dmrp_twist command{};
  std::uint32_t percent = 100;  // that is left of the controller's command: 100, 75, 50, 25 or 0, which brakes
};

// The largest share of the command (all its components, so the robot stays on the curve) after which the robot can stop.
// It follows what is left of the command for a control period, and then brakes to rest; while it moves, it keeps
// monitor_gap_m to the static bodies, and to the robots and people that it senses (senses()). These move on as they do
// now if the experiment tracks agents; else they stand. What touches a robot that stands is no concern of it. To what is
// nearer already, the robot comes no nearer by its own motion: so it can leave what it touches.
//
// A command of which nothing need be taken is returned to the bit.
MonitoredCommand monitored(const World& world, std::uint32_t robot, const dmrp_twist& command);

}  // namespace dmrp::core
