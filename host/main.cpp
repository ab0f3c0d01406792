// SPDX-License-Identifier: MIT
#include <dmrp/abi.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/commands/commands.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/plugins/library.hpp"
#include "host/process/box.hpp"
#include "host/program/commit.hpp"
#include "host/program/version.hpp"
#include "host/terminal/colors.hpp"
#include "host/terminal/mistake_text.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/workers/worker.hpp"

namespace {

using namespace dmrp::host;

// The commands of child processes: internal, and not in the help.
std::optional<int> run_as_child(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "probe") == 0) run_probe(argv[2], std::atoi(argv[3]));
  if (argc >= 10 && std::strcmp(argv[1], "worker") == 0)
    return run_worker({argv[2],
                       static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)),
                       {std::atoll(argv[4]), std::strcmp(argv[5], "processes") == 0},
                       argv[6],
                       std::atoi(argv[7]),
                       std::atoi(argv[8]),
                       std::atoi(argv[9]),
                       {argv + 10, argv + argc}});
  return std::nullopt;
}

// `dmrp-host EXPERIMENT.toml` is `dmrp-host run EXPERIMENT.toml`, also with options before it.
std::vector<std::string> arguments_with_command(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_file = [](const std::string& argument) { return argument.ends_with(".toml"); };
  if (!arguments.empty() && (arguments[0].starts_with("-") || is_file(arguments[0])) &&
      std::any_of(arguments.begin(), arguments.end(), is_file))
    arguments.insert(arguments.begin(), "run");
  return arguments;
}

// If the standard streams are closed, the first files to be opened would take their numbers.
void open_standard_streams() {
  int descriptor = open("/dev/null", O_RDWR);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDWR);
  if (descriptor >= 0) close(descriptor);
}

std::string check_shard(const std::string& text) {
  unsigned long index = 0;
  unsigned long count = 0;
  const bool plain = text.find_first_not_of("0123456789/") == std::string::npos;  // no sign, no space
  char rest = 0;
  if (plain && std::sscanf(text.c_str(), "%lu/%lu%c", &index, &count, &rest) == 2 && index < count) return "";
  return "needs I/N with 0 <= I < N";
}

void add_run(CLI::App& app, RunOptions& options, std::string& shard, std::optional<std::uint64_t>& debugged) {
  CLI::App* command = app.add_subcommand("run", "run an experiment (also: dmrp-host EXPERIMENT.toml)");
  command->add_option("experiment", options.experiment, "experiment file")->required()->type_name("EXPERIMENT.toml");
  command->add_option("--out", options.out, "run directory (default: runs/NAME, or runs/NAME-2, ... if taken)")
      ->type_name("DIR");
  command->add_option("--jobs", options.jobs, "worker processes (default: one per core)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  CLI::Option* resume =
      command->add_flag("--resume", options.resume, "continue the run in --out: run only the trials that it lacks");
  command->add_flag("--retry-faults", options.retry_faults, "with --resume: run trials with faults again, too")
      ->needs(resume);
  command
      ->add_option("--shard", shard, "run only the trials k with k mod N = I; merge joins the parts (docs/cluster.md)")
      ->check(check_shard)
      ->type_name("I/N");
  command->add_option("--trials", options.trials, "repetitions of each combination; overrides the file")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("K");
  CLI::Option* quiet = command->add_flag("--quiet", options.quiet, "print neither progress nor results");
  command->add_flag("--json", options.json, "print the results as JSON, and no progress")->excludes(quiet);
  command->add_option("--bundle", options.bundle, "then write a folder that repeats the run elsewhere (see bundle)")
      ->type_name("DIR");
  command->add_option("--debug", debugged, "run this trial alone, in this process, without limits: for debuggers")
      ->excludes(resume)
      ->type_name("TRIAL");
}

CLI::App* add_plan(CLI::App& app, PlanOptions& options) {
  CLI::App* command = app.add_subcommand("plan", "plan once, and print cost, time and memory");
  command->add_option("--map", options.map, "MovingAI map; cells are 1 m wide, robots have radius 0")
      ->type_name("M.map");
  command->add_option("--scen", options.tasks, "MovingAI tasks on the map")->type_name("S.scen");
  command->add_option("--agents", options.agents, "use the first N tasks; with --scenario: draw N random robots")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_option("--draw", options.drawn, "instead of --scen and --agents: draw N tasks on the map")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command
      ->add_option("--scenario", options.scenario,
                   "instead of a map: a shipped scenario, or the path of a scenario.toml")
      ->type_name("NAME");
  command->add_option("--planner", options.planner, "global planner")->required()->type_name("ID");
  command->add_option("--plugin", options.plugins, "additional plugin library")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->add_option("--set", options.settings, "parameter of the planner")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--time-limit", options.time_limit_s, "time budget of plan(), in seconds of wall time")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--memory-limit", options.memory_mb, "memory of the planner's process in MB; 0: no limit")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40))
      ->type_name("MB")
      ->capture_default_str();
  command->add_option("--seed", options.seed, "seed of random robots and tasks, and of randomised planners")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--paths", options.paths, "write the paths as CSV: agent,t,x,y in cells, y from the top")
      ->type_name("FILE");
  command->add_flag("--json", options.json, "print the figures as JSON");
  return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
  CLI::App* command = app.add_subcommand("check", "test a plugin library against its contract");
  command->add_option("library", options.library, "plugin library")->required()->type_name("LIB.so");
  command->add_option("--only", options.only, "only cases whose \"ID GROUP/CASE\" matches this regular expression")
      ->type_name("REGEX");
  command->add_option("--seed", options.seed, "seed of all trials")->type_name("N")->capture_default_str();
  command->add_flag("--json", options.json, "print JSON: all cases, also those that passed");
  return command;
}

