// SPDX-License-Identifier: MIT
// Maps and scenarios of the MovingAI benchmark (Stern et al. 2019) as planning cases.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

inline PlanningCase read_map(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line != "map") {
  }
  std::vector<std::string> rows;
  while (std::getline(in, line) && !line.empty()) rows.push_back(line);
  return PlanningCase(rows);
}

inline void add_robots(PlanningCase& c, const std::filesystem::path& scenario, int count) {
  std::ifstream in(scenario);
  std::string line;
  std::getline(in, line);  // version 1
  for (int i = 0; i < count && std::getline(in, line); ++i) {
    std::istringstream fields(line);
    std::string bucket, map, width, height;
    CellXY start, goal;
    fields >> bucket >> map >> width >> height >> start.x >> start.y >> goal.x >> goal.y;
    c.robot(start, {goal});
  }
}

// The first robots of random-`instance` on a map of MovingAI or of the generated ones.
inline PlanningCase read_instance(const std::filesystem::path& data, const std::string& map, int robots, int instance) {
  const bool is_generated = std::filesystem::exists(data / "generated" / (map + ".map"));
  const auto maps = is_generated ? data / "generated" : data / "movingai" / "maps";
  const auto scenarios = is_generated ? data / "generated" : data / "movingai" / "scens";
  PlanningCase c = read_map(maps / (map + ".map"));
  add_robots(c, scenarios / (map + "-random-" + std::to_string(instance) + ".scen"), robots);
  if (c.robots.size() != static_cast<std::size_t>(robots)) throw std::runtime_error("not enough tasks for " + map);
  return c;
}

}  // namespace dmrp::test
