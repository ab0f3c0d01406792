// SPDX-License-Identifier: MIT
// Every mistake is told in one line, at its place, and says what to do; all of a file: all_mistakes_test.
#include "host/errors/mistakes.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <vector>

#include "tests/unit/host/experiment/experiment_example.hpp"

namespace mistakes_test {

using namespace dmrp::test;
using dmrp::host::InputError;

std::string message_of(const std::string& experiment, const std::string& scenario) {
  write_file("hall/scenario.toml", scenario);
  try {
    load(experiment);
  } catch (const dmrp::host::InputErrors& errors) {
    std::string all;  // a mistake is told once, and nothing that follows from it
    for (const InputError& mistake : errors.mistakes()) all += (all.empty() ? "" : "\n") + std::string(mistake.what());
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Mistake {
  std::string file;  // experiment, scenario, or parameters: the file that is changed
  std::string from;  // is replaced by `to`, or nothing: `to` is appended
  std::string to;
  std::string message;
};

// Of mistakes.txt, whose head says what it holds.
std::vector<Mistake> told_mistakes() {
  std::ifstream file(DMRP_MISTAKES);
  std::vector<Mistake> all;
  bool removed = false;  // a line of `from` came
  bool added = false;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '@') {
      all.push_back({line.substr(1), "", "", ""});
      removed = added = false;
    } else if (line.front() == '-') {
      all.back().from += (removed ? "\n" : "") + line.substr(1);
      removed = true;
    } else if (line.front() == '+') {
      all.back().to += (added ? "\n" : "") + line.substr(1);
      added = true;
    } else {
      all.back().message += (all.back().message.empty() ? "" : "\n") + line;
    }
  }
  return all;
}

TEST_CASE("each mistake of mistakes.txt has its place and its words") {
  const ExperimentFolder folder;
  const std::vector<Mistake> mistakes = told_mistakes();
  REQUIRE(mistakes.size() > 100);
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.to);
    std::string experiment = experiment_text;
    std::string scenario = scenario_text;
    if (mistake.file == "parameters") {
      write_file("set.toml", mistake.to);
      experiment = with(experiment, "params = {", "params_file = \"set.toml\"\nparams = {");
    } else {
      std::string& changed = mistake.file == "scenario" ? scenario : experiment;
      changed = mistake.from.empty() ? changed + mistake.to : with(changed, mistake.from, mistake.to);
    }
    CHECK(message_of(experiment, scenario) == mistake.message);
  }
}

TEST_CASE("a parameter file is read") {
  const ExperimentFolder folder;
  const auto told = [](const std::string& lines) {
    write_file("set.toml", lines);
    return message_of(with(experiment_text, "params = {", "params_file = \"set.toml\"\nparams = {"), scenario_text);
  };
  CHECK(told("weight = 2") == "no error");
  CHECK_THAT(told("weight = = 2"), Catch::StartsWith("set.toml:1:10:"));
  const std::string unknown =
      message_of(with(experiment_text, "params = {", "params_file = \"sit.toml\"\nparams = {"), scenario_text);
  CHECK_THAT(unknown,
             Catch::StartsWith("experiment.toml:12:15: no parameter file 'sit.toml' beside the experiment file "
                               "(shipped: "));
}

TEST_CASE("robots must not overlap on the centres of their cells") {
  const ExperimentFolder folder;
  const std::string fine_cells = std::string(experiment_text) + "[simulation]\ngrid_resolution_m = 0.4\n";
  CHECK(message_of(fine_cells, with(scenario_text, "start = [0.5, 3.5, 1.5]", "start = [1.01, 0.5]")) ==
        "hall/scenario.toml:25:1: robot 1 has its start on a cell that overlaps robot 0 on its own (centres 0.40 m "
        "apart, "
        "radii 0.25 and 0.25 m)");
}

TEST_CASE("ordered execution needs conflict-free plans on cells") {
  const ExperimentFolder folder;
  const auto message = [](std::uint32_t connectivity, std::uint32_t flags) -> std::string {
    write_file("experiment.toml", std::string(experiment_text) + "[simulation]\nexecution = \"ordered\"\n");
    try {
      dmrp::host::load_experiment("experiment.toml", 0,
                                  [&](const std::filesystem::path& file, const dmrp::host::VisiblePaths& visible) {
                                    dmrp::host::Probe probe = fake_probe(file, visible);
                                    probe.plugins.front().connectivity = connectivity;
                                    probe.plugins.front().flags = flags;
                                    return probe;
                                  });
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(DMRP_CONNECTIVITY_4, 0).empty());
  CHECK(message(DMRP_CONNECTIVITY_8, 0).empty());
  CHECK(message(DMRP_CONNECTIVITY_4, DMRP_FLAG_UNCOORDINATED) ==
        "experiment.toml:20:13: 'execution' = 'ordered' needs plans without conflicts, which test.planner does not "
        "make");
  CHECK(message(DMRP_CONNECTIVITY_ANY, 0) ==
        "experiment.toml:20:13: 'execution' = 'ordered' needs plans from cell to cell, which test.planner does not "
        "make");
}

TEST_CASE("a plugin that needs what the host lacks is refused where it is used") {
  const ExperimentFolder folder;
  const auto message = [](std::size_t plugin, const auto& change) -> std::string {
    write_file("experiment.toml", experiment_text);
    try {
      dmrp::host::load_experiment("experiment.toml", 0,
                                  [&](const std::filesystem::path& file, const dmrp::host::VisiblePaths& visible) {
                                    dmrp::host::Probe probe = fake_probe(file, visible);
                                    change(probe.plugins.at(plugin));
                                    return probe;
                                  });
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using dmrp::host::PluginInfo;
  CHECK(message(0, [](PluginInfo& planner) { planner.needs = {"dmrp.anotate/1"}; }) ==
        "experiment.toml:11:7: test.planner needs the extension dmrp.anotate/1, which this host does not offer to a "
        "global_planner (offered: dmrp.annotate/1, dmrp.timing/1) (did you mean 'dmrp.annotate/1'?)");
  CHECK(message(1, [](PluginInfo& controller) { controller.kinematics = 1u << DMRP_KINEMATICS_ACKERMANN; }) ==
        "experiment.toml:15:7: test.controller cannot drive robots with a differential drive");
}

TEST_CASE("keys of many parts are refused, and long names are cut in messages") {
  const ExperimentFolder folder;
  const auto many = [](const std::string& part) {
    std::string key = "a";
    for (int i = 0; i < 50'000; ++i) key += part;
    return key;
  };
  const auto message = [](const std::string& experiment) -> std::string {
    write_file("experiment.toml", experiment);
    try {
      load(experiment);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message("[" + many(".a") + "]\n") == "experiment.toml:1:2: a key of more than 1000 parts");
  CHECK(message("\n" + many(" . \"b\"") + " = 1\n") == "experiment.toml:2:1: a key of more than 1000 parts");
  CHECK(message("x = [1, {" + many(".'c'") + " = 1}]\n") == "experiment.toml:1:10: a key of more than 1000 parts");
  CHECK(message(many("b") + " = 1\n").size() < 2100);
}

}  // namespace mistakes_test
