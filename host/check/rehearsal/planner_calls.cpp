// SPDX-License-Identifier: MIT
// A planner plans, and plans again as robots move on: the plan is in force, one robot was held. In some cases one
// has failed, goals are visited and added, or there are windows. Then the trial ends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/rehearsal/stage_extensions.hpp"
#include "host/plans/planning.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t latency_ns = 300'000'000;  // from a plan's call to its effect
constexpr std::uint32_t steps_between_plans = 3;  // unless there are windows
constexpr int most_plans = 3;
constexpr int most_windows = 12;

// Returns where a robot that keeps to this path is at a time.
dmrp_vec2 place_on(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  const auto next = std::find_if(path.begin(), path.end(), [&](const dmrp_waypoint& w) { return w.t_ns > t_ns; });
  if (next == path.begin()) return {path.front().x, path.front().y};
  const dmrp_waypoint& last = *std::prev(next);
  if (next == path.end()) return {last.x, last.y};
  const double part = static_cast<double>(t_ns - last.t_ns) / static_cast<double>(next->t_ns - last.t_ns);
  return {last.x + part * (next->x - last.x), last.y + part * (next->y - last.y)};
}

class PlannerCalls {
 public:
  PlannerCalls(Instance& instance, const PluginInfo& info, Stage& stage)
      : instance_(instance),
        info_(info),
        stage_(stage),
        extensions_(instance, info, stage, 0),
        inputs_(stage.settings.grown_bytes),
        robots_(stage.world.robots().size()) {}

