// SPDX-License-Identifier: MIT
#include "host/run/run_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "host/files/temporary_folder.hpp"
#include "host/program/monotonic_time.hpp"
#include "host/results/trace_path.hpp"
#include "host/workers/supervisor.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t longest_sample_ns = 5'000'000'000;
constexpr std::int64_t longest_wait_ns = 20'000'000'000;  // for the first trial
constexpr double bytes_of_value = 72.0;  // in results.sqlite, over the run of examples/paper_table_3.toml
constexpr double bytes_of_event = 200.0;

using Unit = std::pair<double, const char*>;

// Writes two digits, in the largest unit of which there is one at least: "1.5 h", "40 min".
std::string rounded(double value, const std::vector<Unit>& units) {
  Unit unit = units.front();
  for (const Unit& larger : units)
    if (value >= larger.first) unit = larger;
  const double shown = value / unit.first;
  return shown < 9.95 ? fmt::format("{:.1f} {}", shown, unit.second)
                      : fmt::format("{:.0f} {}", shown < 99.5 ? shown : std::round(shown / 10.0) * 10.0, unit.second);
}

std::string time_words(double s) {
  return rounded(s, {{1.0, "s"}, {60.0, "min"}, {3600.0, "h"}, {86400.0, "days"}});
}

std::string size_words(double bytes) {
  return rounded(bytes, {{1e3, "kB"}, {1e6, "MB"}, {1e9, "GB"}});
}

// What makes trials long: those who move in it.
double bodies_of(const Experiment& experiment, const Combination& combination) {
  const ScenarioVariant& variant = experiment.scenarios[combination.scenario];
  return std::max(1.0, static_cast<double>(robot_count(variant) + core::person_count(variant.scenario)));
}

// The first trial of each combination, those of one scenario far apart.
std::vector<std::uint64_t> first_trials(std::size_t combinations) {
  auto step = static_cast<std::size_t>(0.618 * static_cast<double>(combinations)) + 1;
  while (std::gcd(step, combinations) != 1) ++step;
  std::vector<std::uint64_t> trials(combinations);
  for (std::size_t i = 0; i < combinations; ++i) trials[i] = i * step % combinations;
  return trials;
}

}  // namespace

RunCost::RunCost(const Experiment& experiment, std::uint64_t trials, unsigned jobs, fs::path directory)
    : experiment_(experiment),
      combinations_(combinations(experiment)),
      trials_(static_cast<double>(trials)),
      jobs_(static_cast<double>(std::min<std::uint64_t>(jobs, trials))),
      directory_(std::move(directory)),
      start_ns_(monotonic_ns()),
      wall_s_(combinations_.size()) {}

void RunCost::add(const TrialRecord& trial) {
  wall_s_[trial_id(trial.id, combinations_.size()).combination] = trial.wall_time_s;
  ++ended_;
  if (trial.outcome != trial_outcome::succeeded) ++failed_;
  result_bytes_ += bytes_of_value * static_cast<double>(trial.values.size()) +
                   bytes_of_event * static_cast<double>(trial.events.size());
  std::error_code none;
  const auto size = fs::file_size(trace_path(directory_, trial.id), none);
  if (none) return;
  ++traces_;
  trace_bytes_ += static_cast<double>(size);
}

bool RunCost::is_known() const {
  return monotonic_ns() - start_ns_ >= (ended_ > 0.0 ? longest_sample_ns : longest_wait_ns) ||
         std::all_of(wall_s_.begin(), wall_s_.end(), [](double s) { return s > 0.0; });
}

// Combinations of which no trial has ended take as long a body as the others.
double RunCost::wall_s() const {
  double timed_s = 0.0;
  double timed_bodies = 0.0;
  double bodies = 0.0;
  for (std::size_t i = 0; i < wall_s_.size(); ++i) {
    const double in_this = bodies_of(experiment_, combinations_[i]);
    bodies += in_this;
    if (wall_s_[i] > 0.0) timed_bodies += in_this;
    timed_s += wall_s_[i];
  }
  const double mean_s = timed_s / timed_bodies * bodies / static_cast<double>(wall_s_.size());
  return trials_ * mean_s / jobs_;
}

double RunCost::bytes() const {
  const double failed = failed_ / ended_;
  const double first = static_cast<double>(wall_s_.size()) / trials_;
  const double kept = std::min(1.0, experiment_.traces == RecordTraces::all      ? 1.0
                                    : experiment_.traces == RecordTraces::some   ? first + failed
                                    : experiment_.traces == RecordTraces::failed ? failed
                                                                                 : 0.0);
  const double trace = traces_ > 0.0 ? trace_bytes_ / traces_ : 0.0;
  return trials_ * (result_bytes_ / ended_ + kept * trace);
}

std::string RunCost::words() const {
  if (ended_ == 0.0)
    return "probably more than " + time_words(trials_ / jobs_ * static_cast<double>(monotonic_ns() - start_ns_) * 1e-9);
  return fmt::format("about {}, {}", time_words(wall_s()), size_words(bytes()));
}

std::optional<std::string> sampled_cost(const Experiment& experiment, unsigned jobs) {
  const std::size_t count = combinations(experiment).size();
  const std::uint64_t trials = count * experiment.trials;
  if (trials < fewest_trials_with_cost) return "";
  const TemporaryFolder folder("dmrp_validate");
  fs::create_directories(folder.path() / "traces");
  RunCost cost(experiment, trials, jobs, folder.path());
  const SupervisorSinks sinks = {[&](TrialRecord&& trial) { cost.add(trial); },
                                 [](std::uint64_t, const FaultRecord&) {}, [](const std::string&) {},
                                 [&] { return !cost.is_known(); }};
  const RunEnding ending =
      supervise(experiment, PlannedTrials(first_trials(count)), {jobs, folder.path(), trials}, sinks);
  if (ending == RunEnding::interrupted && !cost.is_known()) return std::nullopt;
  return cost.words();
}

}  // namespace dmrp::host
