// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dmrp::host {

namespace {

constexpr double cell_m = 1.0;

// The hall as it lies before it is turned: its lower left corner is the origin.
class Hall {
 public:
  explicit Hall(const StageSettings& settings)
      : settings_(settings), size_(settings.is_large ? dmrp_vec2{60.0, 50.0} : dmrp_vec2{16.0, 12.0}) {}

  core::Scenario scenario() const {
    core::Scenario scenario;
    scenario.name = "hall";
    const bool is_turned = settings_.quarter_turns % 2 == 1;
    const double c = settings_.corner_m;
    scenario.lower = {c, c};
    scenario.upper = {c + (is_turned ? size_.y : size_.x), c + (is_turned ? size_.x : size_.y)};
    const double middle = 0.5 * size_.x;
    if (settings_.walled_off) {
      scenario.shapes.push_back(box("wall", {middle - 0.5, 0.0}, {middle + 0.5, size_.y}));
    } else {
      scenario.shapes.push_back(box("left shelf", {middle - 4.0, 8.1}, {middle - 2.0, 8.9}));
      scenario.shapes.push_back(box("right shelf", {middle + 2.0, 8.1}, {middle + 4.0, 8.9}));
    }
    for (std::uint32_t i = 0; i < settings_.robots; ++i) scenario.robots.push_back(task(i));
    add_people(scenario);
    return scenario;
  }

 private:
  dmrp_vec2 placed(dmrp_vec2 p) const {
    const dmrp_vec2 turned[] = {p, {size_.y - p.y, p.x}, {size_.x - p.x, size_.y - p.y}, {p.y, size_.x - p.x}};
    const dmrp_vec2 at = turned[settings_.quarter_turns];
    return {settings_.corner_m + at.x, settings_.corner_m + at.y};
  }

  double heading() const { return 0.5 * std::numbers::pi * settings_.quarter_turns; }

  core::Shape box(const char* name, dmrp_vec2 lower, dmrp_vec2 upper) const {
    core::Shape shape;
    shape.name = name;
    for (const dmrp_vec2 vertex : {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}})
      shape.vertices.push_back(placed(vertex));
    return shape;
  }

  core::RobotTask task(std::uint32_t robot) const {
    const double apart_m = settings_.touching ? 2.0 * core::RobotSettings{}.radius_m + 0.01 : 2.0;
    const double y = 1.5 + apart_m * robot;
    const dmrp_vec2 start = placed({1.5, y});
    const dmrp_vec2 end = robot == 0 && settings_.starts_at_goal ? start : placed({size_.x - 1.5, y});
    core::RobotTask task;
    task.name = "robot " + std::to_string(robot);
    task.start = {start.x, start.y, std::remainder(heading(), 2.0 * std::numbers::pi)};
    task.goals = {{end.x, end.y, settings_.goals_have_headings ? 0.5 * std::numbers::pi : core::free_heading}};
    return task;
  }

  core::Region region(const char* name, dmrp_vec2 lower, dmrp_vec2 upper) const {
    const dmrp_vec2 a = placed(lower);
    const dmrp_vec2 b = placed(upper);
    return {name, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
  }

  // Couples and people who are alone, with each of the reactions.
  void add_people(core::Scenario& scenario) const {
    constexpr double margin_m = 0.5;
    const double depth_m = settings_.is_large ? 6.0 : 2.0;
    scenario.regions = {region("left", {margin_m, margin_m}, {depth_m, size_.y - margin_m}),
                        region("right", {size_.x - depth_m, margin_m}, {size_.x - margin_m, size_.y - margin_m})};
    if (settings_.people == 0 || settings_.walled_off) return;
    const std::uint32_t to_right = settings_.people / 2;
    scenario.flows = {{"to the right", {0, 1}, to_right}, {"to the left", {1, 0}, settings_.people - to_right}};
    scenario.flows[0].group_size = 2;
  }

  const StageSettings& settings_;
  dmrp_vec2 size_;
};

core::RobotSettings robot_for(const PluginInfo& info, std::uint32_t kinematics) {
  core::RobotSettings robot;
  if (info.kind != DMRP_KIND_LOCAL_CONTROLLER) return robot;
  for (const std::uint32_t one : {DMRP_KINEMATICS_DIFFERENTIAL, DMRP_KINEMATICS_HOLONOMIC, DMRP_KINEMATICS_ACKERMANN})
    if (kinematics == 0 && (info.kinematics & (1u << one)) != 0) kinematics = one;
  if (kinematics == DMRP_KINEMATICS_HOLONOMIC) {
    robot.drive = core::Drive::holonomic;
    robot.v_y_max = 0.8;
  }
  if (kinematics == DMRP_KINEMATICS_ACKERMANN) {
    robot.drive = core::Drive::ackermann;
    robot.wheelbase_m = 0.3;
  }
  return robot;
}

Experiment experiment_on(const PluginInfo& info, const StageSettings& settings, std::uint64_t seed) {
  Experiment experiment;
  experiment.seed = seed;
  experiment.robot = robot_for(info, settings.kinematics);
  experiment.simulation.tracking = core::Tracking::all;
  experiment.simulation.dispatch = settings.by_waypoint ? core::Dispatch::waypoint : core::Dispatch::full_path;
  experiment.simulation.step_duration_ns = 1'300'000'000;  // a bit more than a cell takes at full speed
  ScenarioVariant variant;
  variant.scenario = Hall(settings).scenario();
  variant.label = variant.scenario.name;
  variant.types = core::RobotTypes(experiment.robot);
  experiment.scenarios.push_back(variant);
  return experiment;
}

std::uint32_t ticks_limit = usual_ticks;

StageSettings in_time(StageSettings settings) {
  settings.ticks = most_ticks(settings.ticks);
  return settings;
}

}  // namespace

