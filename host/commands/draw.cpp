// SPDX-License-Identifier: MIT
// Draws a scenario, with the paths of a planner if one is named.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/picture/world_picture.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/scene/robot_task.hpp"
#include "core/tasks/task_difficulty.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/figure_file.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/guests/probe.hpp"
#include "host/plan/check_planners.hpp"
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
};

void draw_shapes(core::WorldPicture& picture, const core::Scenario& scenario) {
  for (const core::Shape& shape : scenario.shapes) {
    const bool is_circle = shape.kind == core::Shape::Kind::circle;
    picture.shape({shape.name.c_str(), is_circle ? DMRP_SHAPE_CIRCLE : DMRP_SHAPE_POLYGON,
                   static_cast<std::uint32_t>(shape.vertices.size()), shape.center, shape.radius_m,
                   shape.vertices.data(), shape.height_m});
  }
}

// Above the region; at the sides of the world, so that the name stays inside.
void draw_name(core::WorldPicture& picture, const core::Scenario& scenario, const core::Region& region) {
  const double share = (middle_of(region).x - scenario.lower.x) / (scenario.upper.x - scenario.lower.x);
  if (share < 0.15)
    picture.name({region.lower.x, region.upper.y}, region.name, core::Anchor::begin);
  else if (share > 0.85)
    picture.name({region.upper.x, region.upper.y}, region.name, core::Anchor::end);
  else
    picture.name({middle_of(region).x, region.upper.y}, region.name);
}

// Arrows from region to region, on top of what is in between: people walk round it.
void draw_flows(core::WorldPicture& picture, const core::Scenario& scenario) {
  for (const core::Flow& flow : scenario.flows)
    for (std::size_t i = 1; i < flow.regions.size(); ++i)
      picture.flow(middle_of(scenario.regions[flow.regions[i - 1]]), middle_of(scenario.regions[flow.regions[i]]));
  for (const core::Region& region : scenario.regions) draw_name(picture, scenario, region);
}

void draw_robots(core::WorldPicture& picture, const Experiment& experiment, const PlannedPaths& paths) {
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::vector<dmrp_vec2> points;
    for (const dmrp_waypoint& waypoint : paths[i]) points.push_back({waypoint.x, waypoint.y});
    picture.line(core::Mark::path, i, points);
  }
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const core::RobotTask& task = scenario.robots[i];
    const core::RobotSettings& type = experiment.scenarios[0].types.of(task);
    std::vector<dmrp_polygon> parts;
    for (const core::ConvexPolygon& part : type.parts)
      parts.push_back({part.data(), static_cast<std::uint32_t>(part.size()), 0});
    const dmrp_footprint footprint = {sizeof(dmrp_footprint),
                                      static_cast<std::uint32_t>(parts.size()),
                                      type.radius_m,
                                      0.0,
                                      parts.data(),
                                      sizeof(dmrp_polygon),
                                      0};
    for (const dmrp_pose& goal : task.goals) picture.goal(i, footprint, goal);
    const dmrp_pose start = core::start_of(task);
    picture.robot(i, footprint, start);
    picture.number(i, footprint, {start.x, start.y});
    if (task.name != fmt::format("robot {}", i)) picture.name({start.x, start.y - 0.8}, task.name);
    for (const dmrp_pose& goal : task.goals) picture.number(i, footprint, {goal.x, goal.y});
  }
}

std::string document(const Experiment& experiment, const PlannedPaths& paths, core::PictureFormat format) {
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  core::WorldPicture picture({format}, scenario.lower, scenario.upper, scenario.title);
  std::vector<core::Mark> marks = {core::Mark::wall, core::Mark::furniture};
  for (const core::Region& region : scenario.regions) picture.region(region.lower, region.upper);
  if (!scenario.regions.empty()) marks.push_back(core::Mark::region);
  draw_shapes(picture, scenario);
  draw_flows(picture, scenario);
  if (!scenario.flows.empty()) marks.push_back(core::Mark::flow);
  draw_robots(picture, experiment, paths);
  if (!scenario.robots.empty()) marks.insert(marks.end(), {core::Mark::robot, core::Mark::goal});
  if (!paths.empty()) marks.push_back(core::Mark::path);
  picture.legend(marks);
  return picture.painter().document();
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
  const core::PlanningGrids grids(geometry, experiment.scenarios[0].types, simulation);
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
  const core::PictureFormat format = picture_format("--svg", options.svg);
  const bool is_planned = !options.planner.empty() || options.agents > 0;
  Experiment experiment = adhoc_experiment(options.scenario, is_planned);
  experiment.seed = options.seed;
  const core::TaskWishes wishes = wishes_of(options);
  if (options.agents > 0) use_random_tasks(experiment, options.agents, options.seed, wishes);
  if (!options.planner.empty() && experiment.scenarios[0].scenario.robots.empty())
    throw InputError(fmt::format("scenario '{}' lists no robots to plan for (--agents draws some)", options.scenario));
  if (!options.planner.empty())
    add_planner(experiment, options.planner, options.plugins, options.settings, &probe_library);
  for (const std::string& warning : experiment.warnings) warn(warning);
  for (const std::string& warning : cut_off_warnings(experiment)) warn(warning);
  fmt::print(stderr, "{}", map_lines(experiment));
  const core::Scenario& scenario = experiment.scenarios[0].scenario;
  if (is_planned && !scenario.robots.empty()) print_difficulty(experiment);
  PlannedPaths paths;
  if (!options.planner.empty()) {
    std::optional<PlannedPaths> planned = plan_once(experiment);
    if (!planned) return exit_status::faults;
    paths = std::move(*planned);
  }
  write_output("--svg", options.svg, document(experiment, paths, format));
  return exit_status::done;
}

}  // namespace

void add_draw(CLI::App& app) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App* command = app.add_subcommand("draw", "draw a scenario, optionally with planned paths");
  command->add_option("scenario", options->scenario, "a shipped scenario, or the path of a scenario.toml or of a map")
      ->required();
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
  command->add_option("--svg,--png", options->svg, "output file: .svg, .png or .pdf (default: SVG on standard output)")
      ->type_name("FILE");
  finish_command(command, "dmrp-host draw mall --agents 8 --svg mall.svg",
                 [options] { return draw_command(*options); });
}

}  // namespace dmrp::host
