// SPDX-License-Identifier: MIT
#include "core/execution/collision_monitor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "core/execution/sensed_bodies.hpp"
#include "core/scene/robot_task.hpp"
#include "core/scene/touching.hpp"
#include "core/world/drive.hpp"

namespace dmrp::core {
namespace {

// A pose is tested after each step in which the next one could lead farther than this from the pose tested before.
constexpr double untested_m = 0.03;
constexpr double untested_rad = 0.05;

double speed_of(const dmrp_twist& velocity) {
  return std::hypot(velocity.v_x, velocity.v_y);
}

// What a robot could meet before it stands.
class StoppingWay {
 public:
  StoppingWay(const World& world, std::uint32_t robot, const dmrp_twist& command)
      : world_(world), robot_(robot), type_(world.robot_settings(robot)), limits_(limits_of(type_)) {
    const RobotState& now = world.robots()[robot];
    start_ = {now.pose, now.velocity, now.steering_rad};
    latency_ns_ = world.command_latency_ns(robot);
    braking_ns_ = latency_ns_ + world.settings().control_period_ns;
    find_what_is_in_reach(command);
  }

  bool is_empty() const { return !static_in_reach_ && agents_.empty(); }

  // Whether the robot can stop before all of it, if it follows the command for a control period and then brakes.
  bool allows(const dmrp_twist& command) const {
    const std::int64_t step_ns = world_.settings().step_ns;
    const double step_s = 1e-9 * static_cast<double>(step_ns);
    DriveState state = start_;
    dmrp_pose tested = start_.pose;
    double moved_m = 0.0, turned_rad = 0.0;  // since then
    for (std::int64_t t_ns = 0; t_ns < braking_ns_ || !stands(state); t_ns += step_ns) {
      state = advance(state, in_effect(command, t_ns), type_.drive, limits_, step_s);
      const bool moves = !stands(state);
      const double step_m = moves ? step_s * (speed_of(state.velocity) + agents_speed_) : 0.0;
      const double step_rad = moves ? step_s * std::abs(state.velocity.omega) : 0.0;
      moved_m += step_m;
      turned_rad += step_rad;
      const bool due =
          moves ? moved_m + step_m > untested_m || turned_rad + step_rad > untested_rad : moved_m + turned_rad > 0.0;
      if (!due) continue;
      if (comes_near(tested, state.pose, 1e-9 * static_cast<double>(t_ns + step_ns))) return false;
      tested = state.pose;
      moved_m = turned_rad = 0.0;
    }
    return true;
  }

 private:
  struct Agent {
    Body body;  // where it is now
    dmrp_vec2 velocity;
    bool is_near;  // already nearer than the gap
  };

  // A disc may turn where it stands.
  bool stands(const DriveState& state) const {
    return speed_of(state.velocity) == 0.0 && (type_.parts.empty() || state.velocity.omega == 0.0);
  }

  dmrp_twist in_effect(const dmrp_twist& command, std::int64_t t_ns) const {
    if (t_ns < latency_ns_) return world_.command_at(robot_, world_.t_ns() + t_ns);
    return t_ns < braking_ns_ ? command : dmrp_twist{};
  }

  void find_what_is_in_reach(const dmrp_twist& command) {
    double speed = std::max(speed_of(start_.velocity), speed_of(command));
    double turning = std::max(std::abs(start_.velocity.omega), std::abs(command.omega));
    if (latency_ns_ > 0) {
      speed = std::max(speed, std::hypot(std::max(limits_.v_max, -limits_.v_min), limits_.v_y_max));
      turning = std::max(turning, limits_.omega_max);
    }
    const double driven_s = 1e-9 * static_cast<double>(braking_ns_ + world_.settings().step_ns);
    const double braked_s = std::max(speed / limits_.a_max, type_.parts.empty() ? 0.0 : turning / limits_.alpha_max);
    const double reach_m = speed * driven_s + 0.5 * speed * speed / limits_.a_max + monitor_gap_m + type_.radius_m;
    static_in_reach_ = world_.geometry().clearance(toolkit::position(start_.pose)) < reach_m;
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i)
      if (i != robot_ && is_in_reach(world_.robot_agents()[i], reach_m, driven_s + braked_s))
        add(world_.robot_agents()[i], body_of(world_.robot_settings(i), world_.robots()[i].pose));
    for (const dmrp_agent& person : world_.person_agents())
      if (is_in_reach(person, reach_m, driven_s + braked_s))
        add(person, {toolkit::position(person.pose), person.radius_m, {}});
  }

