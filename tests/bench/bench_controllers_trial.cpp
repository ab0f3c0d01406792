// SPDX-License-Identifier: MIT
#include "tests/bench/bench_controllers_trial.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstring>
#include <dmrp/toolkit/random.hpp>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "core/execution/progress.hpp"
#include "core/execution/referee.hpp"
#include "core/world/world.hpp"
#include "host/plans/planning.hpp"
#include "host/trial/robot_sensors.hpp"
#include "tests/bench/bench_controllers_allocations.hpp"

namespace dmrp::bench {

namespace {

constexpr std::int64_t budget_ns = 10'000'000'000;

std::uint64_t instance_seed(std::uint64_t seed, const char* purpose, std::uint32_t index) {
  return toolkit::Stream(seed, purpose, index).next_u64();
}

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

dmrp_path path_of(const std::vector<dmrp_waypoint>& waypoints) {
  return {sizeof(dmrp_path), static_cast<std::uint32_t>(waypoints.size()), sizeof(dmrp_waypoint), 0, waypoints.data()};
}

host::Instance& start_people(const TrialUnderTest& trial, host::InstancePool& pool) {
  host::Instance& model = pool.get(trial.experiment.pedestrian_models[0], DMRP_NO_ROBOT);
  model.offer([grids = trial.variant.walking_grids](std::string_view id) -> const void* {
    return id == DMRP_EXT_WALKING_GRID ? grids->extension() : nullptr;
  });
  model.start(trial.variant.view.world(), instance_seed(trial.seed, "pedestrian_model", 0), budget_ns);
  return model;
}

// One robot while its trial is recorded.
struct Driver {
  Driver(core::Sight& sight, std::uint32_t robot, core::Lidar& lidar, std::uint64_t seed)
      : sensors(std::make_shared<host::RobotSensors>(sight, robot, lidar, seed)),
        extensions(host::readings_of(sensors_of(robot))),
        recorder([this](const std::string& id) { return extensions.extension(id); }) {}

  std::vector<std::shared_ptr<host::RobotSensors>> sensors_of(std::uint32_t robot) const {
    std::vector<std::shared_ptr<host::RobotSensors>> by_robot(robot);
    by_robot.push_back(sensors);
    return by_robot;
  }

  std::shared_ptr<host::RobotSensors> sensors;
  host::SensorReadings extensions;
  Recorder recorder;
  host::Instance* controller = nullptr;
  dmrp_local_controller table{};
  core::PathProgress progress;
  std::vector<dmrp_waypoint> path;
};

class Recording {
 public:
  Recording(const TrialUnderTest& trial, host::InstancePool& pool, bool all_sensors)
      : trial_(trial),
        all_sensors_(all_sensors),
        world_(trial.variant.scenario, trial.variant.types, trial.variant.simulation, trial.variant.geometry,
               trial.variant.routes, trial.seed),
        lidar_(trial.experiment.robot.lidar, trial.variant.geometry),
        referee_(world_, *trial.variant.planning_grids, {}, trial.seed),
        places_(world_.robots().size()),
        motions_(world_.people().size()),
        velocities_(world_.people().size()) {
    result_.tapes.resize(world_.robots().size());
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) start_driver(i, pool);
    plan(pool);
    if (!velocities_.empty()) people_ = &start_people(trial, pool);
  }

  RecordedTrial run() {
    const core::SimulationSettings& settings = trial_.variant.simulation;
    std::uint32_t ending = referee_.ending();
    while (ending == 0) {
      if (world_.t_ns() % settings.control_period_ns == 0) {
        referee_.judge_progress(places_);
        control();
      }
      walk();
      world_.step(velocities_);
      referee_.judge_arrivals(places_);
      for (std::uint32_t i = 0; i < drivers_.size(); ++i) {
        const core::RobotState& robot = world_.robots()[i];
        drivers_[i]->progress.update({robot.pose.x, robot.pose.y}, robot.goal_index);
        places_[i].arc_m = drivers_[i]->progress.progress_m();
        places_[i].passed = drivers_[i]->progress.waypoint();
      }
      ending = referee_.ending();
    }
    const auto& robots = world_.robots();
    result_.arrived = static_cast<std::uint32_t>(std::count_if(
        robots.begin(), robots.end(), [](const auto& robot) { return robot.state == DMRP_ROBOT_FINISHED; }));
    result_.sim_time_s = 1e-9 * static_cast<double>(world_.t_ns());
    return std::move(result_);
  }