CLI::App* add_draw(CLI::App& app, DrawOptions& options) {
  CLI::App* command = app.add_subcommand("draw", "draw a scenario, optionally with planned paths");
  command->add_option("scenario", options.scenario, "a shipped scenario, or the path of a scenario.toml")->required();
  command->add_option("--agents", options.agents, "draw N random robots, as plan does, instead of the listed ones")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_option("--conflicts-min", options.conflicts_min, "tasks of --agents with so many conflicts at least")
      ->type_name("N");
  command->add_option("--conflicts-max", options.conflicts_max, "tasks of --agents with so many conflicts at most")
      ->type_name("N");
  command->add_flag("--in-corridors", options.in_corridors, "count conflicts on cells with one lane alone");
  command->add_option("--planner", options.planner, "draw the paths of this global planner")->type_name("ID");
  command->add_option("--plugin", options.plugins, "additional plugin library")->type_name("LIB.so");
  command->add_option("--set", options.settings, "parameter of the planner")->type_name("KEY=VALUE");
  command->add_option("--seed", options.seed, "seed of random robots and of randomised planners")
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* svg = command->add_option("--svg", options.svg, "output file (default: standard output)");
  svg->type_name("FILE");
  command->add_option("--png", options.png, "output file, by rsvg-convert")->type_name("FILE.png")->excludes(svg);
  return command;
}

CLI::App* add_video(CLI::App& app, VideoOptions& options) {
  CLI::App* command = app.add_subcommand("video", "make a video of a trial, by ffmpeg");
  command->add_option("run", options.run_directory, "run directory")->required()->type_name("RUN_DIR");
  command->add_option("--trial", options.trial, "trial with a recorded trace")->required()->type_name("TRIAL");
  command->add_option("--out", options.out, "output file: .mp4, .gif or .webm")->required()->type_name("FILE");
  return command;
}

CLI::App* add_discriminate(CLI::App& app, DiscriminateOptions& options) {
  CLI::App* command = app.add_subcommand("discriminate", "whether the tasks of a run tell its entries apart");
  command->add_option("run", options.runs, "run directories of the same tasks")->required()->type_name("RUN_DIR");
  command->add_option("--declared", options.declared, "the effect that was declared to count: success or time")
      ->check(CLI::IsMember({"success", "time"}))
      ->type_name("CRITERION")
      ->capture_default_str();
  CLI::Option* row = command->add_option("--row", options.factor, "print a row of a Markdown table, for this factor")
                         ->type_name("FACTOR");
  command->add_option("--contrast", options.contrast, "print how much more the second entry arrives than the first")
      ->type_name("ENTRY ENTRY")
      ->expected(2)
      ->excludes(row);
  return command;
}

