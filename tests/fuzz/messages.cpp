// SPDX-License-Identifier: MIT
// What a worker may say to its supervisor: one JSON message a line, from a process that runs strangers' code. What is
// believed can be stored.
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "host/results/database.hpp"
#include "host/workers/open_trial.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace {

using namespace dmrp::host;

constexpr std::uint64_t stamp = 77;

// Two metrics, with a value of the system and of each of two robots.
const Experiment& experiment() {
  static const Experiment two_metrics = [] {
    Experiment made;
    for (const char* name : {"length", "speed"}) {
      PluginUse use;
      use.info.id = name;
      MetricValueSpec spec;
      spec.name = name;
      spec.subjects = 1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_ROBOT;
      use.info.values = {spec};
      made.metrics.push_back(use);
    }
    return made;
  }();
  return two_metrics;
}

ResultsDatabase& database() {
  static const dmrp::test::ExperimentFolder folder;
  static ResultsDatabase made = ResultsDatabase::create(
      "results.sqlite", std::vector<MetricColumn>{{"length", "m", DMRP_DIRECTION_NONE, false, "", false},
                                                  {"speed", "m/s", DMRP_DIRECTION_NONE, false, "", false}});
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  TrialRecord blank;
  blank.id = 5;
  blank.robots = 2;
  OpenTrial trial(experiment(), blank);
  trial.begin(stamp);
  std::istringstream lines{std::string(dmrp::fuzz::text(data, size))};
  auto state = OpenTrial::State::running;
  try {
    for (std::string line; state == OpenTrial::State::running && std::getline(lines, line);)
      state = trial.take(nlohmann::json::parse(line, nullptr, false));
  } catch (const UnbelievableMessage&) {
  } catch (const nlohmann::json::exception&) {
  }
  if (state == OpenTrial::State::done) database().write(trial.record());
  return 0;
}
