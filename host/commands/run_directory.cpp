// SPDX-License-Identifier: MIT
#include "host/commands/run_directory.hpp"

#include <fmt/format.h>

#include "host/input_error.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

bool is_taken(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !(fs::is_directory(path, ignored) && fs::is_empty(path, ignored));
}

}  // namespace

fs::path choose_run_directory(const fs::path& out, const std::string& name) {
  if (!out.empty()) {
    if (is_taken(out))
      throw InputError(
          fmt::format("--out {}: is there already and not empty (go on with it by --resume)", out.string()));
    return out;
  }
  const fs::path first = fs::path("runs") / name;
  if (!is_taken(first)) return first;
  for (int i = 2;; ++i)
    if (const fs::path next = fs::path("runs") / fmt::format("{}-{}", name, i); !is_taken(next)) return next;
}

fs::path existing_run_directory(const fs::path& out) {
  if (out.empty()) throw InputError("--resume needs --out DIR: the run directory to go on with");
  std::error_code ignored;
  if (!fs::is_regular_file(out / "results.sqlite", ignored))
    throw InputError(fmt::format("--out {}: is no run directory (no results.sqlite)", out.string()));
  return out;
}

}  // namespace dmrp::host
