// SPDX-License-Identifier: MIT
// Plans once, in a child process, validates the paths and computes their figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/guests/probe.hpp"
#include "host/maps/drawn_tasks.hpp"
#include "host/plan/plan_figures.hpp"
#include "host/plan/plan_task.hpp"
#include "host/plan/planner_process.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct PlanOptions {
  fs::path map;  // either a MovingAI map, its tasks and a number of agents
  fs::path tasks;
  std::uint32_t agents = 0;
  std::uint32_t drawn = 0;  // or so many tasks drawn on the map
  std::string scenario;     // or a scenario: a name, or the path of a scenario.toml; `agents` then draws robots
  std::string planner;      // id
  std::vector<std::string> plugins;
  std::vector<std::string> settings;
  double time_limit_s = 60.0;
  std::int64_t memory_mb = 4096;  // 0: no limit
  std::uint64_t seed = 1;
  fs::path paths;  // CSV; empty: none
  bool json = false;
};

// Tolerates the rounding of sums in another order.
constexpr double same_cost = 1e-6;

// Figures that do not exist are std::nullopt.
struct Outcome {
  bool solved = false;
  std::optional<bool> valid;  // the plan keeps the contract and the promises of its planner
  std::optional<PlanFigures> figures;
  std::optional<std::uint32_t> conflicts;
  std::optional<double> lower_bound;
  std::optional<double> planning_ms;
  std::optional<double> high_level_expanded;
  std::optional<double> low_level_expanded;
  double peak_rss_mb = 0.0;
  std::string status;  // "ok", "no_solution", "timeout", or the kind of a fault
  std::string detail;  // the planner's text, or the fault's
  std::vector<std::string> warnings;
};

// Either a map with tasks or drawn ones, or a scenario; --agents draws its robots.
void check_task_options(const PlanOptions& options) {
  const bool tasks = !options.tasks.empty() && options.agents > 0 && options.drawn == 0;
  const bool drawn = options.tasks.empty() && options.agents == 0 && options.drawn > 0;
  const bool whole_map = !options.map.empty() && (tasks || drawn);
  const bool no_map = options.map.empty() && options.tasks.empty() && options.drawn == 0;
  if (options.scenario.empty() ? !whole_map : !no_map)
    throw InputError(
        "plan: needs --map, --scen and --agents together, or --map and --draw, or --scenario, with or without "
        "--agents");
}

std::unique_ptr<PlanTask> task_on_map(const PlanOptions& options, const Experiment& experiment) {
  const core::CellMap map = read_movingai_map(options.map, options.map.string());
  if (options.drawn > 0)
    return cell_task(map, draw_tasks(map, options.map.string(), options.drawn, options.seed), experiment);
  MovingAiTasks read = read_movingai_tasks(options.tasks, options.tasks.string(), map);
  if (options.agents > read.tasks.size())
    throw InputError(
        fmt::format("--agents {}: {} has {}", options.agents, read.shown_path, plural(read.tasks.size(), "task")));
  read.tasks.resize(options.agents);
  for (std::size_t b = 0; b < read.tasks.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      const auto fail = [&](const char* verb, MovingAiCell cell) {
        throw InputError(fmt::format("{}:{}:1: agents {} and {} both {} at ({}, {})", read.shown_path,
                                     read.tasks[b].line, a, b, verb, cell.x, cell.y));
      };
      if (read.tasks[a].start == read.tasks[b].start) fail("start", read.tasks[a].start);
      if (read.tasks[a].goal == read.tasks[b].goal) fail("end", read.tasks[a].goal);
    }
  if (const std::string name = fs::path(read.map_name).filename().string(); name != options.map.filename().string())
    warn(fmt::format("{}: its tasks are for '{}', not '{}'", read.shown_path, name, options.map.filename().string()));
  return cell_task(map, read.tasks, experiment);
}

std::optional<double> statistic(const PlannerAnswer& answer, const char* name) {
  for (const PlanStatistic& known : answer.statistics)
    if (known.name == name) return known.value;
  return std::nullopt;
}

