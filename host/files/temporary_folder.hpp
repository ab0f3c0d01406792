// SPDX-License-Identifier: MIT
// temporary_folder.hpp: a folder that is gone with its object.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace dmrp::host {

class TemporaryFolder {
 public:
  // Its name begins so. Throws std::system_error.
  explicit TemporaryFolder(const std::string& beginning) {
    std::string name = (std::filesystem::temp_directory_path() / (beginning + "-XXXXXX")).string();
    if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dmrp::host
