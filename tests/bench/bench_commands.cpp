// SPDX-License-Identifier: MIT
// bench_commands EXPERIMENT.toml: compares controllers command by command. The experiment's first local controller drives
// its trials of the first scenario; every controller then answers what that one has observed, each tick, without moving
// anything. Rows of the differences to the first one's commands:
//
//   commands/LABEL/calls            observations
//   commands/LABEL/answered         share of them to which both gave a command
//   commands/LABEL/same             share of the commands within .01 m/s and .02 rad/s
//   commands/LABEL/v_x/median, /p90     of the difference in m/s
//   commands/LABEL/omega/median, /p90   of the difference in rad/s
//   commands/LABEL/turns_alike      share of the commands that turn by over .05 rad/s to the same side, of those where
//                                   either turns
//
// Paths are planned once.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/workers/supervisor.hpp"
#include "tests/bench/bench_controllers_trial.hpp"
#include "tests/bench/bench_rows.hpp"

namespace {

using namespace dmrp;

constexpr double same_m_s = 0.01;
constexpr double same_rad_s = 0.02;
constexpr double turning_rad_s = 0.05;

// How one controller's answers differ from the first one's.
struct Differences {
  std::size_t calls = 0;
  std::vector<double> v_x_m_s;  // where both gave a command
  std::vector<double> omega_rad_s;
  std::size_t same = 0;
  std::size_t turns = 0;
  std::size_t turns_alike = 0;
};

void add(const bench::Replay& first, const bench::Replay& other, Differences& differences) {
  differences.calls += first.commands.size();
  for (std::size_t i = 0; i < first.commands.size(); ++i) {
    if (!first.commands[i] || !other.commands[i]) continue;
    const dmrp_command& a = *first.commands[i];
    const dmrp_command& b = *other.commands[i];
    differences.v_x_m_s.push_back(std::abs(a.v_x - b.v_x));
    differences.omega_rad_s.push_back(std::abs(a.omega - b.omega));
    if (differences.v_x_m_s.back() <= same_m_s && differences.omega_rad_s.back() <= same_rad_s) ++differences.same;
    const bool a_turns = std::abs(a.omega) > turning_rad_s;
    const bool b_turns = std::abs(b.omega) > turning_rad_s;
    if (a_turns || b_turns) ++differences.turns;
    if (a_turns && b_turns && a.omega * b.omega > 0.0) ++differences.turns_alike;
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

double share(std::size_t count, std::size_t all) {
  return all == 0 ? 1.0 : static_cast<double>(count) / static_cast<double>(all);
}

void add_rows(const std::string& label, const Differences& differences, std::vector<bench::Row>& rows) {
  const std::string name = "commands/" + label;
  rows.push_back({name + "/calls", static_cast<double>(differences.calls), "1"});
  rows.push_back({name + "/answered", share(differences.v_x_m_s.size(), differences.calls), "1"});
  rows.push_back({name + "/same", share(differences.same, differences.v_x_m_s.size()), "1"});
  rows.push_back({name + "/v_x/median", quantile(differences.v_x_m_s, 0.5), "m/s"});
  rows.push_back({name + "/v_x/p90", quantile(differences.v_x_m_s, 0.9), "m/s"});
  rows.push_back({name + "/omega/median", quantile(differences.omega_rad_s, 0.5), "rad/s"});
  rows.push_back({name + "/omega/p90", quantile(differences.omega_rad_s, 0.9), "rad/s"});
  rows.push_back({name + "/turns_alike", share(differences.turns_alike, differences.turns), "1"});
}

std::vector<bench::Row> compare(const std::filesystem::path& file) {
  const auto read_descriptors = [](const std::filesystem::path& library_file, const host::VisiblePaths&) {
    const host::Library library(library_file);
    return host::Probe{library.plugins(), library.warnings(), library.objects(), ""};
  };
  const host::Experiment experiment = host::load_experiment(file, 0, read_descriptors);
  const host::ScenarioVariant& scenario = experiment.scenarios[0];
  const host::VariantWorld shared(experiment, scenario);
  host::CallNote note{};
  host::CallGuard guard(note);
  host::InstancePool pool(experiment.libraries, guard, [](std::int32_t, const std::string&, const std::string&) {});
  std::vector<Differences> differences(experiment.local_controllers.size());
  for (std::uint32_t k = 0; k < experiment.trials; ++k) {
    const host::VariantWorld variant(experiment, scenario, shared,
                                     host::task_seed(experiment, scenario.scenario.name, scenario.wishes, k));
    const bench::TrialUnderTest trial = {experiment, variant, host::trial_seed(experiment, k)};
    const bench::RecordedTrial recorded = bench::record(trial, pool, true);
    for (std::uint32_t robot = 0; robot < recorded.tapes.size(); ++robot) {
      const bench::Replay first = bench::replay(trial, pool, robot, recorded.tapes[robot], false);
      for (std::size_t i = 1; i < differences.size(); ++i)
        add(first, bench::replay(trial, pool, robot, recorded.tapes[robot], false, i), differences[i]);
    }
    pool.clear();  // instances keep pointers into their world
    std::fprintf(stderr, "trial %u: %u of %zu home\n", k, recorded.arrived, recorded.tapes.size());
  }
  std::vector<bench::Row> rows;
  for (std::size_t i = 1; i < differences.size(); ++i)
    add_rows(experiment.local_controllers[i].label, differences[i], rows);
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  std::string experiment;
  bench::Output output;
  CLI::App app("Compares controllers command by command with the experiment's first.");
  app.add_option("EXPERIMENT", experiment)->required()->check(CLI::ExistingFile);
  app.add_flag("--json", output.json, "a list of name, value, unit");
  app.add_option("--csv", output.csv, "append the values to this file")->type_name("FILE");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::write_rows(compare(experiment), output);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_commands: %s\n", error.what());
    return 1;
  }
  return 0;
}