 private:
  void start_driver(std::uint32_t robot, host::InstancePool& pool) {
    drivers_.push_back(std::make_unique<Driver>(sight_, robot, lidar_, trial_.seed));
    Driver& driver = *drivers_.back();
    driver.controller = &pool.get(trial_.experiment.local_controllers[0], static_cast<std::int32_t>(robot));
    driver.table = driver.controller->table<dmrp_local_controller>();
    driver.controller->offer([&driver](const char* id) { return driver.recorder.extension(id); });
    driver.controller->start(trial_.variant.view.world(), instance_seed(trial_.seed, "local_controller", robot),
                             budget_ns);
  }

  void plan(host::InstancePool& pool) {
    const host::PluginUse& use = trial_.experiment.global_planners[0];
    host::Instance& planner = pool.get(use, DMRP_NO_ROBOT);
    planner.start(trial_.variant.view.world(), instance_seed(trial_.seed, "global_planner", 0), budget_ns);
    const host::Plan plan =
        host::make_plan([&](const dmrp_planning_problem& problem) { return host::call_planner(planner, problem, 0); },
                        use.info, trial_.variant, world_, nullptr, budget_ns, 0);
    if (!plan.exists()) throw std::runtime_error("the planner found no plan");
    for (std::uint32_t i = 0; i < drivers_.size(); ++i) {
      Driver& driver = *drivers_[i];
      const dmrp_pose& pose = world_.robots()[i].pose;
      driver.path = host::path_to_drive(plan.paths[i], false, world_.goals(i), plan.step_duration_ns);
      driver.progress.set_path(driver.path, {pose.x, pose.y});
      places_[i].path = driver.path;
      const dmrp_path path = path_of(driver.path);
      const dmrp_path_update update = {sizeof(update), i, 1, &path, 0, 0};
      driver.table.set_path(driver.controller->self(), &update);
    }
  }

  void control() {
    for (std::uint32_t i = 0; i < drivers_.size(); ++i)
      if (world_.robots()[i].state == DMRP_ROBOT_ACTIVE) drivers_[i]->sensors->tick();
    for (std::uint32_t i = 0; i < drivers_.size(); ++i) {
      if (world_.robots()[i].state != DMRP_ROBOT_ACTIVE) continue;
      Driver& driver = *drivers_[i];
      Tape& tape = result_.tapes[i];
      Frame& frame = tape.emplace_back();
      if (tape.size() == 1) frame.path = driver.path;
      observe(i, frame);
      driver.recorder.write_to(frame);
      frame.status = driver.table.step(driver.controller->self(), &frame.observation, &frame.command);
      if (all_sensors_) driver.recorder.read_all(i);
      const bool is_given = frame.status == DMRP_OK || frame.status == DMRP_WARNING;
      if (!is_given && frame.status != DMRP_NO_SOLUTION)
        throw std::runtime_error(fmt::format("step() returned {}", frame.status));
      if (is_given) referee_.command_given(i);
      world_.set_command(i, is_given ? dmrp_twist{frame.command.v_x, 0.0, frame.command.omega} : dmrp_twist{});
    }
  }

  void observe(std::uint32_t robot, Frame& frame) {
    const core::RobotState& state = world_.robots()[robot];
    Driver& driver = *drivers_[robot];
    frame.agents = driver.sensors->agents();
    const dmrp_world& view = trial_.variant.view.world();
    const dmrp_robot& body = *DMRP_AT(dmrp_robot, view.robots, view.robot_stride, robot);
    dmrp_observation& now = frame.observation;
    now.struct_size = sizeof(now);
    now.robot = robot;
    now.t_ns = world_.t_ns();
    now.dt_ns = trial_.variant.simulation.control_period_ns;
    now.pose = state.pose;
    now.velocity = state.velocity;
    now.applied = state.command;
    frame.goal = world_.goals(robot)[state.goal_index];
    now.goal = &frame.goal;
    now.goal_index = state.goal_index;
    now.goal_count = static_cast<std::uint32_t>(world_.goals(robot).size());
    now.progress_m = driver.progress.progress_m();
    now.progress_waypoint = driver.progress.waypoint();
    now.goal_stride = sizeof(dmrp_goal);
    now.limits = body.limits;
    now.footprint = body.footprint;
    now.agents = frame.agents.data();
    now.agent_count = static_cast<std::uint32_t>(frame.agents.size());
    now.agent_stride = sizeof(dmrp_agent);
    frame.command.struct_size = sizeof(frame.command);
  }

