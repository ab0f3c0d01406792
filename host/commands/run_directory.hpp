// SPDX-License-Identifier: MIT
// run_directory.hpp: where a run leaves its files.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host {

// A directory that this process alone runs in, until the object goes.
class RunDirectory {
 public:
  // For a new run: `out` itself, which must be missing or empty; without it runs/NAME, or runs/NAME-2, ... if taken.
  // Makes the directory. Throws InputError.
  static RunDirectory make(const std::filesystem::path& out, const std::string& name);

  // Of a run to go on with, named by --out. Throws InputError.
  static RunDirectory reopen(const std::filesystem::path& out);

  // One that was run and runs no more; `shown` is how messages call it. Throws InputError.
  static RunDirectory open_finished(const std::filesystem::path& path, const std::string& shown);

  RunDirectory(RunDirectory&& other) noexcept;
  RunDirectory& operator=(RunDirectory&&) = delete;
  ~RunDirectory();

  const std::filesystem::path& path() const { return path_; }

 private:
  // Locks it, so that two runs that begin at the same moment do not share one: locked() says whether it is ours.
  explicit RunDirectory(std::filesystem::path path);
  bool locked() const { return lock_ >= 0; }

  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace dmrp::host
