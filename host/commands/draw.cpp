// SPDX-License-Identifier: MIT
// Draws a scenario, with the paths of a planner if one is named.
#include <fmt/format.h>

#include <cstdio>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/svg.hpp>
#include <memory>
#include <optional>

#include "core/scene/planning_grids.hpp"
#include "core/scene/robot_task.hpp"
#include "core/tasks/task_difficulty.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/figure_file.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/guests/probe.hpp"
#include "host/plan/plan_task.hpp"
#include "host/plan/planner_process.hpp"
#include "host/process/fault_kind.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/scenario/scenario_variant.hpp"

namespace dmrp::host {

namespace {

struct DrawOptions {
  std::string scenario;
  std::uint32_t agents = 0;  // random robots that replace the scenario's; 0: keep the scenario's
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> conflicts_min;  // of random robots (core/tasks/task_generator.hpp), as the next two
  std::optional<std::uint32_t> conflicts_max;
  bool in_corridors = false;
  std::string planner;                // id; empty: no plan
  std::vector<std::string> plugins;   // libraries, in addition to the plugin path
  std::vector<std::string> settings;  // key=value for the planner
  std::filesystem::path svg;          // empty: standard output; also a .png or .pdf
  std::filesystem::path png;          // instead of `svg`
};

constexpr double wall_height_m = 2.0;    // lower shapes are furniture
constexpr double left_margin_px = 36.0;  // for the coordinates

void draw_shapes(toolkit::SvgPlan& picture, const core::Scenario& scenario) {
  for (const core::Shape& shape : scenario.shapes) {
    const char* look = shape.height_m >= wall_height_m ? "wall" : "furniture";
    if (shape.kind == core::Shape::Kind::circle)
      picture.circle(shape.center, shape.radius_m, {look}, shape.name);
    else
      picture.polygon(shape.vertices, {look}, shape.name);
  }
}

void draw_regions(toolkit::SvgPlan& picture, const core::Scenario& scenario) {
  for (const core::Region& region : scenario.regions)
    picture.rectangle({region.lower, region.upper}, {"region"}, region.name);
}

// Above the region; at the sides of the world, so that the name stays inside.
void draw_name(toolkit::SvgPlan& picture, const core::Scenario& scenario, const core::Region& region) {
  const double share = (middle_of(region).x - scenario.lower.x) / (scenario.upper.x - scenario.lower.x);
  if (share < 0.15)
    picture.text({region.lower.x, region.upper.y}, region.name, {"name begins"});
  else if (share > 0.85)
    picture.text({region.upper.x, region.upper.y}, region.name, {"name ends"});
  else
    picture.text({middle_of(region).x, region.upper.y}, region.name, {"name"});
}

// Arrows from region to region, on top of what is in between: people walk round it.
void draw_flows(toolkit::SvgPlan& picture, const core::Scenario& scenario) {
  for (const core::Flow& flow : scenario.flows)
    for (std::size_t i = 1; i < flow.regions.size(); ++i)
      picture.arrow(middle_of(scenario.regions[flow.regions[i - 1]]), middle_of(scenario.regions[flow.regions[i]]),
                    {"flow"});
  for (const core::Region& region : scenario.regions) draw_name(picture, scenario, region);
}

// The footprint at a pose; its circle where the heading is free.
void draw_footprint(toolkit::SvgPlan& picture, const core::RobotSettings& type, const dmrp_pose& pose,
                    const toolkit::SvgStyle& style, const std::string& title) {
  if (type.parts.empty() || std::isnan(pose.theta))
    return picture.circle({pose.x, pose.y}, type.radius_m, style, title);
  for (const core::ConvexPolygon& part : type.parts) picture.polygon(toolkit::to_world(pose, part), style, title);
}

void draw_robots(toolkit::SvgPlan& picture, const Experiment& experiment, const PlannedPaths* paths) {
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const core::RobotTask& task = scenario.robots[i];
    const core::RobotSettings& type = experiment.scenarios[0].types.of(task);
    const auto color = toolkit::series_color(i);
    if (paths) {
      std::vector<dmrp_vec2> points;
      for (const dmrp_waypoint& w : (*paths)[i]) points.push_back({w.x, w.y});
      picture.polyline(points, {"path", color}, fmt::format("path of {}", task.name));
    }
    for (const dmrp_pose& goal : task.goals)
      draw_footprint(picture, type, goal, {"goal", color}, fmt::format("goal of {}", task.name));
    const dmrp_pose start = core::start_of(task);
    draw_footprint(picture, type, start, {"robot", color},
                   type.type.empty() ? task.name : fmt::format("{} ({})", task.name, type.type));
    picture.arrow({start.x, start.y}, {start.x + 0.6 * std::cos(start.theta), start.y + 0.6 * std::sin(start.theta)},
                  {"heading", color});
    picture.text({start.x + 0.4, start.y + 0.4}, std::to_string(i), {"label", color});
    if (task.name != fmt::format("robot {}", i)) picture.text({start.x, start.y - 0.8}, task.name, {"name"});
    for (const dmrp_pose& goal : task.goals)
      picture.text({goal.x + 0.4, goal.y + 0.4}, std::to_string(i), {"label", color});
  }
}

core::TaskWishes wishes_of(const DrawOptions& options) {
  core::TaskWishes wishes;
  if (!options.conflicts_min && !options.conflicts_max && !options.in_corridors) return wishes;
  if (options.agents == 0) throw InputError("--conflicts-min, --conflicts-max and --in-corridors need --agents");
  wishes.drawn = 1;
  wishes.conflicts_min = options.conflicts_min.value_or(0);
  wishes.conflicts_max = options.conflicts_max.value_or(core::any_number);
  if (wishes.conflicts_min > wishes.conflicts_max)
    throw InputError(
        fmt::format("--conflicts-min {}: is more than --conflicts-max {}", wishes.conflicts_min, wishes.conflicts_max));
  if (options.in_corridors) wishes.crossing = core::Crossing::corridor;
  return wishes;
}

// How difficult the tasks are, on standard error.
void print_difficulty(const Experiment& experiment) {
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  const core::SimulationSettings& simulation = experiment.simulation;
  const core::StaticGeometry geometry(scenario);
  const core::PlanningGrids grids(geometry, experiment.scenarios[0].types, simulation.grid_resolution_m,
                                  simulation.planning_margin_m);
  const core::TaskDifficulty difficulty =
      core::difficulty_of(grids.common(types_in_use(experiment.scenarios[0])), scenario.robots);
  fmt::print(stderr, "{} robot{}: {} pair{} of individual paths in conflict, {} in corridors", scenario.robots.size(),
             scenario.robots.size() == 1 ? "" : "s", difficulty.conflicts, difficulty.conflicts == 1 ? "" : "s",
             difficulty.corridor_conflicts);
  if (difficulty.slack_steps)
    fmt::print(stderr, ", least slack of the others {} steps ({:.1f} s)", *difficulty.slack_steps,
               *difficulty.slack_steps * static_cast<double>(simulation.step_duration_ns) * 1e-9);
  fmt::print(stderr, "{}\n", difficulty.well_formed ? "" : ", robots stand in each other's only way");
}

// Plans once, in a child process, and prints the length, the time and the planner's statistics on standard error, or the
// planner's fault.
std::optional<PlannedPaths> plan_once(const Experiment& experiment) {
  const PluginInfo& info = experiment.global_planners[0].info;
  const std::unique_ptr<PlanTask> task = scenario_task(experiment);
  PlannerRun run = run_planner(experiment, *task);
  const auto fault = [](const std::string& kind, const std::string& detail) {
    fmt::print(stderr, "{}: {}\n", kind, detail);
    return std::nullopt;
  };
  if (!run.answer) return fault(run.fault, run.detail);
  PlannerAnswer& answer = *run.answer;
  if (answer.paths.empty()) throw std::runtime_error(info.id + " found no plan");
  if (const std::string breach = breach_of(task->validate(answer.paths, info.connectivity), info); !breach.empty())
    return fault(fault_kind::bad_output, fmt::format("{}: plan(): {}", info.id, breach));

  double total_m = 0.0;
  for (const auto& path : answer.paths)
    for (std::size_t i = 1; i < path.size(); ++i)
      total_m += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
  fmt::print(stderr, "{}: {:.2f} m in all, {:.2f} ms", info.id, total_m,
             static_cast<double>(answer.planning_ns) * 1e-6);
  for (const PlanStatistic& statistic : answer.statistics)
    fmt::print(stderr, ", {} {}", statistic.name, statistic.value);
  fmt::print(stderr, "\n");
  return std::move(answer.paths);
}

int draw_command(const DrawOptions& options) {
  check_output_file("--svg", options.svg);
  check_output_file("--png", options.png);
  if (!options.png.empty() && options.png.extension() != ".png")
    throw InputError(fmt::format("--png {}: does not end in .png", options.png.string()));
  const bool is_planned = !options.planner.empty() || options.agents > 0;
  Experiment experiment = adhoc_experiment(options.scenario, is_planned);
  experiment.seed = options.seed;
  const core::TaskWishes wishes = wishes_of(options);
  if (options.agents > 0) use_random_tasks(experiment, options.agents, options.seed, wishes);
  if (!options.planner.empty() && experiment.scenarios[0].scenario.robots.empty())
    throw InputError(fmt::format("scenario '{}' lists no robots to plan for (--agents draws some)", options.scenario));
  if (!options.planner.empty())
    add_planner(experiment, options.planner, options.plugins, options.settings, &probe_library);
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  if (is_planned && !scenario.robots.empty()) print_difficulty(experiment);
  toolkit::SvgPlan picture({scenario.lower, scenario.upper}, scenario.title, 800.0, left_margin_px);
  picture.axes();
  draw_regions(picture, scenario);
  draw_shapes(picture, scenario);
  draw_flows(picture, scenario);
  if (options.planner.empty()) {
    draw_robots(picture, experiment, nullptr);
  } else {
    const std::optional<PlannedPaths> paths = plan_once(experiment);
    if (!paths) return exit_status::faults;
    draw_robots(picture, experiment, &*paths);
  }
  picture.scale_bar(5.0);
  write_figure(options.png.empty() ? "--svg" : "--png", options.png.empty() ? options.svg : options.png,
               picture.document());
  return exit_status::done;
}

}  // namespace

