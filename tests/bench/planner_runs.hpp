// SPDX-License-Identifier: MIT
// planner_runs.hpp: runs planners by `dmrp-host plan`, one process for each run, and validates the paths.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dmrp::bench {

// A planner with the parameters that differ from its defaults.
struct PlannerChoice {
  std::string id;
  std::vector<std::string> settings;  // key=value

  bool operator==(const PlannerChoice&) const = default;
};

// Parses "eecbs suboptimality=1.2". An id without a dot gets the prefix dmrp.planner.
PlannerChoice planner_choice(const std::string& text);

// A short name for tables: "eecbs 1.2".
std::string short_name(const PlannerChoice& planner);

// One instance: either tasks on a map, or a shipped scenario.
struct Instance {
  std::filesystem::path map;
  std::filesystem::path tasks;
  int agents = 0;
  std::string scenario;  // empty: the tasks on the map
};

struct PlannerRunResult {
  bool solved = false;
  double cost = 0.0;  // of a solved instance on a map
  double planning_ms = 0.0;
  double cpu_s = 0.0;  // of all processes of the run
  std::optional<double> high_level_expanded;
  double peak_rss_mb = 0.0;
  int robots = 0;
  std::string error;  // an invalid plan, a fault or an error of the host; empty if there is none
};

struct Bench {
  std::filesystem::path host;     // dmrp-host
  std::filesystem::path scratch;  // a folder for temporary files
  std::vector<std::string> libraries;
  double time_limit_s = 10.0;
};

// The planners of the libraries.
struct KnownPlanner {
  std::string id;
  int connectivity = 4;
  bool uncoordinated = false;
};
std::vector<KnownPlanner> known_planners(const Bench& bench);

// Another program that plans: a shell command that finds map, tasks, number of agents and seconds in the environment
// variables MAP, SCEN, AGENTS and TIME_LIMIT, and writes its paths as `dmrp-host plan --paths` does to the file PATHS.
struct Peer {
  std::string name;
  std::string command;
};

// On a map. `planning_ms` is the wall time of the command.
PlannerRunResult run_peer(const Bench& bench, const Peer& peer, const Instance& instance);

PlannerRunResult run(const Bench& bench, const PlannerChoice& planner, const KnownPlanner& known,
                     const Instance& instance);

}  // namespace dmrp::bench
