// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "host/errors/input_error.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace sweep_test {

using namespace dmrp;
using namespace dmrp::host;
using namespace dmrp::test;

std::string with_scenario_keys(const std::string& keys) {
  return with(experiment_text, "scenario.toml\"\n", "scenario.toml\"\n" + keys + "\n");
}

std::string with_tables(const std::string& tables) {
  return std::string(experiment_text) + "\n" + tables;
}

std::string message_of(const std::string& experiment) {
  try {
    load(experiment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// effective.toml means the same experiment.
void check_round_trip(const Experiment& original) {
  write_file("elsewhere/effective.toml", effective_toml(original));
  const Experiment again = load_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(effective_toml(again) == effective_toml(original));
  REQUIRE(again.scenarios.size() == original.scenarios.size());
  for (std::size_t i = 0; i < again.scenarios.size(); ++i) {
    CHECK(result_name(again.scenarios[i]) == result_name(original.scenarios[i]));
    CHECK(again.scenarios[i].swept == original.scenarios[i].swept);
  }
}

std::vector<std::string> result_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const ScenarioVariant& variant : experiment.scenarios) names.push_back(result_name(variant));
  return names;
}

TEST_CASE("a list of numbers of people makes a variant of each, with the same seeds") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml",
             std::string(scenario_text) + "[[flow]]\nname = \"back\"\nfrom = \"east\"\nto = \"west\"\npeople = 1\n");
  const Experiment e = load(with_scenario_keys("robots = [1, 2]\npeople = [0, 4, 30]"));
  CHECK(result_names(e) == std::vector<std::string>{"hall (people 0)", "hall (people 0)", "hall (people 4)",
                                                    "hall (people 4)", "hall (people 30)", "hall (people 30)"});
  CHECK(e.scenarios[2].scenario.flows[0].people == 3);  // 2.67 of 4
  CHECK(e.scenarios[2].scenario.flows[1].people == 1);
  CHECK(e.scenarios[4].scenario.flows[0].people == 20);
  CHECK(e.scenarios[4].swept == std::vector<SweptValue>{{"", "people", "30"}});
  CHECK(trial_seed(e, 0) == trial_seed(e, 5));
  check_round_trip(e);

  CHECK(result_names(load(with_scenario_keys("people_times = [0.5, 2]"))) ==
        std::vector<std::string>{"hall (people_times 0.5)", "hall (people_times 2)"});
  const Experiment one = load(with_scenario_keys("people = 6"));  // one number is no sweep
  CHECK(result_names(one) == std::vector<std::string>{"hall"});
  CHECK(one.scenarios[0].scenario.flows[0].people == 4);
  check_round_trip(one);
}

