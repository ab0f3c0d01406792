// SPDX-License-Identifier: MIT
#include "host/scenario/find_scenario.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

std::vector<std::string> scenarios_in(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const std::filesystem::path& folder : folders)
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (std::filesystem::is_regular_file(entry.path() / "scenario.toml", ignored))
        names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::filesystem::path> scenario_folders() {
  std::vector<std::filesystem::path> folders = {shared_data_path() / "scenarios"};
  for (auto& folder : folders_of_variable("DMRP_SCENARIO_PATH")) folders.push_back(std::move(folder));
  return folders;
}

bool is_map_file(const std::filesystem::path& file) {
  const std::string type = file.extension().string();
  return type == ".yaml" || type == ".yml" || type == ".map";
}

std::filesystem::path find_scenario(const std::string& name_or_path, const std::filesystem::path& base) {
  namespace fs = std::filesystem;
  std::vector<fs::path> candidates;
  const bool is_file = name_or_path.ends_with(".toml") || is_map_file(name_or_path);
  if (name_or_path.find('/') == std::string::npos && !is_file)
    for (const fs::path& folder : scenario_folders()) candidates.push_back(folder / name_or_path / "scenario.toml");
  else
    candidates = {base / name_or_path, base / name_or_path / "scenario.toml"};
  if (!name_or_path.starts_with('.') && !is_file)  // "course/door": one of a folder
    for (const fs::path& folder : scenario_folders()) candidates.push_back(folder / (name_or_path + ".toml"));
  for (const fs::path& candidate : candidates)
    if (std::error_code ignored; fs::is_regular_file(candidate, ignored)) return fs::canonical(candidate);
  return {};
}

std::string name_of_shipped_scenario(const std::filesystem::path& file) {
  const std::filesystem::path inside = file.lexically_relative(shared_data_path() / "scenarios");
  if (inside.empty() || *inside.begin() == "..") return "";
  return (file.filename() == "scenario.toml" ? inside.parent_path() : inside.parent_path() / inside.stem()).string();
}

std::vector<std::string> shipped_scenarios() {
  return scenarios_in({shared_data_path() / "scenarios"});
}

std::vector<std::string> known_scenarios() {
  return scenarios_in(scenario_folders());
}

}  // namespace dmrp::host
