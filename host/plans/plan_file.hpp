// SPDX-License-Identifier: MIT
// plan_file.hpp: reads plans in CSV, those that a run has stored and those of other programs. The header says which:
//
//   robot,t_ns,x,y,theta,goal_index   in metres, times from the trial's start. An empty theta: any heading
//   agent,t,x,y                       in cells of the planning grid, y from the top, and steps of the plan
//
// Before them there can be a column `task` (TrialRecord::task): then the file has a plan for each of these tasks,
// otherwise one for every task. The rows of a task are together, and in them those of a robot, in order.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "host/files/text_lines.hpp"
#include "host/plans/planning.hpp"
#include "host/plugins/plugin_use.hpp"

namespace dmrp::host {

inline constexpr const char* stored_plan_header = "robot,t_ns,x,y,theta,goal_index";

// All functions throw InputError at the line and column of a mistake.
class PlanFile {
 public:
  explicit PlanFile(const std::filesystem::path& file);

  bool holds(const std::string& task) const { return !has_tasks_ || tasks_.contains(task); }

  // The plan of a task that it holds. `problem` says what cells, steps and goals are.
  PlannedPaths paths(const std::string& task, const dmrp_planning_problem& problem) const;
  // Of a file with the stored_plan_header.
  PlannedPaths stored_paths() const;

  // Says what is wrong with a plan at the row of a waypoint; at the last row, if there is no such waypoint.
  [[noreturn]] void fail(const std::string& task, std::size_t robot, std::size_t waypoint,
                         const std::string& text) const;

 private:
  struct Rows {
    std::size_t begin = 2;  // numbers of lines
    std::size_t end = 2;
  };
  class RowReader;

  void find_tasks();
  Rows rows_of(const std::string& task) const { return tasks_.at(has_tasks_ ? task : ""); }
  PlannedPaths read(Rows rows, const std::function<dmrp_waypoint(RowReader& row)>& waypoint) const;

  TextLines lines_;
  bool has_tasks_ = false;
  bool in_cells_ = false;
  std::map<std::string, Rows> tasks_;  // without a column: of ""
};

// The plans of a use, as a planner would answer.
class PlansOfFiles {
 public:
  explicit PlansOfFiles(const PlanFiles& files) : files_(files) {}

  // Without a plan of the task the status is DMRP_NO_SOLUTION, and the text names file and task. Throws InputError.
  PlannerAnswer answer(std::uint32_t repetition, const std::string& task, const dmrp_planning_problem& problem);

  // That answered last.
  const PlanFile& file() const { return *file_; }

 private:
  const PlanFiles& files_;
  std::filesystem::path path_;
  std::unique_ptr<const PlanFile> file_;
};

}  // namespace dmrp::host
