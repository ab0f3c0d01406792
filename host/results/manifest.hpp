// SPDX-License-Identifier: MIT
// manifest.hpp: manifest.json: the inputs of a run (software, machine, files), to decide whether runs are compatible.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/results/machine.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct HashedFile {
  std::string role;  // "plugin library", "scenario", "parameter"
  std::string path;
  std::string sha256;
  std::string code{};  // of a library: code_digest()
};

// A scenario with a number of robots.
struct ScenarioFacts {
  std::string name;
  std::string title;
  std::string description;
  std::uint32_t robots = 0;
  std::uint32_t people = 0;
  double time_limit_s = 0.0;
  std::vector<std::string> robot_types{};  // of each robot; empty if all are of one type, and in older manifests
  // of a test with levels, as scenario_variant.hpp has it; an empty series: none
  std::string series{};
  std::string quantity{};
  std::string unit{};
  bool harder_when_higher = true;
  double level = 0.0;
  std::string world{};       // its own name, without swept values; empty: `name`
  bool tasks_drawn = false;  // the robots' tasks are drawn, not listed
};

// Trials k with k % count == index.
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;

  bool operator==(const Shard& other) const { return index == other.index && count == other.count; }
};

// "0/3", or "the whole experiment".
std::string shard_text(const Shard& shard);

// The plan of the run, whether or not it was completed.
struct ExperimentFacts {
  std::string name;
  std::uint64_t seed = 0;
  std::uint32_t repetitions = 0;
  Shard shard;
  std::uint64_t trials_planned = 0;  // of this run's shard
  std::vector<ScenarioFacts> scenarios;
  std::vector<std::uint32_t> grown_from{};  // earlier numbers of repetitions: it was continued with more
};

// "You added trials after seeing results (6, then 12): treat p values as exploratory."; "" if the run did not grow.
std::string growth_line(const ExperimentFacts& facts);

// What an experiment means (host/experiment/identity.hpp).
using Identity = std::map<std::string, std::string>;

// What plugins could do on this machine.
struct PluginLimits {
  std::string box;                            // "namespaces", "calls" or "none", as box::kind()
  std::string memory;                         // what holds memory_mb
  std::vector<std::string> with_processes{};  // plugins of the experiment that may start processes
};

// A reason for which trials are not repeatable.
struct UnrepeatableTrials {
  TimingReason reason;
  std::uint64_t trials = 0;
};

struct Manifest {
  std::string dmrp_version;
  std::string commit;  // that the program was built from; empty where that is unknown
  std::string abi;     // "1.0", "1.0 draft 5"
  std::vector<std::string> command_line;
  std::string started_at;  // UTC, ISO 8601
  ExperimentFacts experiment;
  Identity identity;
  std::string digest;      // of the identity
  std::string protocol{};  // protocol_of() the identity
  PluginLimits plugin_limits;
  std::vector<std::string> left_out;  // libraries that could not be loaded, and uses of their plugins
  Machine machine;
  std::vector<HashedFile> files;
  std::vector<UnrepeatableTrials> not_repeatable{};  // known once the run has ended
};

// Fills in the properties of the program and the machine.
Manifest new_manifest(std::string dmrp_version, std::vector<std::string> command_line,
                      std::chrono::system_clock::time_point started_at);

HashedFile hashed_file(std::string role, const std::filesystem::path& path);  // throws std::system_error

std::string to_json_text(const Manifest& manifest);
Manifest read_manifest(const std::filesystem::path& path);  // throws std::runtime_error

// Counts those of the trials in `counted`, one entry for each plugin and reason.
void count_unrepeatable(std::vector<UnrepeatableTrials>& counted, std::span<const TrialRecord> trials);

// Why results of the same experiment can differ in their bits, one line each: another program, machine or plugin
// library. Libraries are compared by name and code, wherever they lie.
std::vector<std::string> differences(const Manifest& before, const Manifest& now);

// A key of two identities. A value that one of them lacks is "missing".
struct KeyDifference {
  std::string key;
  std::string before;  // for people: hashes are cut short
  std::string now;
};
std::vector<KeyDifference> differences(const Identity& before, const Identity& now);

}  // namespace dmrp::host
