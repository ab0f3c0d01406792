// SPDX-License-Identifier: MIT
#include "host/ranking/tested_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace dmrp::host {
namespace {

TestedWorld parse_row(const nlohmann::json& json) {
  TestedWorld row;
  row.scenario = json.at("scenario").get<std::string>();
  row.robots = json.at("robots").get<std::uint32_t>();
  row.people = json.at("people").get<std::uint32_t>();
  row.factor = json.at("factor").get<std::string>();
  row.passes = json.at("passes").get<bool>();
  if (row.factor != "planners" && row.factor != "controllers")
    throw std::runtime_error("unknown factor '" + row.factor + "'");
  return row;
}

// Whether more than one planner, or controller, drives robots in this scenario.
bool varies(std::span<const TrialRecord> trials, const ScenarioFacts& facts, std::string TrialRecord::*choice) {
  std::set<std::string> found;
  for (const TrialRecord& trial : trials)
    if (trial.scenario == facts.name && trial.robots == facts.robots) found.insert(trial.*choice);
  return facts.robots > 0 && found.size() > 1;
}

// Whether it was tested, but never passed with so few robots and people.
bool is_for_sanity(std::span<const TestedWorld> tested, const ScenarioFacts& facts, const std::string& factor) {
  const std::string& world = facts.world.empty() ? facts.name : facts.world;
  const auto is_row = [&](const TestedWorld& row) { return row.scenario == world && row.factor == factor; };
  return std::any_of(tested.begin(), tested.end(), is_row) &&
         std::none_of(tested.begin(), tested.end(), [&](const TestedWorld& row) {
           return is_row(row) && row.passes && row.robots <= facts.robots && row.people <= facts.people;
         });
}

std::string counted(std::uint32_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

}  // namespace

std::vector<TestedWorld> read_tested_worlds(const std::filesystem::path& path) {
  try {
    std::ifstream in(path);
    const nlohmann::json document = nlohmann::json::parse(in);
    std::vector<TestedWorld> rows;
    for (const nlohmann::json& row : document.at("rows")) rows.push_back(parse_row(row));
    return rows;
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

std::vector<std::string> sanity_only(std::span<const TestedWorld> tested, std::span<const ScenarioFacts> scenarios,
                                     std::span<const TrialRecord> trials) {
  std::vector<std::string> sentences;
  const auto add = [&](const std::string& factor, std::string TrialRecord::*choice) {
    std::vector<std::string> worlds;
    for (const ScenarioFacts& facts : scenarios)
      if (varies(trials, facts, choice) && is_for_sanity(tested, facts, factor))
        worlds.push_back(fmt::format("{} with {} and {}", facts.name, counted(facts.robots, "robot", "robots"),
                                     counted(facts.people, "person", "people")));
    if (!worlds.empty())
      sentences.push_back(fmt::format("sanity only: not shown to tell {} apart: {} (docs/discrimination.md)", factor,
                                      fmt::join(worlds, ", ")));
  };
  add("planners", &TrialRecord::global_planner);
  add("controllers", &TrialRecord::local_controller);
  return sentences;
}

}  // namespace dmrp::host
