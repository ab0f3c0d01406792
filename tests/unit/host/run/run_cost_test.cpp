// SPDX-License-Identifier: MIT
// What a run will take, from trials of known length.
#include "host/run/run_cost.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "host/files/temporary_folder.hpp"
#include "host/results/trace_path.hpp"

namespace dmrp::host {
namespace {

// Two planners and two controllers with four robots, ten repetitions.
Experiment four_combinations() {
  Experiment experiment;
  experiment.trials = 10;
  experiment.scenarios.emplace_back().drawn_robots = 4;
  experiment.global_planners.resize(2);
  experiment.local_controllers.resize(2);
  return experiment;
}

TrialRecord trial_of(std::uint64_t id, double wall_s, std::size_t values) {
  TrialRecord trial;
  trial.id = id;
  trial.outcome = trial_outcome::succeeded;
  trial.wall_time_s = wall_s;
  trial.values.resize(values);
  return trial;
}

TEST_CASE("a run takes what a trial of each combination takes, times the trials over the jobs") {
  const TemporaryFolder folder("dmrp_test");
  const Experiment experiment = four_combinations();
  RunCost cost(experiment, 40, 2, folder.path());
  CHECK(cost.words().starts_with("probably more than "));
  cost.add(trial_of(0, 10.0, 1000));
  CHECK_FALSE(cost.is_known());
  CHECK(cost.words() == "about 3.3 min, 2.9 MB");  // 40 x 10 s / 2; 40 x 72 kB
  cost.add(trial_of(1, 20.0, 1000));
  cost.add(trial_of(2, 30.0, 1000));
  cost.add(trial_of(3, 60.0, 1000));
  CHECK(cost.is_known());
  CHECK(cost.words() == "about 10 min, 2.9 MB");
}

TEST_CASE("traces count as far as they are kept") {
  const TemporaryFolder folder("dmrp_test");
  std::filesystem::create_directories(folder.path() / "traces");
  Experiment experiment = four_combinations();
  const auto words = [&](RecordTraces traces) {
    experiment.traces = traces;
    RunCost cost(experiment, 40, 1, folder.path());
    for (std::uint64_t id = 0; id < 4; ++id) {
      std::ofstream(trace_path(folder.path(), id)) << std::string(500'000, 'x');
      cost.add(trial_of(id, 2000.0, 0));
    }
    return cost.words();
  };
  CHECK(words(RecordTraces::all) == "about 22 h, 20 MB");
  CHECK(words(RecordTraces::some) == "about 22 h, 2.0 MB");  // four of forty
  CHECK(words(RecordTraces::none) == "about 22 h, 0.0 kB");
}

}  // namespace
}  // namespace dmrp::host