  bool next(Outputs& outputs) {
    if (plan(outputs) && ++plans_ < (stage_.settings.window_steps > 0 ? most_windows : most_plans)) return true;
    const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_TIME_LIMIT, now_ns_, nullptr, 0, sizeof(dmrp_robot_end)};
    instance_.end_trial(end, 0, stage_budget_ns);
    return false;
  }

 private:
  struct Robot {
    std::vector<dmrp_goal> goals;  // that are left
    std::uint32_t first_goal = 0;  // the index of goals[0]
    dmrp_vec2 home{};              // where it started
    std::uint32_t state = DMRP_ROBOT_ACTIVE;
    PathPosition position;
  };

  // Whether there is a plan, and robots to plan for again.
  bool plan(Outputs& outputs) {
    StagedProblem staged;
    if (!state(staged)) return false;
    inputs_.clear();
    const dmrp_planning_problem& problem = grown(staged.c);
    inputs_.seal();
    PlannerAnswer answer = call_planner(instance_, problem, 0);
    outputs.push_back(answer.status);
    for (const auto& path : answer.paths)
      for (const dmrp_waypoint& waypoint : path)
        outputs.insert(outputs.end(), {waypoint.x, waypoint.y, waypoint.theta, static_cast<double>(waypoint.t_ns),
                                       static_cast<double>(waypoint.goal_index)});
    if (answer.paths.empty()) return false;
    cut_to_window(staged.c, answer);
    validate(staged.c, answer);
    const std::uint64_t revision = problem.revision;
    static_cast<PlannerAnswer&>(in_force_) = std::move(answer);
    in_force_.revision = revision;
    return move_on(staged.c);
  }

  // The problem for the robots where they are. False if they cannot be put on distinct cells.
  bool state(StagedProblem& staged) {
    std::vector<PathPosition> positions;
    for (const Robot& robot : robots_) positions.push_back(robot.position);
    const bool is_first = plans_ == 0;
    const InForce in_force = {in_force_.view(), positions};
    if (!stage_problem(stage_.variant, stage_.world, is_first ? nullptr : &in_force, stage_budget_ns, staged))
      return false;
    staged.c.now_ns = now_ns_;
    staged.c.effective_from_ns = now_ns_ + latency_ns;
    staged.c.window_steps = stage_.settings.window_steps;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      dmrp_planning_robot& shown = staged.robots[i];
      if (is_first) {
        robot.goals = staged.goals[i];
        robot.first_goal = stage_.settings.first_goal;
        robot.home = shown.start;
      } else {
        shown.pose = {robot.position.position_then.x, robot.position.position_then.y, shown.pose.theta};
        shown.waiting_ns = robot.position.waiting_ns;
      }
      if (plans_ == 1 && i == 0 && stage_.settings.goals_grow) {
        robot.goals.push_back(robot.goals.back());
        robot.goals.back().pose = {robot.home.x, robot.home.y, core::free_heading};
      }
      shown.goals = robot.goals.data();
      shown.goal_count = static_cast<std::uint32_t>(robot.goals.size());
      shown.first_goal_index = robot.first_goal;
      shown.state = robot.state;
    }
    return true;
  }

  void validate(const dmrp_planning_problem& problem, const PlannerAnswer& answer) const {
    const PlanVerdict verdict = validate_plan(
        problem, answer.paths, info_.connectivity,
        [&](auto from, auto to, double radius_m) { return stage_.variant.geometry->sweep_is_free(from, to, radius_m); },
        answer.partial);
    std::string breach = breach_of(verdict, info_);
    const auto rests = [](const std::vector<dmrp_waypoint>& path) {
      return std::all_of(path.begin(), path.end(), [&](const dmrp_waypoint& waypoint) {
        return waypoint.x == path.front().x && waypoint.y == path.front().y;
      });
    };
    for (std::size_t i = 0; i < answer.paths.size(); ++i)
      for (const dmrp_waypoint& waypoint : answer.paths[i])
        if (breach.empty() && std::abs(waypoint.theta) > most_heading_rad)
          breach =
              fmt::format("robot {} has the heading {} in its path, which is no angle in radians", i, waypoint.theta);
    const bool all_rest = std::all_of(answer.paths.begin(), answer.paths.end(), rests);
    bool one_drives = false;
    for (std::size_t i = 0; i < robots_.size(); ++i)
      one_drives |= robots_[i].state == DMRP_ROBOT_ACTIVE && !is_at(answer.paths[i].front(), robots_[i].goals.back());
    if (breach.empty() && problem.window_steps > 0 && all_rest && one_drives)
      breach = "no path of the window moves, though a robot is not at its last goal";
    if (!breach.empty()) throw PluginFault(fault_kind::bad_output, instance_.site("plan", 0), breach);
  }

  // Robots drive along the plan, up to the next one. False if there is nobody to plan for.
  bool move_on(const dmrp_planning_problem& problem) {
    const std::uint32_t steps = problem.window_steps > 0 ? problem.window_steps : steps_between_plans;
    const std::int64_t then_ns = problem.effective_from_ns + steps * problem.step_duration_ns;
    now_ns_ = then_ns - latency_ns;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      const auto& path = in_force_.paths[i];
      const bool is_held = plans_ == 0 && i == 1;
      const dmrp_vec2 here = place_on(path, is_held ? path.front().t_ns : then_ns);
      robot.position = {stage_place(i), here, is_held ? steps * problem.step_duration_ns : 0};
      for (const dmrp_waypoint& waypoint : path)
        while (!is_held && waypoint.t_ns <= then_ns && !robot.goals.empty() && is_at(waypoint, robot.goals.front())) {
          if (robot.goals.size() == 1) break;
          robot.goals.erase(robot.goals.begin());
          ++robot.first_goal;
        }
      const bool has_arrived = robot.goals.size() == 1 && is_at({here.x, here.y, 0.0, 0, 0, 0}, robot.goals.front());
      const bool ends_early = plans_ == 1 && i == 2 && stage_.settings.one_fails;
      if (has_arrived && stage_.settings.window_steps > 0) robot.state = DMRP_ROBOT_FINISHED;
      if (ends_early) robot.state = stage_.settings.unknown_kinds ? unknown_state : DMRP_ROBOT_FAILED;
    }
    return std::any_of(robots_.begin(), robots_.end(),
                       [](const Robot& robot) { return robot.state == DMRP_ROBOT_ACTIVE; });
  }

  static bool is_at(const dmrp_waypoint& waypoint, const dmrp_goal& goal) {
    return std::hypot(waypoint.x - goal.pose.x, waypoint.y - goal.pose.y) < 1e-6;
  }

  // The robot's place in the stage's world, which stands still. From there stage_problem() looks for a free cell.
  dmrp_vec2 stage_place(std::size_t robot) const {
    const dmrp_pose& pose = stage_.world.robots()[robot].pose;
    return {pose.x, pose.y};
  }

  const dmrp_planning_problem& grown(const dmrp_planning_problem& problem) {
    dmrp_planning_problem& out = *inputs_.one(problem);
    out.grid = inputs_.one(*problem.grid);
    dmrp_planning_robot* const robots = inputs_.array(problem.robots, problem.robot_count);
    out.robots = robots;
    out.robot_stride = inputs_.stride<dmrp_planning_robot>();
    for (std::uint32_t i = 0; i < problem.robot_count; ++i) {
      dmrp_planning_robot& robot = inputs_.at(robots, i);
      robot.goals = inputs_.array(robot.goals, robot.goal_count);
      robot.goal_stride = inputs_.stride<dmrp_goal>();
      robot.grid = inputs_.one(*robot.grid);
    }
    if (problem.in_force_count == 0) return out;
    out.in_force = inputs_.paths(problem.in_force, problem.in_force_count);
    out.in_force_stride = inputs_.stride<dmrp_path>();
    return out;
  }

  static constexpr double most_heading_rad = 12.6;  // 4 pi
  static constexpr std::uint32_t unknown_state = 1000;

  Instance& instance_;
  const PluginInfo& info_;
  Stage& stage_;
  StageExtensions extensions_;
  Inputs inputs_;
  std::vector<Robot> robots_;
  Plan in_force_;
  int plans_ = 0;
  std::int64_t now_ns_ = 0;
};

}  // namespace

Calls planner_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return [calls = std::make_shared<PlannerCalls>(instance, info, stage)](Outputs& outputs) {
    return calls->next(outputs);
  };
}

}  // namespace dmrp::host
