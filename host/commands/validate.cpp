// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/identity.hpp"
#include "host/guests/probe.hpp"
#include "host/plan/check_plan_files.hpp"
#include "host/plan/check_planners.hpp"
#include "host/program/executable.hpp"
#include "host/ranking/answer.hpp"
#include "host/report/data/report_run.hpp"
#include "host/run/run_cost.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

// The newest run of this name here; empty: there is none.
fs::path last_run(const std::string& name) {
  fs::path last;
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const fs::path path = fs::path("runs") / (i == 1 ? name : fmt::format("{}-{}", name, i));
    if (!fs::is_directory(path, ignored)) return last;
    if (fs::is_regular_file(path / "results.sqlite", ignored)) last = path;
  }
}

// How many observations would show the smallest effect of interest, by how those of the last run differ; "" if there is none.
std::string power_line(const Experiment& experiment) {
  const fs::path run = last_run(experiment.name);
  if (run.empty()) return "";
  const ReportRun stored = read_report_run(run);
  const auto found =
      answers(read_summary_layout(shared_data_path() / "layouts/summary.json"), stored.metrics, stored.trials);
  if (found.empty()) return "";
  const auto needed = observations_needed(found.front(), experiment.smallest_effect);
  if (!needed) return "";
  return fmt::format("A difference of {} in {} would show with about {} (from how pairs deviate in {})",
                     experiment.smallest_effect, found.front().criteria.front().name,
                     plural(*needed, observation_name(found.front().met)), run.string());
}

int validate_command(const std::filesystem::path& file) {
  const Experiment experiment = load_experiment(file, 0, &probe_library);
  check_planners(experiment, file);
  const std::vector<std::string> without_plan = check_plan_files(experiment);
  for (const std::string& warning : experiment.warnings) warn(warning);
  for (const std::string& warning : cut_off_warnings(experiment)) warn(warning);
  for (const std::string& warning : without_plan) warn(warning);
  const std::size_t count = combinations(experiment).size();
  fmt::print("{}: good. {} of {}: {} trials, {} metrics\n", file.string(), plural(count, "combination"),
             plural(experiment.trials, "repetition"), count * experiment.trials, experiment.metrics.size());
  fmt::print("Protocol {}: the tasks and rules, without the entries\n",
             protocol_of(identity_of(experiment)).substr(0, 16));
  fmt::print("{}", map_lines(experiment));
  if (const std::string line = power_line(experiment); !line.empty()) fmt::print("{}\n", line);
  std::fflush(stdout);
  const std::optional<std::string> cost = sampled_cost(experiment, default_jobs());
  if (!cost) return exit_status::interrupted;
  if (!cost->empty())
    fmt::print("{} trials: {}, with {}\n", count * experiment.trials, *cost, plural(default_jobs(), "job"));
  return exit_status::done;
}

}  // namespace

void add_validate(CLI::App& app) {
  const auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("validate", "check an experiment without running it");
  command->add_option("experiment", *file, "experiment file")->required()->type_name("EXPERIMENT.toml");
  finish_command(command, "dmrp-host validate examples/quickstart.toml", [file] { return validate_command(*file); });
}

}  // namespace dmrp::host
