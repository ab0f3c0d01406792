// SPDX-License-Identifier: MIT
#include "host/results/trial_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host/files/sha256.hpp"

namespace dmrp::host {

namespace {

class RowHash {
 public:
  RowHash& add(std::uint64_t number) {
    hash_.add(&number, sizeof(number));
    return *this;
  }
  RowHash& add(const std::string& text) {
    add(text.size());
    hash_.add(text.data(), text.size());
    return *this;
  }
  // A database has neither -0 nor numbers that are undefined.
  RowHash& add(std::optional<double> number) {
    const bool has_number = number && !std::isnan(*number);
    const double stored = has_number ? *number + 0.0 : std::numeric_limits<double>::infinity();
    add(std::uint64_t{has_number});
    hash_.add(&stored, sizeof(stored));
    return *this;
  }

  std::string finish() { return hash_.finish(); }

 private:
  Sha256 hash_;
};

}  // namespace

std::string row_sha256(const TrialRecord& row) {
  RowHash hash;
  hash.add(row.id).add(row.scenario).add(row.robots).add(row.global_planner).add(row.local_controller);
  hash.add(row.pedestrian_model).add(row.repetition).add(row.seed).add(row.outcome).add(row.repeatable);
  hash.add(std::optional(row.sim_time_s)).add(std::optional(row.wall_time_s)).add(row.task).add(row.task_is_drawn);
  hash.add(row.plan_sha256).add(row.trace_sha256);
  for (const SweptValue& swept : row.swept) hash.add(swept.table).add(swept.key).add(swept.value);
  for (const MetricValue& value : row.values) {
    hash.add(value.metric).add(value.subject_kind).add(value.subject.has_value()).add(value.subject.value_or(0));
    hash.add(value.coordinate).add(value.value);
  }
  return hash.finish();
}

std::string misplacement(const TrialRecord& row, const TrialRecord& place) {
  const auto differ = [](const char* what, const auto& is, const auto& should) {
    return fmt::format("its {} is '{}', in this experiment '{}'", what, is, should);
  };
  if (row.scenario != place.scenario) return differ("scenario", row.scenario, place.scenario);
  if (row.robots != place.robots) return differ("number of robots", row.robots, place.robots);
  if (row.global_planner != place.global_planner) return differ("planner", row.global_planner, place.global_planner);
  if (row.local_controller != place.local_controller)
    return differ("controller", row.local_controller, place.local_controller);
  if (row.pedestrian_model != place.pedestrian_model)
    return differ("pedestrian model", row.pedestrian_model, place.pedestrian_model);
  if (row.repetition != place.repetition) return differ("repetition", row.repetition, place.repetition);
  if (row.seed != place.seed) return differ("seed", row.seed, place.seed);
  return row.swept == place.swept ? "" : "its swept values are others than in this experiment";
}

}  // namespace dmrp::host