CLI::App* add_evaluate(CLI::App& app, EvaluateOptions& options) {
  CLI::App* command = app.add_subcommand("evaluate", "measure the stored traces of a run, as CSV");
  command->add_option("run", options.choice.run_directory, "run directory")->required()->type_name("RUN_DIR");
  command->add_option("--metric", options.choice.metric, "metric (default: all metrics of the run and of --plugin)")
      ->type_name("ID");
  command->add_option("--plugin", options.choice.plugins, "additional plugin library, searched before the run's")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->add_option("--set", options.choice.settings, "parameter of the metric (default: as in the run)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--params-file", options.choice.parameter_file,
                   "parameters of the metric: a file, or the name of a shipped set")
      ->type_name("FILE");
  command->add_option("--trial", options.trials, "measure only this trial")->type_name("N")->allow_extra_args(false);
  command->add_option("--csv", options.csv, "output file (default: standard output)")->type_name("FILE");
  return command;
}

CLI::App* add_export(CLI::App& app, ExportOptions& options) {
  CLI::App* command = app.add_subcommand("export", "write results for papers and other programs");
  command->add_option("run", options.run_directory, "run directory")->required()->type_name("RUN_DIR");
  CLI::Option_group* formats = command->add_option_group("format");
  const auto format = [&](const char* name, ExportFormat value, const char* about) {
    return formats->add_flag_callback(
        name, [&options, value] { options.format = value; }, about);
  };
  format("--latex", ExportFormat::latex, "tables with booktabs: those of the report, or one of --rows and --columns");
  format("--csv", ExportFormat::csv, "one line a trial, with a column for each parameter, setting and metric");
  CLI::Option* svg = format("--svg", ExportFormat::svg, "one --metric over --over, as lines with 95 % intervals");
  format("--thresholds", ExportFormat::thresholds, "the levels that are passed half of the time, as an SVG figure");
  formats
      ->add_option_function<std::uint64_t>(
          "--map",
          [&options](const std::uint64_t& trial) {
            options.format = ExportFormat::map;
            options.trial = trial;
          },
          "the map of this trial with the robots' plans and ways, as an SVG figure")
      ->type_name("TRIAL");
  formats
      ->add_option_function<std::string>(
          "--table",
          [&options](const std::string& name) {
            options.format = ExportFormat::table;
            options.table = name;
          },
          "a table of the report as an SVG figure: plans, driving, ...; own: one of --rows and --columns")
      ->type_name("NAME");
  formats->require_option(1);
  command->add_option("--rows", options.rows, "scenario, robots, planner, controller, people")->delimiter(',');
  command->add_option("--columns", options.columns, "the same, across")->delimiter(',');
  command->add_option("--metric", options.metrics, "only these metrics")->delimiter(',')->type_name("NAME");
  command->add_option("--over", options.over, "robots, or a parameter or setting as --csv names it")
      ->needs(svg)
      ->capture_default_str()
      ->type_name("NAME");
  command
      ->add_option("--out", options.out,
                   "output file (default: standard output); figures also as .pdf and .png, by rsvg-convert")
      ->type_name("FILE");
  return command;
}

CLI::App* add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App* command = app.add_subcommand("compare", "compare runs of the same trials, each with the first");
  command->add_option("runs", options.runs, "run directories: before and after a change")
      ->required()
      ->expected(2, 1000)
      ->type_name("RUN_DIR");
  command->add_option("--metric", options.metrics, "metrics (default: those that the report compares)")
      ->delimiter(',')
      ->type_name("NAME");
  command
      ->add_option("--fail-if", options.fail_if,
                   "exit with 1 if the interval of the metric's difference lies beyond this, with 4 if trials cannot "
                   "decide")
      ->allow_extra_args(false)
      ->type_name("\"METRIC < X\"");
  command->add_option("--report", options.report, "write the comparison as a page, by combination, too")
      ->type_name("FILE.html");
  return command;
}

CLI::App* add_merge(CLI::App& app, MergeOptions& options) {
  CLI::App* command = app.add_subcommand("merge", "join runs of parts of one experiment (--shard)");
  command->add_option("out", options.out, "run directory to create")->required()->type_name("OUT");
  command->add_option("runs", options.runs, "run directories")->required()->type_name("RUN_DIR");
  return command;
}