  void walk() {
    if (!people_) return;
    const auto people = world_.people();
    const auto robots = world_.robot_agents();
    const dmrp_crowd crowd = {sizeof(crowd),       static_cast<std::uint32_t>(people.size()),
                              world_.t_ns(),       trial_.variant.simulation.step_ns,
                              people.data(),       robots.data(),
                              sizeof(dmrp_person), static_cast<std::uint32_t>(robots.size()),
                              sizeof(dmrp_agent),  0};
    dmrp_motions motions = {sizeof(motions), crowd.person_count, sizeof(dmrp_motion), 0, motions_.data()};
    people_->table<dmrp_pedestrian_model>().step(people_->self(), &crowd, &motions);
    std::transform(motions_.begin(), motions_.end(), velocities_.begin(),
                   [](const dmrp_motion& motion) { return motion.velocity; });
  }

  const TrialUnderTest& trial_;
  const bool all_sensors_;
  core::World world_;
  core::Sight sight_{world_};
  core::Lidar lidar_;
  core::Referee referee_;
  std::vector<core::CoursePlace> places_;
  std::vector<dmrp_motion> motions_;
  std::vector<dmrp_vec2> velocities_;
  std::vector<std::unique_ptr<Driver>> drivers_;
  host::Instance* people_ = nullptr;
  RecordedTrial result_;
};

}  // namespace

RecordedTrial record(const TrialUnderTest& trial, host::InstancePool& pool, bool all_sensors) {
  return Recording(trial, pool, all_sensors).run();
}

Replay replay(const TrialUnderTest& trial, host::InstancePool& pool, std::uint32_t robot, const Tape& tape,
              bool listens, std::size_t controller) {
  pool.clear();
  Player player(listens);
  host::Instance& instance = pool.get(trial.experiment.local_controllers[controller], static_cast<std::int32_t>(robot));
  const auto table = instance.table<dmrp_local_controller>();
  instance.offer([&player](const char* id) { return player.extension(id); });
  const std::uint64_t seed = trial.seed + controller;  // a controller that stands twice draws twice
  instance.start(trial.variant.view.world(), instance_seed(seed, "local_controller", robot), budget_ns);

  Replay replay;
  replay.commands.reserve(tape.size());
  replay.call_ms.reserve(tape.size());
  replay.allocations.reserve(tape.size());
  for (const Frame& frame : tape) {
    player.read_from(frame);
    if (!frame.path.empty()) {
      const dmrp_path path = path_of(frame.path);
      const dmrp_path_update update = {sizeof(update), robot, 1, &path, 0, 0};
      table.set_path(instance.self(), &update);
    }
    dmrp_observation observation = frame.observation;
    observation.goal = &frame.goal;
    observation.agents = frame.agents.data();
    dmrp_command command{};
    command.struct_size = sizeof(command);
    const std::uint64_t blocks = allocations();
    const double start_ms = thread_ms();
    const std::int32_t status = table.step(instance.self(), &observation, &command);
    replay.call_ms.push_back(thread_ms() - start_ms);
    replay.allocations.push_back(allocations() - blocks);
    const bool is_given = status == DMRP_OK || status == DMRP_WARNING;
    replay.commands.push_back(is_given ? std::optional(command) : std::nullopt);
    if (controller == 0 && (status != frame.status || std::memcmp(&command, &frame.command, sizeof(command)) != 0))
      throw std::runtime_error(fmt::format("robot {} answered otherwise than before at {} s", robot,
                                           1e-9 * static_cast<double>(frame.observation.t_ns)));
    if (const double iterations = player.take_iterations(); iterations >= 0.0) replay.iterations.push_back(iterations);
  }
  pool.clear();  // before the objects offered to it are destroyed
  return replay;
}

}  // namespace dmrp::bench