// Warns if figures of the planner contradict its paths.
void compare(const PlannerAnswer& answer, Outcome& outcome) {
  const double cost = outcome.figures->cost;
  const double tolerance = same_cost * std::max(1.0, cost);
  if (const auto reported = statistic(answer, "cost"); reported && !(std::abs(*reported - cost) <= tolerance))
    outcome.warnings.push_back(fmt::format("the planner reports a cost of {}, its paths cost {}", *reported, cost));
  if (outcome.lower_bound && !(*outcome.lower_bound <= cost + tolerance))
    outcome.warnings.push_back(
        fmt::format("the planner's lower bound {} is above the cost {}", *outcome.lower_bound, cost));
}

const char* status_name(std::int32_t status) {
  if (status == DMRP_NO_SOLUTION) return "no_solution";
  return status == DMRP_TIMEOUT ? "timeout" : "ok";
}

Outcome judge(const PlannerRun& run, const PlanTask& task, const PluginInfo& info) {
  Outcome outcome;
  outcome.peak_rss_mb = run.peak_rss_mb;
  if (!run.answer) {
    outcome.status = run.fault;
    outcome.detail = run.detail;
    return outcome;
  }
  const PlannerAnswer& answer = *run.answer;
  outcome.status = status_name(answer.status);
  outcome.detail = answer.text;
  outcome.planning_ms = static_cast<double>(answer.planning_ns) * 1e-6;
  outcome.lower_bound = statistic(answer, "lower_bound");
  outcome.high_level_expanded = statistic(answer, "high_level_expanded");
  outcome.low_level_expanded = statistic(answer, "low_level_expanded");
  if (answer.paths.empty()) return outcome;

  const PlanVerdict verdict = task.validate(answer.paths, info.connectivity);
  const std::string breach = breach_of(verdict, info);
  outcome.valid = breach.empty();
  if (verdict.error.empty()) outcome.conflicts = verdict.conflicts;
  if (!breach.empty()) {
    outcome.status = fault_kind::bad_output;
    outcome.detail = fmt::format("{}: plan(): {}", info.id, breach);
    return outcome;
  }
  outcome.solved = true;
  outcome.figures = figures_of(task.problem.c, answer.paths, info.connectivity);
  compare(answer, outcome);
  return outcome;
}

bool is_fault(const Outcome& outcome) {
  return outcome.status != "ok" && outcome.status != "no_solution" && outcome.status != "timeout";
}

// Whole numbers without a fraction; null if there is no number.
nlohmann::ordered_json number(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  constexpr double largest_whole = 9007199254740992.0;
  if (*value == std::floor(*value) && std::abs(*value) < largest_whole) return static_cast<std::int64_t>(*value);
  return *value;
}

