// SPDX-License-Identifier: MIT
// stored_plan.hpp: the first plan of all trials that have scenario variant, repetition and planner in common. Two files of
// the run directory hold it:
//
//   plans/NAME.csv    the paths, in metres (host/plans/plan_file.hpp)
//   plans/NAME.json   the planner's call and statistics, or its fault. It is written last, by the supervisor
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/plans/planning.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct StoredPlan {
  PlannerAnswer answer;
  std::vector<TimingReason> timing{};  // of the planner: none if every call gives this plan
  std::optional<FaultRecord> fault{};  // in place of an answer
  std::string task{};                  // TrialRecord::task, where a fault needs it
  std::string paths_sha256{};          // of the CSV file; "" without
};

// "scenario_00_planner_01_repetition_000003"; "" for a trial without robots.
std::string plan_name(const Combination& combination, std::uint32_t repetition);

std::string plan_csv(const PlannedPaths& paths);
// Throws InputError at the line and column of a mistake.
PlannedPaths read_plan_csv(const std::filesystem::path& file);

bool same_plan(const PlannerAnswer& a, const PlannerAnswer& b);

// In one line, what the planner gave: the status and the paths' SHA-256, or the kind of its fault.
std::string outcome_of(const StoredPlan& plan);

// The plans of one run directory.
class StoredPlans {
 public:
  explicit StoredPlans(const std::filesystem::path& run_directory);

  std::filesystem::path csv_file(const std::string& name) const { return folder_ / (name + ".csv"); }
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // sorted

  // Both throw InputError. The call is everything but the paths.
  StoredPlan read(const std::string& name) const;
  StoredPlan read_call(const std::string& name) const;

  // Throws InputError if the paths are not those that the call gave.
  void check_paths(const std::string& name, const StoredPlan& call) const;

  // Writes the JSON file; the CSV file, if there is one, is there already.
  void write_call(const std::string& name, StoredPlan plan) const;

  // Copies the files of a plan from another run, unless it is here already or not there. Throws InputError.
  void copy(const StoredPlans& from, const std::string& name) const;

  // So that the planners are asked again.
  void delete_faults() const;

 private:
  std::filesystem::path json_file(const std::string& name) const { return folder_ / (name + ".json"); }

  std::filesystem::path folder_;
};

}  // namespace dmrp::host
