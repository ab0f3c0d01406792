// SPDX-License-Identifier: MIT
#include "host/workers/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace dmrp::host {

namespace fs = std::filesystem;

fs::path scratch_folders(const fs::path& run_directory) {
  return run_directory / "scratch";
}

fs::path run_directory_of(const fs::path& scratch_folder) {
  return scratch_folder.parent_path().parent_path();
}

ScratchFolder::ScratchFolder(const fs::path& run_directory) {
  const fs::path folders = fs::absolute(scratch_folders(run_directory));
  fs::create_directories(folders);
  std::string name = (folders / "XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), folders.string());
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void ScratchFolder::restore() const {
  fs::create_directories(path_);
}

void delete_scratch_folders(const fs::path& run_directory) {
  std::error_code ignored;
  fs::remove_all(scratch_folders(run_directory), ignored);
}

}  // namespace dmrp::host