CLI::App* add_bundle(CLI::App& app, BundleOptions& options) {
  CLI::App* command = app.add_subcommand("bundle", "write a folder that repeats a run or an experiment elsewhere");
  command->add_option("source", options.source, "run directory, or experiment file")
      ->required()
      ->type_name("RUN_DIR|EXPERIMENT.toml");
  command->add_option("--out", options.out, "folder to create (default: NAME-bundle)")->type_name("DIR");
  command->add_flag("--with-plugins", options.with_plugins, "copy the libraries that come with dmrp-host, too");
  return command;
}

CLI::App* add_verify(CLI::App& app, VerifyOptions& options) {
  CLI::App* command = app.add_subcommand("verify", "run some trials again, and compare them to the bit");
  command->add_option("directory", options.directory, "run directory, or bundle of one")
      ->required()
      ->type_name("RUN_DIR|BUNDLE");
  command->add_option("--trials", options.trials, "number of trials, drawn at random; all if there are fewer")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("K")
      ->capture_default_str();
  command->add_option("--seed", options.seed, "seed of the draw, and of the order")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--jobs", options.jobs, "worker processes (default: one per core)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  return command;
}

CLI::App* add_new(CLI::App& app, NewOptions& options) {
  CLI::App* command = app.add_subcommand("new", "write the folder of a new plugin, which builds at once");
  command->add_option("kind", options.kind, "planner, controller, pedestrian-model or metric")
      ->required()
      ->type_name("KIND");
  command->add_option("--id", options.id, "id of the plugin, under a domain of yours: org.example.mine")
      ->required()
      ->type_name("ID");
  command->add_option("folder", options.folder, "folder to create; an empty one may be there")
      ->required()
      ->type_name("DIR");
  return command;
}

// Throws InputError if the first argument is neither an option nor a command.
void check_command_name(CLI::App& app, const std::string& written) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (written.starts_with("-") || std::find(names.begin(), names.end(), written) != names.end()) return;
  throw InputError("dmrp-host: there is no command '" + written + "'" + did_you_mean(written, names) +
                   "; commands are " + join_names(names));
}

// "dmrp-host 0.1.0 (commit 597cdd0a1b2c, ABI v1.0, draft 2)"
std::string version_text() {
  std::string text = std::string("dmrp-host ") + version + " (commit " + commit + ", ABI v" +
                     std::to_string(DMRP_ABI_MAJOR) + "." + std::to_string(DMRP_ABI_MINOR);
  if (DMRP_ABI_DRAFT > 0) text += ", draft " + std::to_string(DMRP_ABI_DRAFT);
  return text + ")";
}

