// SPDX-License-Identifier: MIT
// database.hpp: results.sqlite, the results of a run. One process writes it, with one transaction for each trial.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/results/sqlite.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// Throws SqliteError, and MachineError if the disk fails or the file is gone. Numbers keep their bits, except that SQLite returns -0.0 as 0.0; an undefined value is NULL. Seeds
// of 2^63 and more are stored as the negative number with the same bits, because SQLite's integers are signed.
class ResultsDatabase {
 public:
  // Creates a file, which must not exist, for trials with these metrics.
  static ResultsDatabase create(const std::filesystem::path& path, std::span<const MetricColumn> metrics);

  // Opens an existing file, and checks it.
  static ResultsDatabase open(const std::filesystem::path& path);
  // Shows the trials that are written at this moment, whatever a run adds later.
  static ResultsDatabase open_read_only(const std::filesystem::path& path);

  // Writes these trials whole, or none; replaces trials with the same ids.
  void write(std::span<const TrialRecord> trials);
  void write(const TrialRecord& trial) { write({&trial, 1}); }

  // Nothing more is written: from then on it is one file, beside which those who read it leave none.
  void finish();

  // Adds a fault to a trial that has been written.
  void add_fault(std::uint64_t trial, const FaultRecord& fault);

  // Sorted ids of the trials that a resumed run does not repeat: all except skipped ones, or all without faults.
  enum class Finished { all, without_faults };
  std::vector<std::uint64_t> finished_trials(Finished which = Finished::all) const;

  std::vector<MetricColumn> metrics() const;  // in the order of declaration
  std::vector<TrialRecord> trials() const;    // complete, by id

  // The same with the events of this metric alone ("": with none): there can be millions of events.
  std::vector<TrialRecord> trials_with_events_of(const std::string& metric) const;

  std::vector<MetricEvent> events(std::uint64_t trial) const;

 private:
  explicit ResultsDatabase(SqliteConnection connection);

  SqliteConnection connection_;
};

}  // namespace dmrp::host
