// SPDX-License-Identifier: MIT
#include "host/verify/stored_digests.hpp"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "host/errors/input_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/read_file.hpp"
#include "host/results/trace_path.hpp"
#include "host/verify/trace_digest.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "trace_digests.txt";  // lines of "DIGEST  TRIAL"

}  // namespace

StoredDigests::StoredDigests(fs::path directory) : directory_(std::move(directory)) {
  const fs::path file = directory_ / file_name;
  if (std::error_code ignored; !fs::is_regular_file(file, ignored)) return;
  std::istringstream lines(read_file(file, file.string()));
  std::string digest;
  for (std::uint64_t trial = 0; lines >> digest >> trial;) written_[trial] = digest;
  if (!lines.eof()) throw InputError(fmt::format("{}: has a line that is not 'DIGEST  TRIAL'", file.string()));
}

std::optional<std::string> StoredDigests::of(std::uint64_t trial) const {
  const fs::path trace = trace_path(directory_, trial);
  if (std::error_code ignored; fs::is_regular_file(trace, ignored)) return trace_digest(trace);
  const auto written = written_.find(trial);
  return written == written_.end() ? std::nullopt : std::optional(written->second);
}

void write_digests(const StoredDigests& run, const std::vector<std::uint64_t>& trials, const fs::path& bundle) {
  std::string text;
  for (const std::uint64_t trial : trials)
    if (const auto digest = run.of(trial)) text += fmt::format("{}  {}\n", *digest, trial);
  write_file_atomically(bundle / file_name, text);
}

}  // namespace dmrp::host
