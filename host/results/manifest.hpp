// SPDX-License-Identifier: MIT
// manifest.hpp: manifest.json: what a run was made of, so that another one can be told to be the same.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/results/machine.hpp"

namespace dmrp::host {

struct HashedFile {
  std::string role;  // "plugin library", "map", "scenario", "parameter": where the file came in
  std::string path;
  std::string sha256;
};

struct Manifest {
  std::string dmrp_version;
  std::string abi;  // "1.0", "1.0 draft 3"
  std::vector<std::string> command_line;
  std::string started_at;  // UTC, ISO 8601
  Machine machine;
  std::vector<HashedFile> files;
};

// What of the program and the machine is known here is filled in.
Manifest new_manifest(std::string dmrp_version, std::vector<std::string> command_line,
                      std::chrono::system_clock::time_point started_at);

HashedFile hashed_file(std::string role, const std::filesystem::path& path);  // throws std::system_error

std::string to_json_text(const Manifest& manifest);
Manifest read_manifest(const std::filesystem::path& path);  // throws std::runtime_error

// Why results of the two may differ in their bits, a line each; empty where they may be joined. Files are compared by
// role and content in order, not by where they lie.
std::vector<std::string> differences(const Manifest& before, const Manifest& now);

}  // namespace dmrp::host
