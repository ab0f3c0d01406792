// SPDX-License-Identifier: MIT
#include "host/trial/observation.hpp"

#include <vector>

namespace dmrp::host {

namespace {

// Moves the observation to the moment at which the answer's command takes effect. Others stay where the robot sees them.
void compensate_latency(std::uint32_t robot, const core::World& world, const core::Odometry& odometry,
                        dmrp_observation& observation) {
  const core::DriveState then = world.state_at_command(robot);
  const dmrp_twist& now = world.robots()[robot].velocity;
  observation.pose = odometry.to_estimated(then.pose);
  observation.velocity.v_x += then.velocity.v_x - now.v_x;
  observation.velocity.v_y += then.velocity.v_y - now.v_y;
  observation.velocity.omega += then.velocity.omega - now.omega;
  observation.applied = world.command_at(robot, world.t_ns() + world.command_latency_ns(robot));
  observation.steering_angle = then.steering_rad;
}

}  // namespace

dmrp_observation observation_of(std::uint32_t robot, const Guidance& guidance, const VariantWorld& variant,
                                const core::World& world, RobotSensors& sensors) {
  const core::RobotState& state = world.robots()[robot];
  const dmrp_world& view = variant.view.world();
  const dmrp_robot& body = *DMRP_AT(dmrp_robot, view.robots, view.robot_stride, robot);
  const std::vector<dmrp_agent>& agents = sensors.agents();

  dmrp_observation observation{};
  observation.struct_size = sizeof(observation);
  observation.robot = robot;
  observation.t_ns = world.t_ns();
  observation.dt_ns = variant.simulation.control_period_ns;
  observation.pose = sensors.odometry().pose();
  observation.velocity = sensors.odometry().velocity();
  observation.applied = state.command;
  observation.goal = &guidance.goal;
  observation.goal_index = state.goal_index;
  observation.goal_count = static_cast<std::uint32_t>(world.goals(robot).size());
  observation.progress_m = guidance.progress_m;
  observation.progress_waypoint = guidance.progress_waypoint;
  observation.goal_stride = sizeof(dmrp_goal);
  observation.limits = body.limits;
  observation.footprint = body.footprint;
  observation.agents = agents.data();
  observation.agent_count = static_cast<std::uint32_t>(agents.size());
  observation.agent_stride = sizeof(dmrp_agent);
  observation.steering_angle = state.steering_rad;
  if (variant.simulation.navigation.compensate_latency && world.command_latency_ns(robot) > 0)
    compensate_latency(robot, world, sensors.odometry(), observation);
  return observation;
}

}  // namespace dmrp::host
