// SPDX-License-Identifier: MIT
// bundle_layout.hpp: where a bundle has the files of an experiment.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "host/experiment/experiment.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// scenarios/ has scenario files with the files that they name, as they lie to each other; parameters/ has files of
// parameters and files that parameters name; plan_files/ has files of plans; plugins/ has libraries, those in Python with the modules beside them. All are
// copied as they are.
class BundleLayout {
 public:
  // `manifest`: of the run, which knows the files of parameters; those that have changed since are left out, as their
  // values are in the experiment. Libraries that come with dmrp-host are left out, unless `all_libraries`.
  BundleLayout(const Experiment& experiment, const Manifest& manifest, bool all_libraries);

  // What the bundle's experiment.toml calls a file that the experiment names; other files: their own path.
  std::string name_of(const std::filesystem::path& file) const;

  // The places of files in the bundle, relative to it, each with the file to copy.
  const std::map<std::filesystem::path, std::filesystem::path>& copies() const { return copies_; }

 private:
  void add_scenario(const ScenarioVariant& variant);
  void add_parameter(const std::filesystem::path& file);
  void add_plans(const PlanFiles& plans);
  void add_library(const std::filesystem::path& file, bool copied);
  void add_python(const LibraryUse& library);
  std::filesystem::path free_place(const std::filesystem::path& wanted);

  std::map<std::filesystem::path, std::string> names_;
  std::map<std::filesystem::path, std::filesystem::path> copies_;
  std::map<std::filesystem::path, std::filesystem::path> scenario_folders_;  // of the bundle, for those of scenarios
  std::map<std::filesystem::path, std::filesystem::path> python_folders_;    // likewise, for those of Python files
  std::map<std::filesystem::path, std::filesystem::path> plan_folders_;      // likewise, for those of plans
  std::set<std::filesystem::path> taken_;
};

}  // namespace dmrp::host