  dmrp_vec2 velocity_of(const dmrp_agent& agent) const {
    return world_.settings().tracking == Tracking::none ? dmrp_vec2{} : agent.velocity;
  }

  bool is_in_reach(const dmrp_agent& agent, double reach_m, double time_s) const {
    const dmrp_vec2 velocity = velocity_of(agent);
    const double far_m = reach_m + agent.radius_m + time_s * (std::abs(velocity.x) + std::abs(velocity.y));
    return std::abs(agent.pose.x - start_.pose.x) < far_m && std::abs(agent.pose.y - start_.pose.y) < far_m &&
           senses(world_, robot_, agent);
  }

  void add(const dmrp_agent& agent, const Body& body) {
    agents_.push_back({body, velocity_of(agent), false});
    agents_.back().is_near = gap_to(agents_.back(), start_.pose, 0.0) < monitor_gap_m;
    agents_speed_ = std::max(agents_speed_, toolkit::norm(agents_.back().velocity));
  }

  double gap_to(const Agent& agent, const dmrp_pose& pose, double t_s) const {
    const dmrp_vec2 way = agent.velocity * t_s;  // the robot is moved back by it instead
    return gap_between(body_of(type_, {pose.x - way.x, pose.y - way.y, pose.theta}), agent.body);
  }

  double gap_to_walls(const dmrp_pose& pose) const {
    return gap_to_static(world_.geometry(), body_of(type_, pose), monitor_gap_m);
  }

  bool comes_near(const dmrp_pose& from, const dmrp_pose& to, double t_s) const {
    if (static_in_reach_) {
      const double gap_m = gap_to_walls(to);
      if (gap_m < monitor_gap_m && gap_m < gap_to_walls(from) - touching_m) return true;
    }
    return std::any_of(agents_.begin(), agents_.end(), [&](const Agent& agent) {
      const double gap_m = gap_to(agent, to, t_s);
      return gap_m < monitor_gap_m && (!agent.is_near || gap_m < gap_to(agent, from, t_s) - touching_m);
    });
  }

  const World& world_;
  const std::uint32_t robot_;
  const RobotSettings& type_;
  const dmrp_limits limits_;
  DriveState start_;
  std::int64_t latency_ns_ = 0;
  std::int64_t braking_ns_ = 0;  // from then on it brakes
  bool static_in_reach_ = false;
  std::vector<Agent> agents_;
  double agents_speed_ = 0.0;  // of the fastest
};

}  // namespace

MonitoredCommand monitored(const World& world, std::uint32_t robot, const dmrp_twist& command) {
  assert(robot < world.robots().size());
  const RobotSettings& type = world.robot_settings(robot);
  const dmrp_twist wish = clip_to_drive(command, type.drive, limits_of(type));
  if (wish.v_x == 0.0 && wish.v_y == 0.0 && wish.omega == 0.0) return {command, 100};  // it brakes already
  const StoppingWay way(world, robot, wish);
  if (way.is_empty() || way.allows(wish)) return {command, 100};
  for (const std::uint32_t percent : {75u, 50u, 25u}) {
    const double share = 0.01 * percent;
    const dmrp_twist left = {share * wish.v_x, share * wish.v_y, share * wish.omega};
    if (way.allows(left)) return {left, percent};
  }
  return {dmrp_twist{}, 0};
}

}  // namespace dmrp::core