std::uint32_t most_ticks(std::uint32_t wanted) {
  return std::max(std::min(wanted, 1u), wanted * ticks_limit / usual_ticks);
}

void limit_ticks(std::uint32_t most) {
  ticks_limit = std::clamp(most, 1u, usual_ticks);
}

Stage::Stage(const PluginInfo& info, const StageSettings& chosen, std::uint64_t seed)
    : settings(in_time(chosen)),
      experiment_(experiment_on(info, chosen, seed)),
      variant(experiment_, experiment_.scenarios[0]),
      world(variant.scenario, variant.types, variant.simulation, variant.geometry, variant.routes, seed) {}

Plan Stage::straight_plan() const {
  Plan plan;
  plan.revision = 1;
  plan.status = DMRP_OK;
  plan.step_duration_ns = variant.simulation.step_duration_ns;
  for (std::uint32_t i = 0; i < world.robots().size(); ++i) {
    const dmrp_pose& from = world.robots()[i].pose;
    const dmrp_pose& to = world.goals(i).front().pose;
    const auto cells = static_cast<std::int64_t>(std::lround(std::hypot(to.x - from.x, to.y - from.y) / cell_m));
    std::vector<dmrp_waypoint> path;
    for (std::int64_t k = 0; k <= cells; ++k) {
      const double part = cells == 0 ? 0.0 : static_cast<double>(k) / static_cast<double>(cells);
      path.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y), core::free_heading,
                      k * plan.step_duration_ns, 0, 0});
    }
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

std::vector<dmrp_person> Stage::people() const {
  std::vector<dmrp_person> people(world.people().begin(), world.people().end());
  for (std::size_t i = 0; i < people.size(); ++i) {
    dmrp_person& person = people[i];
    if (settings.groups != Groups::as_drawn)
      person.group = settings.groups == Groups::none ? 0 : static_cast<std::uint32_t>(i) + 1;
    // every other person has one of the reactions
    person.reaction = person.id % 2 == 0 ? settings.reaction : DMRP_REACTION_REGULAR + (person.id / 2) % 6;
    if (settings.is_fast) person.velocity = {3.0 * person.desired_speed, 3.0};
    if (settings.at_one_place && i == 1) person.position = people[0].position;
    if (settings.is_pressed) {
      const double place = static_cast<double>(i);
      person.position = {people[0].position.x + 0.1 * std::sqrt(place) * std::cos(2.4 * place),
                         people[0].position.y + 0.1 * std::sqrt(place) * std::sin(2.4 * place)};
    }
  }
  return people;
}

std::vector<dmrp_agent> Stage::agents(std::span<const dmrp_agent> seen) const {
  std::vector<dmrp_agent> agents(seen.begin(), seen.end());
  for (dmrp_agent& agent : agents)
    if (settings.is_fast) agent.velocity = {agent.velocity.x * 5.0 + 4.0, agent.velocity.y * 5.0};
  if (settings.at_one_place && agents.size() > 1) agents[1].pose = agents[0].pose;
  return agents;
}

std::span<const dmrp_contact> Stage::step() {
  std::vector<dmrp_vec2> velocities;
  for (const dmrp_person& person : world.people()) {
    const dmrp_vec2 way = {person.target.x - person.position.x, person.target.y - person.position.y};
    const double length_m = std::max(std::hypot(way.x, way.y), 1e-9);
    velocities.push_back({way.x / length_m * person.desired_speed, way.y / length_m * person.desired_speed});
  }
  return world.step(velocities);
}

}  // namespace dmrp::host