TEST_CASE("settings of [simulation], [recovery], [navigation] and [robot] are swept, each combination a variant") {
  const ExperimentFolder folder;
  const Experiment e =
      load(with_tables("[simulation]\nsweep = { tracking = [\"none\", \"all\"], replan_period_s = [0, 2] }\n"
                       "[robot]\nv_max = 0.9\nsweep = { lidar = { beams = [90, 360] } }\n"));
  REQUIRE(e.scenarios.size() == 8);
  CHECK(result_name(e.scenarios[3]) == "hall (tracking none, replan_period_s 2, lidar.beams 360)");
  CHECK(e.scenarios[3].swept[1] == SweptValue{"simulation", "replan_period_s", "2"});
  CHECK(simulation_of(e, e.scenarios[3]).tracking == core::Tracking::none);
  CHECK(simulation_of(e, e.scenarios[3]).replan.period_ns == 2'000'000'000);
  CHECK(simulation_of(e, e.scenarios[4]).tracking == core::Tracking::all);
  CHECK(e.scenarios[4].types.standard().lidar.beams == 90);
  CHECK(e.scenarios[5].types.standard().lidar.beams == 360);
  CHECK(e.scenarios[5].types.standard().v_max == 0.9);
  CHECK(trial_seed(e, 0) == trial_seed(e, 7));
  check_round_trip(e);

  const Experiment ladders =
      load(with_tables("[recovery]\nsweep = { retries = [0, 6], steps = [[\"wait\"], [\"spin\", \"wait\"]] }\n"));
  REQUIRE(ladders.scenarios.size() == 4);
  CHECK(ladders.scenarios[3].swept[0] == SweptValue{"recovery", "retries", "6"});
  CHECK(simulation_of(ladders, ladders.scenarios[1]).recovery.retries == 0);
  CHECK(simulation_of(ladders, ladders.scenarios[3]).recovery.retries == 6);
  CHECK(simulation_of(ladders, ladders.scenarios[3]).recovery.steps.size() == 2);
  check_round_trip(ladders);

  const Experiment routes =
      load(with_tables("[navigation]\nmonitor = true\nsweep = { route = [\"path\", \"around\"] }\n"));
  REQUIRE(routes.scenarios.size() == 2);
  CHECK(routes.scenarios[1].swept[0] == SweptValue{"navigation", "route", "around"});
  CHECK(simulation_of(routes, routes.scenarios[0]).navigation.route == core::LocalRoute::path);
  CHECK(simulation_of(routes, routes.scenarios[1]).navigation.route == core::LocalRoute::around);
  CHECK(simulation_of(routes, routes.scenarios[1]).navigation.monitor);
  check_round_trip(routes);

  const Experiment limits = load(with_tables("[simulation]\nsweep = { time_limit_s = [20, 40] }\n"));
  CHECK(limits.time_limit_set);
  CHECK(simulation_of(limits, limits.scenarios[1]).time_limit_ns == 40'000'000'000);
  check_round_trip(limits);
}

TEST_CASE("an experiment has at most ten million trials") {
  const ExperimentFolder folder;
  const auto with_trials = [](const std::string& trials) {
    return with(with_tables("[robot.sweep]\nv_max = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]\n"),
                "trials = 3\n", trials);
  };
  CHECK(load(with_trials("trials = 1_000_000\n")).trials == 1'000'000);
  CHECK(message_of(with(with_trials("trials = 1_000_000\n"), "1.0]", "1.0, 1.1]")) ==
        "experiment.toml:4:10: 1000000 trials of 11 combinations are 11000000, and an experiment has at most 10000000");
  CHECK(message_of(with_trials("trials = 1_000_000_000\n")) ==
        "experiment.toml:4:10: 'trials' must be at most 1000000, not 1000000000");
}

TEST_CASE("mistakes in sweeps are one line each") {
  const ExperimentFolder folder;
  const auto simulation = [](const std::string& sweep) { return message_of(with_tables("[simulation]\n" + sweep)); };
  CHECK(simulation("sweep = { trackign = [\"none\"] }") ==
        "experiment.toml:21:11: unknown key 'trackign' in 'sweep' (did you mean 'tracking'?)");
  CHECK(simulation("sweep = { tracking = \"none\" }") ==
        "experiment.toml:21:22: 'tracking' must be an array, not a string");
  CHECK(simulation("sweep = { tracking = [] }") == "experiment.toml:21:22: 'tracking' sweeps over no values");
  CHECK(simulation("sweep = { step_s = [0.02, 0.020] }") == "experiment.toml:21:27: 'step_s 0.02' twice in a sweep");
  CHECK(simulation("sweep = { step_s = [0.02, 0.03] }") ==
        "experiment.toml:21:20: 'control_period_s' must be a multiple of 'step_s': 0.1 s is none of 0.03 s");
  CHECK_THAT(message_of(with_tables("[robot]\nsweep = { lidar = { beans = [1] } }")),
             Catch::StartsWith("experiment.toml:21:21: unknown key 'beans'"));
  CHECK_THAT(message_of(with_tables("[robot]\nsweep = { v_y_max = [1] }")),
             Catch::StartsWith("experiment.toml:21:11: 'v_y_max' belongs to drive = 'holonomic'"));
  CHECK(message_of(with_scenario_keys("people = [3, 3]")) ==
        "experiment.toml:8:7: scenario 'hall (people 3)' occurs twice");
  CHECK(message_of(with_scenario_keys("people = 3\npeople_times = 2")) ==
        "experiment.toml:10:1: 'people' and 'people_times' exclude each other");
}

}  // namespace sweep_test
