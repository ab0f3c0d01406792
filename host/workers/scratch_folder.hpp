// SPDX-License-Identifier: MIT
// scratch_folder.hpp: the folder in which one worker writes its files. Nothing of it is a result until the supervisor has
// taken it (stored_file.hpp).
#pragma once

#include <filesystem>

namespace dmrp::host {

// Within the run directory, on the file system of the results.
std::filesystem::path scratch_folders(const std::filesystem::path& run_directory);
std::filesystem::path run_directory_of(const std::filesystem::path& scratch_folder);

class ScratchFolder {
 public:
  // A new one. Throws std::system_error.
  explicit ScratchFolder(const std::filesystem::path& run_directory);
  ~ScratchFolder();  // deletes it, with all files
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }  // absolute

  // Makes it again if a plugin has deleted it.
  void restore() const;

 private:
  std::filesystem::path path_;
};

// Deletes all, also those that a killed supervisor has left.
void delete_scratch_folders(const std::filesystem::path& run_directory);

}  // namespace dmrp::host
