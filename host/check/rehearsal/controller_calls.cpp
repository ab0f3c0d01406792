// SPDX-License-Identifier: MIT
// A controller drives a robot along a straight plan among people, or all robots if it is central.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/rehearsal/stage_extensions.hpp"
#include "host/guests/exchange/breach.hpp"
#include "host/plugins/calls/output.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/observation.hpp"

namespace dmrp::host {

namespace {

class ControllerCalls {
 public:
  ControllerCalls(Instance& instance, const PluginInfo& info, Stage& stage)
      : instance_(instance),
        stage_(stage),
        central_(info.has_flag(DMRP_FLAG_CENTRAL)),
        first_(central_ ? 0 : stage.settings.driven),
        end_(central_ ? static_cast<std::uint32_t>(stage.world.robots().size()) : first_ + 1),
        table_(instance.table<dmrp_local_controller>()),
        extensions_(instance, info, stage, end_),
        plan_(stage.straight_plan()),
        dispatcher_(stage.variant, stage.world),
        inputs_(stage.settings.grown_bytes),
        revisions_(end_) {
    dispatcher_.set_plan(plan_);
  }

  bool next(Outputs& outputs) {
    if (tick_++ >= stage_.settings.ticks) return end();
    dispatcher_.update_targets();
    std::vector<std::uint32_t> active;
    for (std::uint32_t i = first_; i < end_; ++i)
      if (stage_.world.robots()[i].state == DMRP_ROBOT_ACTIVE) active.push_back(i);
    if (active.empty()) return end();
    for (const std::uint32_t robot : active) {
      extensions_.sensors(robot).tick();
      const PathUpdate whole = dispatcher_.take_new_path(robot);
      if (stage_.path_end != handed_end_)
        set_path(robot, cut_path(robot));
      else if (!whole.waypoints.empty())
        set_path(robot, whole);
    }
    handed_end_ = stage_.path_end;
    central_ ? step_all(active, outputs) : step(outputs);
    const auto& settings = stage_.variant.simulation;
    for (std::int64_t t_ns = 0; t_ns < settings.control_period_ns; t_ns += settings.step_ns) {
      stage_.step();
      dispatcher_.update_progress();
    }
    return true;
  }

 private:
  bool end() {
    const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_TIME_LIMIT, stage_.world.t_ns(), nullptr,
                                0,           sizeof(dmrp_robot_end)};
    instance_.end_trial(end, tick_, stage_budget_ns);
    return false;
  }

  // A host whose order, or window, ends the path there hands this over.
  PathUpdate cut_path(std::uint32_t robot) const {
    const std::span<const dmrp_waypoint> whole = plan_.paths[robot];
    const std::size_t count = std::min<std::size_t>(whole.size(), std::size_t{stage_.path_end} + 1);
    return {whole.first(count), count < whole.size() ? DMRP_PATH_PARTIAL : 0u, tick_ > 1 ? DMRP_PATH_CONTINUES : 0u};
  }

  // The dispatcher's guidance refers to the whole path: here it ends where the controller's path does.
  Guidance guidance(std::uint32_t robot) const {
    Guidance guidance = dispatcher_.guidance(robot);
    if (const std::size_t end = stage_.path_end; end + 1 < plan_.paths[robot].size()) {
      const dmrp_waypoint& from = plan_.paths[robot].front();
      const dmrp_waypoint& to = plan_.paths[robot][end];
      guidance.progress_m = std::min(guidance.progress_m, std::hypot(to.x - from.x, to.y - from.y));
      guidance.progress_waypoint = std::min(guidance.progress_waypoint, static_cast<std::uint32_t>(end));
    }
    return guidance;
  }

  void set_path(std::uint32_t robot, const PathUpdate& handed) {
    inputs_.clear();
    std::vector<dmrp_waypoint> waypoints(handed.waypoints.begin(), handed.waypoints.end());
    for (dmrp_waypoint& waypoint : waypoints) waypoint.goal_index += stage_.settings.first_goal;
    const std::uint32_t unknown_flag = stage_.settings.unknown_kinds ? 1u << 31 : 0;
    const dmrp_path path = {0, static_cast<std::uint32_t>(waypoints.size()), inputs_.stride<dmrp_waypoint>(),
                            handed.flags | unknown_flag, inputs_.array(waypoints.data(), waypoints.size())};
    const dmrp_path_update* const update = inputs_.one(
        dmrp_path_update{0, robot, ++revisions_[robot], inputs_.one(path), handed.update_flags | unknown_flag, 0});
    inputs_.seal();
    instance_.call("set_path", tick_, stage_budget_ns, Answers::no_other,
                   [&] { return table_.set_path(instance_.self(), update); });
  }

