// SPDX-License-Identifier: MIT
#include "host/run/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/files/network_file_system.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// Locks and syncs of network file systems do not keep what SQLite promises.
void refuse_network_file_system(const fs::path& path) {
  const std::string type = network_file_system(path);
  if (type.empty()) return;
  throw InputError(fmt::format(
      "{}: is on a network file system ({}), where results.sqlite is not safe: choose a folder on a disk of this "
      "machine, and copy it when the run is over, or join copies of shards by merge",
      path.string(), type));
}

// Another process may have created it.
void make_directory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw_path_error(path.string() + ": cannot make the run directory", error);
}

// The run was killed before it had a database.
bool was_never_begun(const fs::path& path) {
  constexpr std::array first_files = {"experiment.toml", "effective.toml", "manifest.json", "traces",
                                      "results.new",     "log.txt",        "scratch",       "plans"};
  std::error_code error;
  bool has_begun = !fs::is_directory(path, error) || fs::is_empty(path, error);
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    has_begun |= std::none_of(first_files.begin(), first_files.end(),
                              [&](const char* known) { return name.starts_with(known); });
  }
  return !error && !has_begun;
}

}  // namespace

RunDirectory::RunDirectory(fs::path path) : path_(std::move(path)) {
  lock_ = Descriptor(open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock_.is_open()) throw_path_error(path_.string() + ": cannot be opened", {errno, std::generic_category()});
  if (flock(lock_.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;  // some file systems have no locks
  lock_.close();
}

RunDirectory RunDirectory::make(const fs::path& out, const std::string& name) {
  for (int i = 1;; ++i) {
    const fs::path path = !out.empty() ? out : fs::path("runs") / (i == 1 ? name : fmt::format("{}-{}", name, i));
    refuse_network_file_system(path);
    std::error_code ignored;
    if (!fs::exists(path, ignored) || fs::is_directory(path, ignored)) {
      make_directory(path);
      RunDirectory directory(path);
      if (directory.locked() && fs::is_empty(path, ignored)) {
        if (access(path.c_str(), W_OK | X_OK) != 0)
          throw_path_error(path.string() + ": cannot be written", {errno, std::generic_category()});
        return directory;
      }
    }
    if (!out.empty())
      throw InputError(fmt::format("--out {}: {}", out.string(),
                                   fs::is_directory(path, ignored)
                                       ? "exists already and is not empty (--resume continues it)"
                                       : "is no folder"));
  }
}

RunDirectory RunDirectory::reopen(const fs::path& out) {
  if (out.empty()) throw InputError("--resume needs --out DIR: the run directory to continue");
  refuse_network_file_system(out);
  if (was_never_begun(out)) {
    RunDirectory directory(out);
    if (directory.locked()) return directory;
  }
  return open_finished(out, "--out " + out.string());
}

RunDirectory RunDirectory::open_finished(const fs::path& path, const std::string& shown) {
  std::error_code ignored;
  if (!fs::is_regular_file(path / "results.sqlite", ignored))
    throw InputError(fmt::format("{}: is no run directory (no results.sqlite)", shown));
  RunDirectory directory(path);
  if (!directory.locked()) throw InputError(fmt::format("{}: another dmrp-host is running in it", shown));
  return directory;
}

std::string and_others(std::size_t differences) {
  if (differences <= 1) return "";
  return fmt::format(" (and {} more {})", differences - 1, differences == 2 ? "key" : "keys");
}

}  // namespace dmrp::host
