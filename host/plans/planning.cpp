// SPDX-License-Identifier: MIT
#include "host/plans/planning.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/snap.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/calls/host_callback.hpp"
#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {

namespace {

// The largest distance of a robot from the cell that its plan starts in, in cells.
constexpr double snap_reach_cells = 2.0;

struct CollectedPlan {
  PlannedPaths paths;
  std::vector<bool> given;
  std::vector<bool> partial;
  std::vector<PlanStatistic> statistics;
  std::string refused;  // why the last path was
};

// Nanoseconds that the process has computed, all its threads together, to the microsecond. Other programs on the machine
// do not add to it. (CLOCK_PROCESS_CPUTIME_ID moves in ticks of milliseconds once RLIMIT_CPU is set, as in the box.)
std::int64_t processor_time_ns() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const std::int64_t seconds = used.ru_utime.tv_sec + used.ru_stime.tv_sec;
  const std::int64_t microseconds = used.ru_utime.tv_usec + used.ru_stime.tv_usec;
  return (seconds * 1'000'000 + microseconds) * 1'000;
}

std::int32_t refuse(CollectedPlan& collected, std::uint32_t robot, const std::string& why) {
  collected.refused = fmt::format(" (the host refused a path for robot {}: {})", robot, why);
  return DMRP_ERROR;
}

CollectedPlan& collected_by(dmrp_plan_sink* sink) {
  return *static_cast<CollectedPlan*>(sink->context);
}

std::int32_t collect_path(CollectedPlan& collected, std::uint32_t robot, const dmrp_path& theirs) {
  if (robot >= collected.paths.size())
    return refuse(collected, robot, fmt::format("there are {} robots", collected.paths.size()));
  if (collected.given[robot]) return refuse(collected, robot, "it has a path already");
  if (!has_v1_0<dmrp_path>(theirs.struct_size))
    return refuse(collected, robot,
                  fmt::format("its struct_size is {}, at least {}", theirs.struct_size, size_v1_0<dmrp_path>));
  const dmrp_path path = copy_struct(theirs);
  if (path.count > 0 && !path.waypoints) return refuse(collected, robot, "its waypoints are NULL");
  if (path.count > 0 && !has_stride_v1_0<dmrp_waypoint>(path.stride))
    return refuse(
        collected, robot,
        fmt::format("its stride is {}, at least {} and a multiple of 8", path.stride, size_v1_0<dmrp_waypoint>));
  if ((path.flags & ~DMRP_PATH_PARTIAL) != 0)
    return refuse(collected, robot, fmt::format("its flags are {:#x}, which this host does not know", path.flags));
  std::vector<dmrp_waypoint> waypoints;
  waypoints.reserve(path.count);
  for (std::uint32_t i = 0; i < path.count; ++i) {
    waypoints.push_back(copy_element(path.waypoints, path.stride, i));
    if (const std::uint32_t reserved = waypoints.back().reserved; reserved != 0)
      return refuse(collected, robot, fmt::format("a reserved field of its waypoints is {}, not 0", reserved));
    // one NaN for all: a stored plan has the same bits
    if (std::isnan(waypoints.back().theta)) waypoints.back().theta = core::free_heading;
  }
  collected.paths[robot] = std::move(waypoints);
  collected.given[robot] = true;
  if ((path.flags & DMRP_PATH_PARTIAL) != 0) {
    collected.partial.resize(collected.paths.size());
    collected.partial[robot] = true;
  }
  return DMRP_OK;
}

dmrp_plan_sink sink_into(CollectedPlan& collected) {
  dmrp_plan_sink sink{};
  sink.struct_size = sizeof(sink);
  sink.context = &collected;
  sink.path = [](dmrp_plan_sink* self, std::uint32_t robot, const dmrp_path* path) noexcept -> std::int32_t {
    return path ? or_out_of_memory([&] { return collect_path(collected_by(self), robot, *path); }) : DMRP_ERROR;
  };
  sink.statistic = [](dmrp_plan_sink* self, const char* name, double value) noexcept -> std::int32_t {
    if (!name) return DMRP_ERROR;
    return or_out_of_memory([&] { return collected_by(self).statistics.push_back({escaped(name), value}), DMRP_OK; });
  };
  return sink;
}