  dmrp_observation grown_observation(std::uint32_t robot, const Guidance& guidance) {
    dmrp_observation seen = observation_of(robot, guidance, stage_.variant, stage_.world, extensions_.sensors(robot));
    const std::vector<dmrp_agent> agents = stage_.agents({seen.agents, seen.agent_count});
    seen.struct_size = inputs_.stride<dmrp_observation>();
    seen.goal_index += stage_.settings.first_goal;
    seen.goal_count += stage_.settings.first_goal;
    if (stage_.settings.is_fast) seen.velocity = {3.0 * seen.limits->v_max, 0.0, -3.0 * seen.limits->omega_max};
    seen.goal = inputs_.array(seen.goal, 1);
    seen.limits = inputs_.one(*seen.limits);
    seen.footprint = inputs_.one(*seen.footprint);
    seen.agents = agents.empty() ? nullptr : inputs_.array(agents.data(), agents.size());
    seen.agent_stride = inputs_.stride<dmrp_agent>();
    return seen;
  }

  void step(Outputs& outputs) {
    inputs_.clear();
    const Guidance guided = guidance(first_);
    const dmrp_observation* const seen = inputs_.one(grown_observation(first_, guided));
    inputs_.seal();
    Output<dmrp_command> command;
    const auto result = instance_.call("step", tick_, stage_budget_ns, Answers::no_solution,
                                       [&] { return table_.step(instance_.self(), seen, &command.value); });
    command.check(instance_.site("step", tick_), "dmrp_command");
    drive(first_, command.value, result.status, "step", outputs);
  }

  void step_all(const std::vector<std::uint32_t>& active, Outputs& outputs) {
    inputs_.clear();
    std::vector<Guidance> guided;
    for (const std::uint32_t robot : active) guided.push_back(guidance(robot));
    std::vector<dmrp_observation> seen;
    for (std::size_t i = 0; i < active.size(); ++i) seen.push_back(grown_observation(active[i], guided[i]));
    // commands are the plugin's to write to: not part of the inputs that are compared
    Inputs commands_memory(stage_.settings.grown_bytes);
    const std::vector<dmrp_command> empty(active.size());
    dmrp_command* const commands = commands_memory.array(empty.data(), empty.size());
    for (std::size_t i = 0; i < active.size(); ++i)
      commands_memory.at(commands, i).struct_size = commands_memory.stride<dmrp_command>();
    const dmrp_fleet* const fleet =
        inputs_.one(dmrp_fleet{0, static_cast<std::uint32_t>(active.size()), inputs_.array(seen.data(), seen.size()),
                               inputs_.stride<dmrp_observation>(), inputs_.stride<dmrp_command>(), commands});
    inputs_.seal();
    instance_.call("step_all", tick_, stage_budget_ns, Answers::no_other,
                   [&] { return table_.step_all(instance_.self(), fleet); });
    commands_memory.check_output<dmrp_command>(active.size(), instance_.site("step_all", tick_));
    for (std::size_t i = 0; i < active.size(); ++i) {
      const dmrp_command& command = commands_memory.at(commands, i);
      drive(active[i], command, command.status, "step_all", outputs);
    }
  }

  void drive(std::uint32_t robot, const dmrp_command& command, std::int32_t status, const char* function,
             Outputs& outputs) {
    outputs.push_back(status);
    if (status != DMRP_NO_SOLUTION && status != DMRP_OK && status != DMRP_WARNING)
      throw PluginFault(fault_kind::abi_breach, instance_.site(function, tick_),
                        fmt::format("gave robot {} the status {}", robot, status));
    dmrp_twist twist{};
    if (status != DMRP_NO_SOLUTION) {
      twist = {command.v_x, command.v_y, command.omega};
      if (const std::string breach = breach_of(command); !breach.empty())
        throw PluginFault(fault_kind::bad_output, instance_.site(function, tick_), breach);
      outputs.insert(outputs.end(), {twist.v_x, twist.v_y, twist.omega});
    }
    stage_.world.set_command(robot, twist);
  }

  Instance& instance_;
  Stage& stage_;
  bool central_;
  std::uint32_t first_;  // of the robots that it drives
  std::uint32_t end_;
  dmrp_local_controller table_;
  StageExtensions extensions_;
  Plan plan_;
  Dispatcher dispatcher_;
  std::uint32_t handed_end_ = Stage::whole_path;  // of the paths
  Inputs inputs_;
  std::vector<std::uint64_t> revisions_;  // of paths, by robot
  std::int64_t tick_ = 0;
};

}  // namespace

Calls controller_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return [calls = std::make_shared<ControllerCalls>(instance, info, stage)](Outputs& outputs) {
    return calls->next(outputs);
  };
}

}  // namespace dmrp::host
