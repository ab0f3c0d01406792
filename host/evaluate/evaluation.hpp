// SPDX-License-Identifier: MIT
// evaluation.hpp: which metrics are measured over the stored traces of a run, from which libraries, with which
// parameters: the run's own, as far as nobody asks for others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// What the user asked for.
struct EvaluationChoice {
  std::filesystem::path run_directory;
  std::string metric;                 // id; empty: all of the run's and of `plugins`
  std::vector<std::string> plugins;   // libraries beside the run's, searched before these
  std::vector<std::string> settings;  // key=value for `metric`
  std::string parameter_file;         // likewise; empty: none
};

struct Evaluation {
  std::vector<LibraryUse> libraries;  // those that hold the metrics, in no other's way
  std::vector<PluginUse> metrics;
  RunLimits limits;                         // the run's
  RecordTraces traces = RecordTraces::all;  // likewise
  std::vector<std::string> warnings;        // one line each: why values may differ from the run's
};

// Reads effective.toml and manifest.json of the run. A metric that the run used has the run's parameters, another one
// its defaults; over these come the parameter file and the settings. Throws InputError.
Evaluation plan_evaluation(const EvaluationChoice& choice);

}  // namespace dmrp::host
