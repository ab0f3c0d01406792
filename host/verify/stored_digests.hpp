// SPDX-License-Identifier: MIT
// stored_digests.hpp: the digests of a run's traces. A bundle has them in place of the traces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dmrp::host {

class StoredDigests {
 public:
  // Reads the file of digests in the directory of a run or bundle, if there is one. Throws InputError.
  explicit StoredDigests(std::filesystem::path directory);

  // Of the trial's trace, if there is one; otherwise as the file has it. Throws std::runtime_error.
  std::optional<std::string> of(std::uint64_t trial) const;

 private:
  std::filesystem::path directory_;
  std::map<std::uint64_t, std::string> written_;  // by trial
};

// Writes the file of `bundle` with the digests of these trials of the run.
void write_digests(const StoredDigests& run, const std::vector<std::uint64_t>& trials,
                   const std::filesystem::path& bundle);

}  // namespace dmrp::host
