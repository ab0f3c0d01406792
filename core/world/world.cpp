// SPDX-License-Identifier: MIT
#include "core/world/world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "core/scene/planning_grid.hpp"
#include "core/scene/robot_task.hpp"
#include "core/world/motion_limits.hpp"

namespace dmrp::core {
namespace {

constexpr double walking_speed = 0.05;  // m/s; slower people keep their heading

std::vector<RobotState> initial_states(const Scenario& scenario) {
  std::vector<RobotState> states;
  for (const RobotTask& task : scenario.robots) {
    RobotState state;
    state.pose = start_of(task);
    state.state = task.goals.empty() ? DMRP_ROBOT_FINISHED : DMRP_ROBOT_ACTIVE;
    states.push_back(state);
  }
  return states;
}

std::vector<std::vector<dmrp_goal>> goals_of_all(const Scenario& scenario, const GoalSettings& settings) {
  std::vector<std::vector<dmrp_goal>> goals;
  for (const RobotTask& task : scenario.robots) goals.push_back(goals_of(task, settings));
  return goals;
}

std::vector<const RobotSettings*> settings_of_robots(const Scenario& scenario, const RobotTypes& types) {
  std::vector<const RobotSettings*> settings;
  for (const RobotTask& task : scenario.robots) settings.push_back(&types.of(task));
  return settings;
}

std::vector<dmrp_limits> limits_of_robots(std::span<const RobotSettings* const> settings) {
  std::vector<dmrp_limits> limits;
  for (const RobotSettings* robot : settings) limits.push_back(limits_of(*robot));
  return limits;
}

// Whether a command was beyond what the drive can do, apart from rounding.
bool exceeds(const dmrp_twist& command, const dmrp_twist& clipped) {
  constexpr double rounding = 1e-9;
  return std::abs(command.v_x - clipped.v_x) > rounding || std::abs(command.v_y - clipped.v_y) > rounding ||
         std::abs(command.omega - clipped.omega) > rounding;
}

std::vector<dmrp_vec2> positions_of(std::span<const RobotState> robots) {
  std::vector<dmrp_vec2> positions;
  for (const RobotState& robot : robots) positions.push_back(toolkit::position(robot.pose));
  return positions;
}

// The starts of all of the scenario's robots, also of those that do not take part: so the crowd at t = 0 does not
// depend on the number of robots.
std::vector<dmrp_vec2> kept_clear(const Scenario& scenario, std::vector<dmrp_vec2> robots) {
  robots.insert(robots.end(), scenario.other_starts.begin(), scenario.other_starts.end());
  return robots;
}

FlowRoutes routes_on_own_grid(const Scenario& scenario, const StaticGeometry& geometry) {
  if (walker_count(scenario) == 0) return FlowRoutes{std::vector<std::vector<Route>>(scenario.flows.size())};
  return find_flow_routes(scenario, build_walking_grid(geometry, scenario.people.radius_m));
}

bool is_at_goal(const RobotState& robot, const dmrp_goal& goal) {
  if (!(toolkit::distance(toolkit::position(robot.pose), toolkit::position(goal.pose)) < goal.tolerance_m))
    return false;
  if (!(std::hypot(robot.velocity.v_x, robot.velocity.v_y) < goal.tolerance_speed)) return false;
  return std::isnan(goal.pose.theta) ||
         std::abs(toolkit::difference(robot.pose.theta, goal.pose.theta)) < goal.tolerance_rad;
}

}  // namespace

World::World(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
             std::shared_ptr<const StaticGeometry> geometry, std::uint64_t seed)
    : World(scenario, types, simulation, geometry, routes_on_own_grid(scenario, *geometry), seed) {}

World::World(const Scenario& scenario, const RobotTypes& types, const SimulationSettings& simulation,
             std::shared_ptr<const StaticGeometry> geometry, const FlowRoutes& routes, std::uint64_t seed)
    : types_(types),
      settings_of_(settings_of_robots(scenario, types_)),
      limits_(limits_of_robots(settings_of_)),
      settings_(simulation),
      geometry_(std::move(geometry)),
      robots_(initial_states(scenario)),
      pending_commands_(robots_.size()),
      goals_(goals_of_all(scenario, simulation.goal)),
      robot_positions_(positions_of(robots_)),
      population_(scenario, geometry_, routes, seed, kept_clear(scenario, robot_positions_)),
      motion_(geometry_, simulation.step_ns),
      checks_(geometry_) {
  proposed_.resize(robots_.size());
  proposed_displacements_.resize(robots_.size());
  for (std::uint32_t i = 0; i < robots_.size(); ++i)
    bodies_.push_back({robot_positions_[i], robot_settings(i).radius_m, {}});
  if (std::any_of(settings_of_.begin(), settings_of_.end(), [](const auto* type) { return !type->parts.empty(); }))
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      outlines_.push_back({robot_settings(i).parts, robots_[i].pose.theta, 0.0});
  place_bodies_of_people();
  robot_agents_.resize(robots_.size());
  for (std::uint32_t i = 0; i < robots_.size(); ++i) check_goal(i);
  update_agents();
}

dmrp_twist World::set_command(std::uint32_t robot, const dmrp_twist& command) {
  limits_[robot].v_min = robot_settings(robot).v_min;
  return take_command(robot, command);
}

dmrp_twist World::set_recovery_command(std::uint32_t robot, const dmrp_twist& command) {
  limits_[robot].v_min = std::min(robot_settings(robot).v_min, robot_settings(robot).recovery_v_min);
  return take_command(robot, command);
}

dmrp_twist World::take_command(std::uint32_t robot, const dmrp_twist& command) {
  assert(robot < robots_.size() && is_finite(command));
  RobotState& state = robots_[robot];
  if (state.state != DMRP_ROBOT_ACTIVE) return state.command;
  const dmrp_twist clipped = clip_to_drive(command, robot_settings(robot).drive, limits_[robot]);
  if (exceeds(command, clipped)) ++state.clipped_commands;
  if (command_latency_ns(robot) == 0)
    state.command = clipped;
  else
    pending_commands_[robot].push_back({t_ns_ + command_latency_ns(robot), clipped});
  return state.command;
}

dmrp_twist World::command_at(std::uint32_t robot, std::int64_t t_ns) const {
  dmrp_twist command = robots_[robot].command;
  for (const PendingCommand& pending : pending_commands_[robot])
    if (pending.from_ns <= t_ns) command = pending.command;
  return command;
}

DriveState World::state_at_command(std::uint32_t robot) const {
  const RobotState& now = robots_[robot];
  DriveState state = {now.pose, now.velocity, now.steering_rad};
  for (std::int64_t t_ns = t_ns_; t_ns < t_ns_ + command_latency_ns(robot); t_ns += settings_.step_ns)
    state = advance(state, command_at(robot, t_ns), settings_of_[robot]->drive, limits_[robot], step_s());
  return state;
}

// Brakes without latency: the base does this itself.
void World::stop(std::uint32_t robot) {
  robots_[robot].command = {};
  pending_commands_[robot].clear();
}

void World::apply_due_commands() {
  for (std::uint32_t i = 0; i < robots_.size(); ++i)
    for (auto& pending = pending_commands_[i]; !pending.empty() && pending.front().from_ns <= t_ns_;
         pending.pop_front())
      robots_[i].command = pending.front().command;
}

void World::fail(std::uint32_t robot) {
  assert(robot < robots_.size());
  RobotState& state = robots_[robot];
  if (state.state != DMRP_ROBOT_ACTIVE) return;
  state.state = DMRP_ROBOT_FAILED;
  stop(robot);
}

std::span<const dmrp_contact> World::step(std::span<const dmrp_vec2> person_velocities) {
  assert(person_velocities.size() == people().size());
  assert(std::all_of(person_velocities.begin(), person_velocities.end(), toolkit::is_finite));
  apply_due_commands();
  propose_motion(person_velocities);
  motion_.resolve(bodies_, outlines_);
  apply_motion();
  t_ns_ += settings_.step_ns;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) check_goal(i);
  advance_people();
  update_agents();
  find_contacts();
  return contacts_;
}

