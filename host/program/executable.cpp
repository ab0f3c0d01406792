// SPDX-License-Identifier: MIT
#include "host/program/executable.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace dmrp::host {

const std::filesystem::path& executable_path() {
  static const std::filesystem::path path = std::filesystem::canonical("/proc/self/exe");
  return path;
}

std::filesystem::path installation_path() {
  return executable_path().parent_path().parent_path();
}

std::filesystem::path shared_data_path() {
  return installation_path() / "share/dmrp";
}

std::string name_of_own_library(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool own = std::filesystem::equivalent(file.parent_path(), installation_path() / "lib/dmrp/plugins", ignored);
  return own ? file.filename().string() : "";
}

std::vector<std::filesystem::path> folders_of_variable(const char* name) {
  std::vector<std::filesystem::path> folders;
  const char* value = std::getenv(name);
  std::istringstream entries(value ? value : "");
  for (std::string entry; std::getline(entries, entry, ':');)
    if (!entry.empty()) folders.emplace_back(entry);
  return folders;
}

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace dmrp::host
