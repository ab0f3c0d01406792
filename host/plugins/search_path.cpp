// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "host/errors/input_error.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/plugins/library.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

std::vector<std::filesystem::path> plugin_path() {
  std::vector<std::filesystem::path> folders = folders_of_variable("DMRP_PLUGIN_PATH");
  folders.push_back(executable_path().parent_path() / "../lib/dmrp/plugins");
  return folders;
}

std::vector<std::filesystem::path> libraries_of_plugin_path() {
  std::vector<std::filesystem::path> out;
  for (const std::filesystem::path& folder : plugin_path()) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".so" && entry.is_regular_file(ignored))
        out.push_back(std::filesystem::canonical(entry.path()));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::filesystem::path find_library(const std::string& name, const std::filesystem::path& base) {
  namespace fs = std::filesystem;
  std::vector<fs::path> candidates;
  if (name.find('/') == std::string::npos)
    for (const fs::path& folder : plugin_path()) candidates.push_back(folder / name);
  else
    candidates.push_back(base / name);
  for (const fs::path& candidate : candidates)
    if (std::error_code ignored; fs::is_regular_file(candidate, ignored)) return fs::canonical(candidate);
  return {};
}

std::filesystem::path library_to_open(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path file = find_library(name, fs::current_path());
  if (file.empty()) file = find_library("./" + name, fs::current_path());
  if (!file.empty()) {
    if (const std::string why = why_not_loadable(file); !why.empty()) throw InputError(file.string() + ": " + why);
    return file;
  }
  if (fs::is_directory(name, ignored)) throw InputError(name + ": is a folder, not a plugin library");
  if (fs::is_symlink(name, ignored))
    throw InputError(
        fmt::format("{}: is a link to {}, which does not exist", name, fs::read_symlink(name, ignored).string()));
  throw InputError(name + ": there is no such library");
}

}  // namespace dmrp::host