void add_draw(CLI::App& app) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App* command = app.add_subcommand("draw", "draw a scenario, optionally with planned paths");
  command->add_option("scenario", options->scenario, "a shipped scenario, or the path of a scenario.toml")->required();
  command->add_option("--agents", options->agents, "draw N random robots, as plan does, instead of the listed ones")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_option("--conflicts-min", options->conflicts_min, "tasks of --agents with so many conflicts at least")
      ->type_name("N");
  command->add_option("--conflicts-max", options->conflicts_max, "tasks of --agents with so many conflicts at most")
      ->type_name("N");
  command->add_flag("--in-corridors", options->in_corridors, "count conflicts on cells with one lane alone");
  command->add_option("--planner", options->planner, "draw the paths of this global planner")->type_name("ID");
  command->add_option("--plugin", options->plugins, "additional plugin library")->type_name("LIB.so");
  command->add_option("--set", options->settings, "parameter of the planner")->type_name("KEY=VALUE");
  command->add_option("--seed", options->seed, "seed of random robots and of randomised planners")
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* svg = command->add_option("--svg", options->svg, "output file (default: standard output)");
  svg->type_name("FILE");
  command->add_option("--png", options->png, "output file, by rsvg-convert")->type_name("FILE.png")->excludes(svg);
  finish_command(command, "dmrp-host draw mall --agents 8 --svg mall.svg",
                 [options] { return draw_command(*options); });
}

}  // namespace dmrp::host
