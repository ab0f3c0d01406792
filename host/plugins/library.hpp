// SPDX-License-Identifier: MIT
// library.hpp: a plugin library in this process. Loaded once, never unloaded while the process runs.
#pragma once

#include <dmrp/entry.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

class Library {
 public:
  // Loads the file with every symbol resolved, and checks the entry object. Throws std::runtime_error, one line without
  // the file's name. Load only files that have been probed (host/guests/probe.hpp): a truncated file kills the process.
  // `stage` is told what comes next, "dlopen" or "descriptor(0)": a library that ends the process cannot be asked.
  explicit Library(const std::filesystem::path& file, const std::function<void(const std::string&)>& stage = {});
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  // The functions of its entry, and its versions.
  std::uint32_t abi_minor() const { return entry_.abi_minor; }
  std::uint32_t plugin_count() const { return entry_.plugin_count(own_entry_); }
  const dmrp_descriptor* descriptor(std::uint32_t index) const { return entry_.descriptor(own_entry_, index); }
  std::int32_t init(const dmrp_host* host) const { return entry_.init(own_entry_, host); }
  void deinit() const { entry_.deinit(own_entry_); }
  std::int32_t create(const dmrp_host* host, const char* id, const dmrp_params* params, dmrp_plugin* out) const {
    return entry_.create(own_entry_, host, id, params, out);
  }

  const std::vector<PluginInfo>& plugins() const { return plugins_; }  // those that this host knows
  const std::filesystem::path& file() const { return file_; }          // absolute

  // The shared objects that were loaded with it, as it needs them; those that this process had before are the host's.
  // Of a Python file the modules that it has imported from its folder so far.
  std::vector<std::string> objects() const;

  // Of a Python file: the versions of Python and of packages that it has imported so far; empty for another library.
  std::vector<std::string> runtime() const;

  // One line each: that it changed the process when it was loaded, that a plugin of it is unknown to this host.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Handle;
  void load(const std::function<void(const std::string&)>& stage);
  void import(const std::function<void(const std::string&)>& stage);
  void read_descriptors(const std::function<void(const std::string&)>& stage);

  std::unique_ptr<Handle> handle_;
  std::filesystem::path file_;
  const dmrp_entry* own_entry_ = nullptr;
  dmrp_entry entry_{};  // a copy, zero-filled where the library's is shorter
  std::vector<PluginInfo> plugins_;
  std::vector<std::string> objects_;
  std::vector<std::string> warnings_;
};

// The longest time for init() or deinit(), wall time.
inline constexpr std::int64_t init_budget_ns = 10'000'000'000;

// The file of a library that an experiment names. A name without a slash is searched in plugin_path(); a path is relative
// to `base`. Empty if there is no such file.
std::filesystem::path find_library(const std::string& name, const std::filesystem::path& base);

// The file of a library that a command line names: as above, and a name without a slash may be a file of the working
// directory. Throws InputError: there is no such library, or it is none that this host can load.
std::filesystem::path library_to_open(const std::string& name);

// DMRP_PLUGIN_PATH, then ../lib/dmrp/plugins beside the executable.
std::vector<std::filesystem::path> plugin_path();

// All libraries (.so) of plugin_path(), sorted, without duplicates.
std::vector<std::filesystem::path> libraries_of_plugin_path();

// What is known of a library without its code.
struct Probe {
  std::vector<PluginInfo> plugins;
  std::vector<std::string> warnings{};
  std::vector<std::string> objects{};  // Library::objects()
  std::string init_error{};            // why init() failed, in one line; empty if it succeeded
  std::vector<std::string> runtime{};  // Library::runtime()
};

}  // namespace dmrp::host