// Planners work on cells: moves a goal to the centre of its cell.
dmrp_goal on_grid(const toolkit::GridView& grid, dmrp_goal goal) {
  const dmrp_vec2 center = grid.center(grid.cell_of({goal.pose.x, goal.pose.y}));
  goal.pose.x = center.x;
  goal.pose.y = center.y;
  return goal;
}

// False if the robots cannot be put on distinct cells.
bool put_on_cells(const VariantWorld& variant, const core::World& world, const toolkit::GridView& grid,
                  const InForce* in_force, StagedProblem& problem) {
  // a robot in contact can still leave the obstacle
  const auto can_move = [&](std::size_t robot, dmrp_vec2 from, dmrp_vec2 to) {
    const double radius_m = world.robot_settings(static_cast<std::uint32_t>(robot)).radius_m;
    return variant.geometry->sweep_is_free(from, to, std::min(radius_m, variant.geometry->clearance(from)));
  };
  std::vector<toolkit::SnapRequest> requests;
  for (std::size_t i = 0; i < world.robots().size(); ++i) {
    const dmrp_vec2 position = toolkit::position(world.robots()[i].pose);
    // a robot that cannot return straight to its path will not be where the path predicts
    const bool on_path = in_force && can_move(i, position, in_force->robots[i].next_waypoint);
    requests.push_back({on_path ? in_force->robots[i].position_then : position, toolkit::no_cell});
  }
  const auto grid_of = [&](std::size_t robot) { return toolkit::GridView(*problem.robots[robot].grid); };
  const auto cells = toolkit::snap_to_own_cells(grid_of, requests, snap_reach_cells * grid.resolution_m(), can_move);
  if (!cells) return false;
  for (std::size_t i = 0; i < problem.robots.size(); ++i) problem.robots[i].start = grid.center((*cells)[i]);
  return true;
}

void describe_robots(const VariantWorld& variant, const core::World& world, const toolkit::GridView& grid,
                     StagedProblem& problem) {
  const dmrp_world& view = variant.world_for(DMRP_KIND_GLOBAL_PLANNER);
  problem.goals.resize(world.robots().size());
  for (const core::RobotSettings& type : variant.types.all())
    problem.grids[type.type] = variant.planning_grids->of(type.type).view();
  for (std::uint32_t i = 0; i < world.robots().size(); ++i) {
    const core::RobotState& state = world.robots()[i];
    const auto goals = world.goals(i);
    for (std::size_t g = state.goal_index; g < goals.size(); ++g) problem.goals[i].push_back(on_grid(grid, goals[g]));
    dmrp_planning_robot robot{};
    robot.state = state.state;
    robot.goal_count = static_cast<std::uint32_t>(problem.goals[i].size());
    robot.goals = problem.goals[i].data();
    robot.goal_stride = sizeof(dmrp_goal);
    robot.first_goal_index = state.goal_index;
    robot.grid = &problem.grids.at(world.robot_settings(i).type);
    robot.robot = DMRP_AT(dmrp_robot, view.robots, view.robot_stride, i);
    robot.pose = state.pose;
    robot.velocity = state.velocity;
    problem.robots.push_back(robot);
  }
}

}  // namespace

void to_json(nlohmann::json& json, const PlanStatistic& statistic) {
  json = nlohmann::json::array({statistic.name, statistic.value});
  if (!std::isfinite(statistic.value)) json[1] = fmt::format("{}", statistic.value);
}
void from_json(const nlohmann::json& json, PlanStatistic& statistic) {
  json.at(0).get_to(statistic.name);
  statistic.value =
      json.at(1).is_string() ? std::strtod(json.at(1).get<std::string>().c_str(), nullptr) : json.at(1).get<double>();
}

