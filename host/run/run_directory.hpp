// SPDX-License-Identifier: MIT
// run_directory.hpp: the directory of a run.
#pragma once

#include <filesystem>
#include <string>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

// Locked while the object lives: no other dmrp-host uses it. All functions throw InputError and MachineError.
class RunDirectory {
 public:
  // Makes the directory of a new run: `out`, which must be missing or empty; if `out` is empty, runs/NAME, or
  // runs/NAME-2, ... if that is taken.
  static RunDirectory make(const std::filesystem::path& out, const std::string& name);

  // The directory of a run to continue, named by --out. It has no results if the run was killed as it began.
  static RunDirectory reopen(const std::filesystem::path& out);

  // The directory of a run that no process works on; `shown`: its name in messages.
  static RunDirectory open_finished(const std::filesystem::path& path, const std::string& shown);

  const std::filesystem::path& path() const { return path_; }

 private:
  // Tries to lock it: two runs that begin at the same time do not share a directory.
  explicit RunDirectory(std::filesystem::path path);
  bool locked() const { return lock_.is_open(); }

  std::filesystem::path path_;
  Descriptor lock_;
};

// Of so many differences of which one has been named: " (and 2 more keys)", or "".
std::string and_others(std::size_t differences);

}  // namespace dmrp::host