void print_json(const Outcome& outcome, std::uint32_t robots) {
  const auto& figures = outcome.figures;
  nlohmann::ordered_json json;
  json["solved"] = outcome.solved;
  json["valid"] = outcome.valid ? nlohmann::ordered_json(*outcome.valid) : nullptr;
  json["cost"] = figures ? number(figures->cost) : nullptr;
  json["lower_bound"] = number(outcome.lower_bound);
  json["makespan"] = figures ? nlohmann::ordered_json(figures->makespan) : nullptr;
  json["plan_turns"] = figures ? nlohmann::ordered_json(figures->turns) : nullptr;
  json["planning_ms"] = number(outcome.planning_ms);
  json["high_level_expanded"] = number(outcome.high_level_expanded);
  json["low_level_expanded"] = number(outcome.low_level_expanded);
  json["peak_rss_mb"] = number(outcome.peak_rss_mb);
  json["status"] = outcome.status;
  json["robots"] = robots;
  json["conflicts"] = outcome.conflicts ? nlohmann::ordered_json(*outcome.conflicts) : nullptr;
  json["detail"] = outcome.detail;
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_line(const char* name, const std::string& text) {
  fmt::print("  {:<13}{}\n", name, text);
}

void print_text(const Outcome& outcome, const std::string& heading) {
  fmt::print("{}\n", heading);
  print_line("status", outcome.detail.empty() ? outcome.status : outcome.status + ": " + outcome.detail);
  if (outcome.figures) {
    print_line("cost", fmt::format("{:.8g}", outcome.figures->cost));
    if (outcome.lower_bound) print_line("lower bound", fmt::format("{:.8g}", *outcome.lower_bound));
    print_line("makespan", plural(static_cast<std::uint64_t>(outcome.figures->makespan), "step"));
    print_line("turns", std::to_string(outcome.figures->turns));
    print_line("conflicts", std::to_string(outcome.conflicts.value_or(0)));
  } else if (outcome.lower_bound) {
    print_line("lower bound", fmt::format("{:.8g}", *outcome.lower_bound));
  }
  if (outcome.planning_ms) print_line("planning", fmt::format("{:.3f} ms", *outcome.planning_ms));
  std::vector<std::string> expanded;
  if (outcome.high_level_expanded) expanded.push_back(fmt::format("{:.0f} high level", *outcome.high_level_expanded));
  if (outcome.low_level_expanded) expanded.push_back(fmt::format("{:.0f} low level", *outcome.low_level_expanded));
  if (!expanded.empty()) print_line("expanded", fmt::format("{}", fmt::join(expanded, ", ")));
  print_line("memory", fmt::format("{:.1f} MB", outcome.peak_rss_mb));
}

int plan_command(const PlanOptions& options) {
  check_task_options(options);
  check_output_file("--paths", options.paths);
  Experiment experiment = options.map.empty() ? adhoc_experiment(options.scenario) : Experiment();
  experiment.seed = options.seed;
  experiment.limits.planner_time_s = options.time_limit_s;
  experiment.limits.memory_mb = options.memory_mb;
  if (options.map.empty() && options.agents > 0) use_random_tasks(experiment, options.agents, options.seed);
  if (options.map.empty() && experiment.scenarios[0].scenario.robots.empty())
    throw InputError(fmt::format("scenario '{}' lists no robots", options.scenario));
  add_planner(experiment, options.planner, options.plugins, options.settings, &probe_library);
  for (const std::string& text : experiment.warnings) warn(text);
  const auto task = options.map.empty() ? scenario_task(experiment) : task_on_map(options, experiment);

  const PluginInfo& info = experiment.global_planners[0].info;
  const PlannerRun run = run_planner(experiment, *task);
  const Outcome outcome = judge(run, *task, info);
  for (const std::string& text : outcome.warnings) warn(info.id + ": " + text);
  if (is_fault(outcome)) fmt::print(stderr, "{}\n", outcome.detail);
  if (!options.paths.empty()) {
    if (outcome.solved)
      write_output("--paths", options.paths, paths_csv(task->problem.c, run.answer->paths));
    else if (std::error_code ignored; fs::is_regular_file(options.paths, ignored))
      fs::remove(options.paths, ignored);  // the plan of an earlier call
  }

  if (options.json)
    print_json(outcome, task->problem.c.robot_count);
  else if (!is_fault(outcome))
    print_text(outcome, fmt::format("{} · {} · {}", info.id,
                                    options.map.empty() ? experiment.scenarios[0].label : options.map.stem().string(),
                                    plural(task->problem.c.robot_count, "robot")));
  return is_fault(outcome) ? exit_status::faults : exit_status::done;
}

}  // namespace

void add_plan(CLI::App& app) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "plan once, and print cost, time and memory");
  command->add_option("--map", options->map, "MovingAI map; cells are 1 m wide, robots have radius 0")
      ->type_name("M.map");
  command->add_option("--scen", options->tasks, "MovingAI tasks on the map")->type_name("S.scen");
  command->add_option("--agents", options->agents, "use the first N tasks; with --scenario: draw N random robots")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_option("--draw", options->drawn, "instead of --scen and --agents: draw N tasks on the map")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_option("--scenario", options->scenario, "a shipped scenario, or the path of a scenario.toml or of a map")
      ->type_name("NAME");
  command->add_option("--planner", options->planner, "global planner")->required()->type_name("ID");
  command->add_option("--plugin", options->plugins, "additional plugin library")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->add_option("--set", options->settings, "parameter of the planner")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--time-limit", options->time_limit_s, "time budget of plan(), in seconds of wall time")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--memory-limit", options->memory_mb, "memory of the planner's process in MB; 0: no limit")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40))
      ->type_name("MB")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of random robots and tasks, and of randomised planners")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--paths", options->paths, "write the paths as CSV: agent,t,x,y in cells, y from the top")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "print the figures as JSON");
  finish_command(command,
                 "dmrp-host plan --scenario mall \\\n"
                 "    --planner org.example.mine --plugin ./libmine.so",
                 [options] { return plan_command(*options); });
}

}  // namespace dmrp::host