void World::propose_motion(std::span<const dmrp_vec2> person_velocities) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    RobotState& robot = robots_[i];
    proposed_[i] = advance({robot.pose, robot.velocity, robot.steering_rad}, robot.command, settings_of_[i]->drive,
                           limits_[i], step_s());
    robot.velocity = proposed_[i].velocity;
    robot.steering_rad = proposed_[i].steering_rad;
    proposed_displacements_[i] = toolkit::position(proposed_[i].pose) - toolkit::position(robot.pose);
    bodies_[i].displacement = proposed_displacements_[i];
    if (outlines_.empty()) continue;
    outlines_[i].theta = robot.pose.theta;
    outlines_[i].turn_rad = toolkit::difference(robot.pose.theta, proposed_[i].pose.theta);
  }
  for (std::size_t i = 0; i < person_velocities.size(); ++i)
    bodies_[robots_.size() + i].displacement = person_velocities[i] * step_s();
  for (std::size_t i = 0; i < population_.people().size(); ++i) {
    SolidBody& body = bodies_[robots_.size() + i];
    if (const auto there = population_.position_on_track(i, t_ns_ + settings_.step_ns))
      body.displacement = *there - body.position;
  }
}

// To the proposed heading, or as far as the robot's outline can turn.
void World::turn(std::size_t i) {
  RobotState& robot = robots_[i];
  const double wish_rad = outlines_.empty() ? 0.0 : toolkit::difference(robot.pose.theta, proposed_[i].pose.theta);
  if (outlines_.empty() || outlines_[i].turn_rad == wish_rad) {
    robot.pose.theta = proposed_[i].pose.theta;
  } else {
    robot.pose.theta = toolkit::wrap(robot.pose.theta + outlines_[i].turn_rad);
    robot.velocity.omega *= outlines_[i].turn_rad / wish_rad;
  }
  if (!outlines_.empty()) outlines_[i] = {outlines_[i].parts, robot.pose.theta, 0.0};
}