int run_main(int argc, char** argv) {
  CLI::App app("Benchmarks multi-robot motion planning among moving people.", "dmrp-host");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  CLI::Option* no_box = app.add_flag_callback("--no-box", &box::disable,
                                              "let plugins start and reach other processes: for debuggers of plugins");
  app.add_flag_callback("--sandbox", &box::demand_sandbox,
                        "let plugins write in their scratch folder alone, and open no sockets")
      ->excludes(no_box);
  app.footer(
      "Exit status: 0 done, 1 some trials ended in a fault, 2 bad input, 3 the machine failed (full disk, no memory),\n"
      "130 interrupted.");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("dmrp-host: ") + error.what() + " (see --help)\n";
  });

  RunOptions run;
  run.jobs = std::max(1u, std::thread::hardware_concurrency());
  std::string shard;
  std::optional<std::uint64_t> debugged;
  add_run(app, run, shard, debugged);

  std::filesystem::path validated;
  CLI::App* validate = app.add_subcommand("validate", "check an experiment without running it");
  validate->add_option("experiment", validated, "experiment file")->required()->type_name("EXPERIMENT.toml");

  std::vector<std::string> libraries;
  bool json = false;
  bool markdown = false;
  CLI::App* plugins = app.add_subcommand("plugins", "list the plugins of libraries, with their parameters");
  plugins->add_option("libraries", libraries, "libraries (default: all libraries of the plugin path)")
      ->type_name("LIB.so");
  CLI::Option* as_json = plugins->add_flag("--json", json, "print JSON");
  plugins->add_flag("--markdown", markdown, "print a reference page in Markdown")->excludes(as_json);

  CheckOptions check;
  CLI::App* checking = add_check(app, check);

  DrawOptions draw;
  CLI::App* drawing = add_draw(app, draw);

  VideoOptions video;
  CLI::App* filming = add_video(app, video);

  EvaluateOptions evaluate;
  CLI::App* evaluating = add_evaluate(app, evaluate);

  DiscriminateOptions discriminate;
  CLI::App* discriminating = add_discriminate(app, discriminate);

  MergeOptions merge;
  CLI::App* merging = add_merge(app, merge);

  BundleOptions bundle;
  CLI::App* bundling = add_bundle(app, bundle);

  VerifyOptions verify;
  verify.jobs = run.jobs;
  CLI::App* verifying = add_verify(app, verify);

  CompareOptions compare;
  CLI::App* comparing = add_compare(app, compare);

  ExportOptions exported;
  CLI::App* exporting = add_export(app, exported);

  PlanOptions plan;
  CLI::App* planning = add_plan(app, plan);

  std::string listed_format;
  CLI::App* listing = app.add_subcommand("keys", "list the keys of experiment or scenario files, with their defaults");
  listing->add_option("format", listed_format, "experiment or scenario")
      ->required()
      ->check(CLI::IsMember({"experiment", "scenario"}))
      ->type_name("FORMAT");

  NewOptions new_plugin;
  CLI::App* beginning = add_new(app, new_plugin);

  std::filesystem::path reported;
  CLI::App* report = app.add_subcommand("report", "write report.html: the results of a run in one file");
  report->add_option("run", reported, "run directory")->required()->type_name("RUN_DIR");
  std::vector<std::uint64_t> replayed;
  report->add_option("--replay", replayed, "trial to replay, in addition to the chosen ones")->type_name("TRIAL");

  std::vector<std::string> arguments = arguments_with_command(argc, argv);
  if (arguments.empty()) {
    std::fputs(app.help().c_str(), stdout);
    return exit_status::done;
  }
  check_command_name(app, arguments.front());
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_status::done : exit_status::bad_input;
  }

  if (const std::string gaps = box::sandbox_gaps(); !gaps.empty())
    std::fprintf(stderr, "warning: --sandbox: %s\n", gaps.c_str());
  if (validate->parsed()) return validate_command(validated);
  if (plugins->parsed())
    return plugins_command(libraries, json       ? PluginsFormat::json
                                      : markdown ? PluginsFormat::markdown
                                                 : PluginsFormat::text);
  if (checking->parsed()) return check_command(check);
  if (drawing->parsed()) return draw_command(draw);
  if (filming->parsed()) return video_command(video);
  if (planning->parsed()) return plan_command(plan);
  if (comparing->parsed()) return compare_command(compare);
  if (exporting->parsed()) return export_command(exported);
  if (report->parsed()) return report_command(reported, replayed);
  if (listing->parsed()) return keys_command(listed_format);
  if (beginning->parsed()) return new_command(new_plugin);
  if (bundling->parsed()) return bundle_command(bundle);
  if (verifying->parsed()) return verify_command(verify);
  if (merging->parsed()) return merge_command(merge, std::vector<std::string>(argv, argv + argc));
  if (evaluating->parsed()) return evaluate_command(evaluate);
  if (discriminating->parsed()) return discriminate_command(discriminate);
  if (debugged) return debug_command(run.experiment, run.trials, *debugged);
  if (!shard.empty()) std::sscanf(shard.c_str(), "%lu/%lu", &run.shard.index, &run.shard.count);
  return run_command(run, std::vector<std::string>(argv, argv + argc));
}

// What was printed is buffered: a full disk shows only here.
void flush_output() {
  if (std::fflush(stdout) != 0) throw MachineError("standard output", errno);
  if (std::ferror(stdout)) throw MachineError("standard output: not everything could be written");
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of `ulimit -f`: write() fails instead
  if (const auto status = run_as_child(argc, argv)) return *status;
  try {
    const int status = run_main(argc, argv);
    flush_output();
    return status;
  } catch (const InputError& error) {
    std::fputs(mistake_text(error, has_colors(STDERR_FILENO)).c_str(), stderr);
    return exit_status::bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dmrp-host: %s\n", error_text(error).c_str());
    return is_machine_failure(error) ? exit_status::machine_failed : exit_status::bad_input;
  }
}
