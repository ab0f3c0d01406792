// SPDX-License-Identifier: MIT
// database.hpp: results.sqlite, what a run measured. Written by one process, a transaction a trial.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "host/results/sqlite.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// Throws SqliteError. Numbers keep their bits (but SQLite gives -0.0 back as 0.0); an undefined value is NULL. Seeds
// above 2^63 stand in the file as the negative number with the same bits, since SQLite's integers are signed.
class ResultsDatabase {
 public:
  // A new file, which must not exist, for trials that are measured by `metrics`.
  static ResultsDatabase create(const std::filesystem::path& path, std::span<const MetricColumn> metrics);

  // An existing one, to go on writing or to be read.
  static ResultsDatabase open(const std::filesystem::path& path);
  static ResultsDatabase open_read_only(const std::filesystem::path& path);

  // All of the trial or nothing; what was there under its id is replaced.
  void write(const TrialRecord& trial);

  // Ids of the trials that a resumed run need not repeat, in order: all that are there but the skipped.
  std::vector<std::uint64_t> finished_trials() const;

  std::vector<MetricColumn> metrics() const;  // as they were declared, in that order
  std::vector<TrialRecord> trials() const;    // all of every trial, by id

 private:
  explicit ResultsDatabase(SqliteConnection connection);

  SqliteConnection connection_;
};

}  // namespace dmrp::host
