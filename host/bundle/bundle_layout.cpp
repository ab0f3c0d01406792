// SPDX-License-Identifier: MIT
#include "host/bundle/bundle_layout.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/files/sha256.hpp"
#include "host/plugins/python_file.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// The deepest folder that both are in.
fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  const auto [end, unused] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  for (auto part = a.begin(); part != end; ++part) common /= *part;
  return common;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

BundleLayout::BundleLayout(const Experiment& experiment, const Manifest& manifest, bool all_libraries) {
  for (const LibraryUse& library : experiment.libraries)
    if (is_python_file(library.file))
      add_python(library);
    else
      add_library(library.file, all_libraries || name_of_own_library(library.file).empty());
  for (const ScenarioVariant& variant : experiment.scenarios) add_scenario(variant);
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses)
      for (const ParameterValue& value : use.parameters)
        if (value.type == DMRP_PARAM_PATH && is_file(value.text)) add_parameter(value.text);
  for (const PluginUse& planner : experiment.global_planners)
    if (planner.plans.is_given()) add_plans(planner.plans);
  for (const HashedFile& file : manifest.files)
    if (file.role == "parameter" && is_file(file.path) && sha256_of_file(file.path) == file.sha256)
      add_parameter(file.path);
}

std::string BundleLayout::name_of(const fs::path& file) const {
  const auto found = names_.find(file);
  return found == names_.end() ? file.string() : found->second;
}

void BundleLayout::add_scenario(const ScenarioVariant& variant) {
  fs::path root = variant.file.parent_path();
  for (const fs::path& file : variant.files) root = common_folder(root, file.parent_path());
  fs::path& folder = scenario_folders_[root];
  if (folder.empty()) folder = free_place(fs::path("scenarios") / root.relative_path().filename());
  std::vector<fs::path> files = variant.files;
  files.push_back(variant.file);
  for (const fs::path& file : files) {
    const fs::path place = folder / file.lexically_relative(root);
    copies_[place] = file;
    names_[file] = place.string();
  }
}

void BundleLayout::add_parameter(const fs::path& file) {
  if (names_.contains(file)) return;
  const fs::path place = free_place("parameters" / file.filename());
  copies_[place] = file;
  names_[file] = place.string();
}

void BundleLayout::add_plans(const PlanFiles& plans) {
  const fs::path root = plans.name.parent_path();
  fs::path& folder = plan_folders_[root];
  if (folder.empty()) folder = free_place(fs::path("plan_files") / root.filename());
  for (const fs::path& file : plans.all()) {
    copies_[folder / file.filename()] = file;
    names_[file] = (folder / file.filename()).string();
  }
  names_[plans.name] = (folder / plans.name.filename()).string();
}

void BundleLayout::add_library(const fs::path& file, bool copied) {
  names_[file] = file.filename().string();
  if (!copied) return;
  const fs::path place = free_place("plugins" / file.filename());
  copies_[place] = file;
  names_[file] = place.string();
}

// With the modules that it imports from its folder.
void BundleLayout::add_python(const LibraryUse& library) {
  const fs::path root = library.file.parent_path();
  fs::path& folder = python_folders_[root];
  if (folder.empty()) folder = free_place(fs::path("plugins") / root.filename());
  copies_[folder / library.file.filename()] = library.file;
  names_[library.file] = (folder / library.file.filename()).string();
  for (const fs::path module : library.objects) copies_[folder / module.filename()] = module;
}

// "plugins/libmine.so"; "plugins-2/libmine.so", ... for others of that name. The last part stays: a scenario.toml has the
// name of its folder.
fs::path BundleLayout::free_place(const fs::path& wanted) {
  fs::path place = wanted;
  for (int i = 2; !taken_.insert(place).second; ++i)
    place = fs::path(fmt::format("{}-{}", wanted.parent_path().string(), i)) / wanted.filename();
  return place;
}

}  // namespace dmrp::host
