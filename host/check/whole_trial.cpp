// SPDX-License-Identifier: MIT
#include "host/check/whole_trial.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/errors/input_error.hpp"
#include "host/experiment/experiment.hpp"
#include "host/files/read_file.hpp"
#include "host/files/temporary_folder.hpp"
#include "host/guests/probe.hpp"
#include "host/program/executable.hpp"
#include "host/workers/supervisor.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

namespace {

constexpr const char* room = R"([scenario]
name = "room"
title = "Room"
description = "two robots and a few people cross a room"
size_m = [8.0, 6.0]
time_limit_s = 8.0

[[robot]]
name = "lower"
start = [1.5, 1.5]
goal = [6.5, 1.5]

[[robot]]
name = "upper"
start = [1.5, 3.5]
goal = [6.5, 3.5]

[[region]]
name = "left"
lower_m = [0.5, 4.2]
upper_m = [1.5, 5.5]

[[region]]
name = "right"
lower_m = [6.5, 4.2]
upper_m = [7.5, 5.5]

[[flow]]
name = "people"
from = "left"
to = "right"
people = 3
)";

const char* drive_of(const PluginInfo& plugin) {
  const auto drives = [&](std::uint32_t kinematics) { return (plugin.kinematics & (1u << kinematics)) != 0; };
  if (plugin.kind != DMRP_KIND_LOCAL_CONTROLLER || drives(DMRP_KINEMATICS_DIFFERENTIAL)) return "";
  return drives(DMRP_KINEMATICS_HOLONOMIC) ? "drive = \"holonomic\"\nv_y_max = 0.8\n"
                                           : "drive = \"ackermann\"\nwheelbase_m = 0.3\n";
}

std::string experiment_with(const fs::path& file, const PluginInfo& plugin, std::uint64_t seed) {
  constexpr std::array tables = {"global_planner", "local_controller", "pedestrian_model", "metric"};  // by kind
  const fs::path partners_file = shared_data_path() / "layouts/check_partners.json";
  const auto partners = nlohmann::json::parse(read_file(partners_file, partners_file.string()));
  std::string libraries = fmt::format("\"{}\"", file.string());
  std::string uses;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& partner = partners.at(tables[i]);
    const auto library = partner.at("library").get<std::string>();
    if (file.filename() != library) libraries += fmt::format(", \"{}\"", library);
    const bool is_checked = plugin.kind == i + DMRP_KIND_GLOBAL_PLANNER;
    uses +=
        fmt::format("[[{}]]\nuse = \"{}\"\n", tables[i], is_checked ? plugin.id : partner.at("use").get<std::string>());
  }
  return fmt::format(
      "[experiment]\nname = \"check\"\nseed = {}\ntrials = 1\nplugins = [{}]\n[[scenario]]\nuse = \"./room.toml\"\n{}"
      "[robot]\n{}[record]\ntraces = \"none\"\n",
      seed, libraries, uses, drive_of(plugin));
}

}  // namespace

CaseOutcome run_whole_trial(const fs::path& file, const PluginInfo& plugin, std::uint64_t seed) {
  const TemporaryFolder folder("dmrp-check");
  std::ofstream(folder.path() / "room.toml") << room;
  std::ofstream(folder.path() / "experiment.toml") << experiment_with(file, plugin, seed);
  CaseOutcome outcome;
  const auto add = [&](const FaultRecord& fault) {
    outcome.result = CheckResult::fail;
    if (outcome.detail.empty()) outcome.detail = fmt::format("{}: {}", fault.kind, fault.detail);
  };
  try {
    const Experiment experiment = load_experiment(folder.path() / "experiment.toml", 1, &probe_library);
    const SupervisorSinks sinks = {[&](TrialRecord&& trial) {
                                     if (trial.outcome == trial_outcome::unsupported)
                                       outcome = {CheckResult::skip, "it says that this trial is not for it"};
                                     else
                                       for (const FaultRecord& fault : trial.faults) add(fault);
                                   },
                                   [&](std::uint64_t, const FaultRecord& fault) { add(fault); },
                                   [](const std::string&) {}, [] { return true; }};
    if (supervise(experiment, PlannedTrials({0}), {1, folder.path(), 1}, sinks) == RunEnding::interrupted)
      outcome = {CheckResult::skip, "it was interrupted"};
  } catch (const InputError& error) {
    outcome = {CheckResult::skip, fmt::format("there is no experiment with it: {}", error.what())};
  }
  return outcome;
}

}  // namespace dmrp::host