const dmrp_plan& Plan::view() {
  c_paths_.clear();
  for (std::size_t i = 0; i < paths.size(); ++i)
    c_paths_.push_back({sizeof(dmrp_path), static_cast<std::uint32_t>(paths[i].size()), sizeof(dmrp_waypoint),
                        is_partial(i) ? DMRP_PATH_PARTIAL : 0, paths[i].data()});
  c_statistics_.clear();
  for (const PlanStatistic& statistic : statistics) c_statistics_.push_back({statistic.name.c_str(), statistic.value});
  c_ = {sizeof(dmrp_plan),
        static_cast<std::uint32_t>(c_paths_.size()),
        c_paths_.data(),
        sizeof(dmrp_path),
        static_cast<std::uint32_t>(c_statistics_.size()),
        c_statistics_.data(),
        sizeof(dmrp_statistic),
        status,
        revision,
        from_ns,
        step_duration_ns,
        planning_ns,
        processor_ns};
  return c_;
}

PlannerAnswer call_planner(Instance& planner, const dmrp_planning_problem& problem, std::int64_t step) {
  CollectedPlan collected;
  collected.paths.resize(problem.robot_count);
  collected.given.resize(problem.robot_count);
  GrownStruct<dmrp_plan_sink> sink(sink_into(collected), planner.grown_bytes());
  const auto table = planner.table<dmrp_global_planner>();
  std::int64_t processor_ns = 0;
  const auto call = [&] {
    return planner.call("plan", step, problem.time_budget_ns, Answers::plan, [&] {
      const std::int64_t before_ns = processor_time_ns();
      const std::int32_t status = table.plan(planner.self(), &problem, &sink.c);
      processor_ns = processor_time_ns() - before_ns;
      return status;
    });
  };
  const auto result = with_reason(call, collected.refused);
  PlannerAnswer answer{result.status,
                       result.duration_ns,
                       processor_ns,
                       planner.guard().error(),
                       {},
                       {},
                       std::move(collected.statistics)};
  if (result.status == DMRP_NO_SOLUTION) return answer;
  if (std::find(collected.given.begin(), collected.given.end(), false) == collected.given.end())
    answer.paths = std::move(collected.paths), answer.partial = std::move(collected.partial);
  else if (result.status != DMRP_TIMEOUT)
    throw PluginFault(fault_kind::bad_output, planner.site("plan", step),
                      "returned OK without a path for every robot" + collected.refused);
  return answer;
}

std::string breach_of(const PlanVerdict& verdict, const PluginInfo& info) {
  if (!verdict.error.empty()) return "invalid plan: " + verdict.error;
  if (verdict.conflicts == 0 || info.has_flag(DMRP_FLAG_UNCOORDINATED)) return "";
  return fmt::format("invalid plan: {} ({} conflicts)", verdict.first_conflict, verdict.conflicts);
}

bool stage_problem(const VariantWorld& variant, const core::World& world, const InForce* in_force,
                   std::int64_t time_budget_ns, StagedProblem& problem) {
  problem.grid = variant.planning_grid.view();
  const toolkit::GridView grid(problem.grid);
  describe_robots(variant, world, grid, problem);
  if (!put_on_cells(variant, world, grid, in_force, problem)) return false;
  for (std::size_t i = 0; in_force && i < problem.robots.size(); ++i)
    if (problem.robots[i].state == DMRP_ROBOT_ACTIVE) problem.robots[i].waiting_ns = in_force->robots[i].waiting_ns;

  dmrp_planning_problem& c = problem.c;
  c.struct_size = sizeof(c);
  c.robot_count = static_cast<std::uint32_t>(problem.robots.size());
  c.robots = problem.robots.data();
  c.robot_stride = sizeof(dmrp_planning_robot);
  c.revision = in_force ? in_force->plan.revision + 1 : 1;
  c.now_ns = world.t_ns();
  c.effective_from_ns = world.t_ns() + variant.simulation.planning_latency_ns;
  c.step_duration_ns = variant.simulation.step_duration_ns;
  c.time_budget_ns = time_budget_ns;
  c.grid = &problem.grid;
  if (in_force) {
    c.in_force = in_force->plan.paths;
    c.in_force_count = in_force->plan.path_count;
    c.in_force_stride = in_force->plan.path_stride;
  }
  return true;
}