void World::apply_motion() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    RobotState& robot = robots_[i];
    SolidBody& body = bodies_[i];
    turn(i);
    if (body.displacement == proposed_displacements_[i]) {
      robot.pose.x = proposed_[i].pose.x;
      robot.pose.y = proposed_[i].pose.y;
    } else {
      // after a contact, the robot keeps the speed along its intended direction; sliding sideways does not count
      const dmrp_vec2 way = proposed_displacements_[i];
      const double share = std::clamp(toolkit::dot(body.displacement, way) / toolkit::squared_norm(way), 0.0, 1.0);
      robot.velocity.v_x *= share;
      robot.velocity.v_y *= share;
      robot.pose.x += body.displacement.x;
      robot.pose.y += body.displacement.y;
    }
    robot_positions_[i] = toolkit::position(robot.pose);
    body.position = robot_positions_[i];
    body.displacement = {};
  }
  for (std::size_t i = 0; i < population_.people().size(); ++i) {
    SolidBody& body = bodies_[robots_.size() + i];
    body.position += body.displacement;
    population_.move(i, body.position, body.displacement / step_s());
    body.displacement = {};
  }
}

void World::check_goal(std::uint32_t robot) {
  RobotState& state = robots_[robot];
  if (state.state != DMRP_ROBOT_ACTIVE) return;
  if (!is_at_goal(state, goals_[robot][state.goal_index]))
    state.settling_since_ns = -1;
  else if (state.settling_since_ns < 0)
    state.settling_since_ns = t_ns_;
}

void World::visit(std::uint32_t robot) {
  assert(robots_[robot].state == DMRP_ROBOT_ACTIVE && robots_[robot].goal_index + 1 < goals_[robot].size());
  ++robots_[robot].goal_index;
  robots_[robot].settling_since_ns = -1;
}

