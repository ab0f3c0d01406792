// SPDX-License-Identifier: MIT
// evaluation.hpp: the metrics to measure over the stored traces of a run, with their libraries and parameters. Defaults
// come from the run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// The user's options.
struct EvaluationChoice {
  std::filesystem::path run_directory;
  std::string metric;                 // id; empty: all metrics of the run and of `plugins`
  std::vector<std::string> plugins;   // libraries, searched before the run's
  std::vector<std::string> settings;  // key=value for `metric`
  std::string parameter_file;         // likewise; empty: none
};

struct Evaluation {
  std::vector<LibraryUse> libraries;  // only those with a metric to measure
  std::vector<PluginUse> metrics;
  RunLimits limits;                         // the run's
  RecordTraces traces = RecordTraces::all;  // likewise
  std::vector<std::string> warnings;        // one line each: why values may differ from the run's
};

// Reads effective.toml and manifest.json of the run. A metric has the parameters of the run, or its defaults if the run
// did not use it; the parameter file and the settings override them. Throws InputError.
Evaluation plan_evaluation(const EvaluationChoice& choice);

}  // namespace dmrp::host