void stage_first_problem(const Experiment& experiment, const VariantWorld& variant, StagedProblem& problem) {
  const core::World world(variant.scenario, variant.types, variant.simulation, variant.geometry, variant.routes,
                          experiment.seed);
  if (!stage_problem(variant, world, nullptr, nanoseconds(experiment.limits.planner_time_s), problem))
    throw std::logic_error("robots of a checked scenario do not stand on distinct cells");
}

void cut_to_window(const dmrp_planning_problem& problem, PlannerAnswer& answer) {
  if (problem.window_steps == 0) return;
  const std::int64_t end_ns = problem.effective_from_ns + problem.window_steps * problem.step_duration_ns;
  answer.partial.resize(answer.paths.size());
  for (std::size_t i = 0; i < answer.paths.size(); ++i) {
    std::vector<dmrp_waypoint>& path = answer.paths[i];
    while (path.size() > 1 && path.back().t_ns > end_ns) {
      path.pop_back();
      answer.partial[i] = true;
    }
  }
}

Plan make_plan(const PlanSource& source, const PluginInfo& info, const VariantWorld& variant, const core::World& world,
               const InForce* in_force, std::int64_t time_budget_ns, std::int64_t step) {
  Plan plan;
  plan.revision = in_force ? in_force->plan.revision + 1 : 1;
  plan.from_ns = world.t_ns() + variant.simulation.planning_latency_ns;
  plan.step_duration_ns = variant.simulation.step_duration_ns;

  StagedProblem problem;
  if (!stage_problem(variant, world, in_force, time_budget_ns, problem)) return plan;
  if (info.has_flag(DMRP_FLAG_WINDOWED)) problem.c.window_steps = variant.simulation.replan.window_steps;
  static_cast<PlannerAnswer&>(plan) = source(problem.c);
  plan.answered = true;
  if (!plan.exists()) return plan;
  cut_to_window(problem.c, plan);
  const PlanVerdict verdict = validate_plan(
      problem.c, plan.paths, info.connectivity,
      [&](auto from, auto to, double radius_m) { return variant.sweep_is_free(from, to, radius_m); }, plan.partial);
  if (const std::string breach = breach_of(verdict, info); !breach.empty())
    throw PluginFault(fault_kind::bad_output, {info.id, "plan", step}, breach);
  plan.conflicts = verdict.conflicts;
  return plan;
}

std::vector<dmrp_waypoint> path_to_drive(const std::vector<dmrp_waypoint>& planned, bool partial,
                                         std::span<const dmrp_goal> goals, std::int64_t step_duration_ns) {
  std::vector<dmrp_waypoint> path;
  std::int64_t later_ns = 0;  // the duration of the legs that were inserted so far
  const auto add_leg = [&](dmrp_pose to, std::uint32_t goal_index) {
    later_ns += step_duration_ns;
    path.push_back({to.x, to.y, to.theta, path.back().t_ns + step_duration_ns, goal_index, 0});
  };
  for (std::size_t i = 0; i < planned.size(); ++i) {
    path.push_back(planned[i]);
    path.back().t_ns += later_ns;
    const std::uint32_t heads_for = planned[i].goal_index;
    const bool is_last = i + 1 == planned.size();
    if (is_last ? partial : planned[i + 1].goal_index == heads_for) continue;
    // this waypoint reaches the goal
    const dmrp_pose& goal = goals[heads_for].pose;
    if (std::hypot(planned[i].x - goal.x, planned[i].y - goal.y) > 1e-9) {
      add_leg(goal, heads_for);
      if (!is_last) add_leg({planned[i].x, planned[i].y, planned[i].theta}, planned[i + 1].goal_index);
    } else {
      path.back().theta = goal.theta;
    }
  }
  return path;
}

}  // namespace dmrp::host