void World::park(std::uint32_t robot) {
  RobotState& state = robots_[robot];
  assert(state.state == DMRP_ROBOT_ACTIVE);
  state.state = DMRP_ROBOT_FINISHED;
  state.settling_since_ns = -1;
  state.arrival_ns = t_ns_;
  stop(robot);
}

void World::advance_people() {
  population_.advance(t_ns_, robot_positions_);
  place_bodies_of_people();
}

void World::place_bodies_of_people() {
  bodies_.resize(robots_.size());
  for (std::size_t i = 0; i < population_.people().size(); ++i) {
    const dmrp_person& person = population_.people()[i];
    const auto response =
        population_.is_recorded(i) ? SolidBody::ContactResponse::ignore : SolidBody::ContactResponse::yield;
    bodies_.push_back({person.position, person.radius_m, {}, response});
  }
}

void World::update_agents() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotState& robot = robots_[i];
    robot_agents_[i] = {i,
                        DMRP_AGENT_ROBOT,
                        robot.state,
                        robot.pose,
                        toolkit::rotate({robot.velocity.v_x, robot.velocity.v_y}, robot.pose.theta),
                        settings_of_[i]->radius_m};
  }
  update_person_agents();
}

void World::update_person_agents() {
  person_agents_before_.swap(person_agents_);
  person_agents_.clear();
  auto before = person_agents_before_.begin();
  for (const dmrp_person& person : population_.people()) {
    // both lists are by slot, so people who were present before come in the same order
    const auto known = std::find_if(before, person_agents_before_.end(),
                                    [&](const dmrp_agent& agent) { return agent.id == person.id; });
    dmrp_agent agent{};
    agent.id = person.id;
    agent.kind = DMRP_AGENT_PERSON;
    agent.pose = {person.position.x, person.position.y, 0.0};
    if (toolkit::norm(person.velocity) > walking_speed)
      agent.pose.theta = std::atan2(person.velocity.y, person.velocity.x);
    else if (known != person_agents_before_.end())
      agent.pose.theta = known->pose.theta;
    else
      agent.pose.theta = toolkit::bearing(person.position, person.target);
    if (known != person_agents_before_.end()) before = std::next(known);
    agent.velocity = person.velocity;
    agent.radius_m = person.radius_m;
    person_agents_.push_back(agent);
  }
}

void World::find_contacts() {
  contacts_.clear();
  normals_.clear();
  turning_.clear();
  const auto robot_count = static_cast<std::uint32_t>(robots_.size());
  const auto add = [&](std::uint32_t kind, const Overlap& overlap, std::uint32_t b) {
    contacts_.push_back({kind, 0, overlap.a, b, overlap.depth_m, overlap.point, 0.0});
    normals_.push_back(overlap.normal);
  };
  motion_.find_neighbours(bodies_);
  checks_.place(bodies_, outlines_);
  checks_.with_shapes(motion_.shape_neighbours(), robot_count, contact_depth_m, overlaps_);
  for (const Overlap& overlap : overlaps_) add(DMRP_CONTACT_STATIC, overlap, overlap.b);
  checks_.between(motion_.body_neighbours(), robot_count, contact_depth_m, overlaps_);
  for (const Overlap& overlap : overlaps_)
    if (overlap.b < robot_count) add(DMRP_CONTACT_ROBOT, overlap, overlap.b);
  for (const Overlap& overlap : overlaps_)
    if (overlap.b >= robot_count) add(DMRP_CONTACT_PERSON, overlap, overlap.b - robot_count);
  for (std::size_t i = 0; i < outlines_.size(); ++i)
    turning_.push_back(outlines_[i].parts.empty() ? 0.0 : robots_[i].velocity.omega);
  tracker_.update(t_ns_, {robot_agents_, person_agents_, turning_}, normals_, contacts_);
}

}  // namespace dmrp::core
