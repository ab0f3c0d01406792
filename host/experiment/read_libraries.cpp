// SPDX-License-Identifier: MIT
#include "host/experiment/read_libraries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "host/errors/mistakes.hpp"
#include "host/files/read_file.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_missing(const TomlValue& value, const std::string& name, const fs::path& base) {
  if (name.empty()) value.fail("a library's name must not be empty");
  std::error_code error;
  if (fs::is_directory(base / name, error)) value.fail(fmt::format("'{}' is a folder, not a plugin library", name));
  if (fs::is_symlink(base / name, error) && !fs::exists(base / name, error))
    value.fail(
        fmt::format("'{}' is a link to {}, which does not exist", name, fs::read_symlink(base / name, error).string()));
  if (name.find('/') != std::string::npos)
    value.fail(fmt::format("no library '{}' (there is no file {})", name, shown((base / name).lexically_normal())));
  if (std::error_code ignored; fs::is_regular_file(base / name, ignored))
    value.fail(fmt::format("no library '{0}' in the plugin path (did you mean './{0}'?)", name));
  std::vector<std::string> known;
  std::string folders;
  for (const fs::path& folder : plugin_path()) {
    folders += (folders.empty() ? "" : ", ") + shown(folder.lexically_normal());
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) known.push_back(entry.path().filename());
  }
  std::sort(known.begin(), known.end());
  value.fail(fmt::format("no library '{}'{} (searched: {})", name, did_you_mean(name, known), folders));
}

// Describes the library, or says in `init_error` why it cannot be loaded.
Probe try_source(const PluginSource& source, const fs::path& file, const VisiblePaths& visible) {
  try {
    return source(file, visible);
  } catch (const std::runtime_error& error) {  // a failure of the machine is none
    return {{}, {}, {}, error.what()};
  }
}

// Fails if the plugin `index` of the last library is not the first with its id.
void check_new_id(const TomlValue& value, const std::vector<LibraryUse>& libraries, std::size_t index) {
  const std::string& name = libraries.back().written;
  const std::string& id = libraries.back().plugins[index].id;
  for (const LibraryUse& other : libraries) {
    const bool is_last = &other == &libraries.back();
    for (std::size_t i = 0; i < (is_last ? index : other.plugins.size()); ++i)
      if (other.plugins[i].id == id)
        value.fail(is_last ? fmt::format("{}: has {} twice", name, id)
                           : fmt::format("{}: has {}, which is in {} already", name, id, other.written));
  }
}

void read_library(const TomlDocument& document, const TomlValue& value, const PluginSource& source,
                  const PluginSource& tried_by, Experiment& experiment) {
  const fs::path base = experiment.file.parent_path();
  const std::string name = value.text();
  const fs::path file = find_library(name, base);
  if (file.empty()) fail_missing(value, name, base);
  for (const LibraryUse& other : experiment.libraries)
    if (other.file == file) value.fail(fmt::format("{}: the library is named twice", name));
  Probe probe;
  if (experiment.skips_unloadable && tried_by) probe = try_source(tried_by, file, experiment.limits.visible);
  if (probe.init_error.empty()) probe = try_source(source, file, experiment.limits.visible);
  if (!probe.init_error.empty()) {
    const std::string why = fmt::format("{}: {}", name, probe.init_error);
    if (!experiment.skips_unloadable) value.fail(why);
    experiment.unloadable.push_back(file);
    return leave_out(value, why, experiment);
  }
  for (const std::string& warning : probe.warnings)
    experiment.warnings.push_back(document.place(value.position()) + ": " + name + ": " + warning);
  experiment.libraries.push_back({name, file, probe.plugins, probe.objects, experiment.limits.visible, probe.runtime});
  for (std::size_t i = 0; i < probe.plugins.size(); ++i) check_new_id(value, experiment.libraries, i);
}

}  // namespace

void read_libraries(const TomlDocument& document, const TomlValue& plugins, const PluginSource& source,
                    const PluginSource& tried_by, Experiment& experiment) {
  const std::vector<TomlValue> listed = plugins.array();
  if (listed.empty()) plugins.fail("'plugins' must name at least one library");
  Mistakes mistakes;
  for (const TomlValue& value : listed)
    mistakes.attempt([&] { read_library(document, value, source, tried_by, experiment); });
  mistakes.end();
  if (experiment.libraries.empty()) plugins.fail("none of 'plugins' can be loaded");
}

bool has_all_libraries(const TomlTable& root, const Experiment& experiment) {
  const auto header = root.find("experiment");
  const auto plugins = header && header->is_table() ? header->table().find("plugins") : std::nullopt;
  return plugins && plugins->is_array() && !experiment.libraries.empty() &&
         plugins->array().size() == experiment.libraries.size() + experiment.unloadable.size();
}

void leave_out(const TomlValue& value, const std::string& text, Experiment& experiment) {
  experiment.left_out.push_back(text);
  experiment.warnings.push_back(fmt::format("{}: left out: {}", value.place(), text));
}

}  // namespace dmrp::host
