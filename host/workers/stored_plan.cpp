// SPDX-License-Identifier: MIT
#include "host/workers/stored_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "host/errors/input_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/read_file.hpp"
#include "host/files/sha256.hpp"
#include "host/plans/plan_file.hpp"
#include "host/results/csv.hpp"
#include "host/workers/messages.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool same_waypoint(const dmrp_waypoint& a, const dmrp_waypoint& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.theta, b.theta) && a.t_ns == b.t_ns &&
         a.goal_index == b.goal_index;
}

}  // namespace

std::string plan_name(const Combination& combination, std::uint32_t repetition) {
  if (combination.global_planner < 0) return "";
  return fmt::format("scenario_{:02}_planner_{:02}_repetition_{:06}", combination.scenario, combination.global_planner,
                     repetition);
}

std::string plan_csv(const PlannedPaths& paths) {
  CsvWriter csv;
  for (const char* column : {"robot", "t_ns", "x", "y", "theta", "goal_index"}) csv.field(column);
  csv.end_line();
  for (std::size_t robot = 0; robot < paths.size(); ++robot)
    for (const dmrp_waypoint& w : paths[robot]) {
      csv.field(robot).field(w.t_ns).field(w.x).field(w.y).field(w.theta).field(w.goal_index);
      csv.end_line();
    }
  return csv.text();
}

PlannedPaths read_plan_csv(const fs::path& file) {
  return PlanFile(file).stored_paths();
}

bool same_plan(const PlannerAnswer& a, const PlannerAnswer& b) {
  return a.status == b.status &&
         std::equal(a.paths.begin(), a.paths.end(), b.paths.begin(), b.paths.end(),
                    [](const auto& one, const auto& other) {
                      return std::equal(one.begin(), one.end(), other.begin(), other.end(), same_waypoint);
                    });
}

std::string outcome_of(const StoredPlan& plan) {
  return plan.fault ? plan.fault->kind : fmt::format("{} {}", plan.answer.status, plan.paths_sha256);
}

StoredPlans::StoredPlans(const fs::path& run_directory) : folder_(fs::absolute(run_directory) / "plans") {}

bool StoredPlans::has(const std::string& name) const {
  std::error_code ignored;
  return fs::is_regular_file(json_file(name), ignored);
}

std::vector<std::string> StoredPlans::names() const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".json") names.push_back(entry->path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

StoredPlan StoredPlans::read_call(const std::string& name) const {
  const std::string shown_path = shown(json_file(name));
  try {
    return nlohmann::json::parse(read_file(json_file(name), shown_path)).get<StoredPlan>();
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: is no stored plan: {}", shown_path, error.what()));
  }
}

StoredPlan StoredPlans::read(const std::string& name) const {
  StoredPlan plan = read_call(name);
  if (!plan.fault) plan.answer.paths = read_plan_csv(csv_file(name));
  return plan;
}

void StoredPlans::check_paths(const std::string& name, const StoredPlan& call) const {
  if (!call.fault && sha256_of_file(csv_file(name)) != call.paths_sha256)
    throw InputError(csv_file(name).string() + ": was changed after the planner was asked");
}

void StoredPlans::write_call(const std::string& name, StoredPlan plan) const {
  fs::create_directories(folder_);
  if (!plan.fault) plan.paths_sha256 = sha256_of_file(csv_file(name));
  write_file_atomically(json_file(name), nlohmann::json(plan).dump(2) + "\n");
}

void StoredPlans::copy(const StoredPlans& from, const std::string& name) const {
  if (has(name) || !from.has(name)) return;
  from.check_paths(name, from.read_call(name));
  fs::create_directories(folder_);
  if (fs::exists(from.csv_file(name))) fs::copy_file(from.csv_file(name), csv_file(name));
  fs::copy_file(from.json_file(name), json_file(name));
}

void StoredPlans::delete_faults() const {
  for (const std::string& name : names())
    if (read_call(name).fault) fs::remove(json_file(name));
}

}  // namespace dmrp::host
