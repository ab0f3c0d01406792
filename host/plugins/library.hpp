// SPDX-License-Identifier: MIT
// library.hpp: a plugin library in this process. Loaded once, never unloaded while the process runs.
#pragma once

#include <dmrp/entry.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

class Library {
 public:
  // Loads with every symbol resolved and checks the entry object. Throws std::runtime_error, in one line that does not
  // name the file. Only do this to a file that a probe has survived: a truncated one kills the process.
  explicit Library(const std::filesystem::path& file);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const dmrp_entry& entry() const { return entry_; }
  const std::vector<PluginInfo>& plugins() const { return plugins_; }
  const std::string& warning() const { return warning_; }  // of loading; empty if there is none

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  dmrp_entry entry_{};  // the library's, zero-filled where it is shorter
  std::vector<PluginInfo> plugins_;
  std::string warning_;
};

// The libraries that an experiment names, as written there or by absolute path:
// a bare name is searched in DMRP_PLUGIN_PATH, then in ../lib/dmrp/plugins from the executable; else relative to `base`.
// Returns an empty path if there is no such file.
std::filesystem::path find_library(const std::string& name, const std::filesystem::path& base);

// The folders that bare names are searched in.
std::vector<std::filesystem::path> plugin_path();

// All libraries (.so) in them, sorted, each once.
std::vector<std::filesystem::path> libraries_of_plugin_path();

// What a library says of itself, found out by a child process that loads it. Throws std::runtime_error in one line.
struct Probe {
  std::vector<PluginInfo> plugins;
  std::string warning{};
  std::string init_error{};  // why init() failed, in one line; empty if it did not
};
Probe probe_library(const std::filesystem::path& file);

// The child's side: writes the probe as JSON to the pipe `descriptor`. Returns the exit status.
int run_probe(const std::filesystem::path& file, int descriptor);

}  // namespace dmrp::host
