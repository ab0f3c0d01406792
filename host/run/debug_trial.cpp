// SPDX-License-Identifier: MIT
#include "host/run/debug_trial.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "core/trace/trace_encoder.hpp"
#include "core/trace/trace_reader.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/experiment.hpp"
#include "host/guests/fork_server.hpp"
#include "host/guests/inside/log_line.hpp"
#include "host/guests/probe.hpp"
#include "host/plans/plan_file.hpp"
#include "host/process/box.hpp"
#include "host/program/exit_status.hpp"
#include "host/trial/ask_metric.hpp"
#include "host/trial/run_trial.hpp"

namespace dmrp::host {

namespace {

// In this process: a debugger sees one process, which loads each library once.
Probe load_here(const std::filesystem::path& file, const VisiblePaths&) {
  const Library library(file);
  return {library.plugins(), library.warnings(), library.objects(), ""};
}

void print_values(const MetricResult& result) {
  for (const MetricValue& value : result.values)
    if (value.subject_kind == DMRP_SUBJECT_SYSTEM && !value.coordinate)
      fmt::print("  {:<28}{}\n", value.metric, value.value ? fmt::format("{:.6g}", *value.value) : "-");
}

class DebuggedTrial {
 public:
  DebuggedTrial(const Experiment& experiment, std::uint64_t trial)
      : experiment_(experiment),
        combinations_(combinations(experiment)),
        combination_(combinations_[trial_id(trial, combinations_.size()).combination]),
        seed_(trial_seed(experiment, trial)),
        shared_(experiment, experiment.scenarios[combination_.scenario]),
        guard_(note_),
        guests_(Guests::local(experiment.libraries, note_, guard_,
                              [this](std::int32_t level, const std::string& plugin, const std::string& text) {
                                std::fputs(log_line(level, plugin, text, logged_, note_).c_str(), stderr);
                              })) {
    const ScenarioVariant& scenario = experiment.scenarios[combination_.scenario];
    if (is_drawn(scenario))
      own_ = std::make_unique<VariantWorld>(experiment, scenario, shared_,
                                            task_seed(experiment, scenario.scenario.name, scenario.wishes,
                                                      trial_id(trial, combinations_.size()).repetition));
    logged_ = {trial, world().simulation.step_ns};
    // while a breakpoint holds, time passes: it does not count
    guard_.stop_after_asks(std::numeric_limits<std::int64_t>::max());
  }

  int run() {
    try {
      run_and_measure();
      return exit_status::done;
    } catch (const PluginFault& fault) {
      fmt::print("{}: {}\n", fault.kind(), fault.text());
      std::fflush(nullptr);
      if (fault.fatal()) _exit(exit_status::faults);  // no function of the library may be called again
      return exit_status::faults;
    }
  }

 private:
  void run_and_measure() {
    std::vector<std::uint8_t> bytes;
    core::TraceEncoder trace(world().view.world(), [&](std::int64_t, std::span<const std::uint8_t> record) {
      bytes.insert(bytes.end(), record.begin(), record.end());
    });
    guests_.begin_trial({logged_->number, logged_->step_ns});
    const std::optional<PlannerAnswer> plan = plan_of_file();
    const TrialEnding ending =
        run_trial({experiment_, combination_, world(), seed_, {plan ? &*plan : nullptr, {}}}, guests_, trace);
    core::TraceReader reader(bytes);
    fmt::print("{} after {:.2f} s\n", reader.reason(), ending.sim_time_s);
    const auto robots = static_cast<std::uint32_t>(world().scenario.robots.size());
    for (std::uint32_t i = 0; i < experiment_.metrics.size(); ++i)
      print_values(ask_metric(guests_, experiment_.metrics[i], i, {bytes, &world(), robots, seed_, ending.sim_time_s},
                              experiment_.limits.step_time_s));
  }

  std::optional<PlannerAnswer> plan_of_file() const {
    if (combination_.global_planner < 0) return std::nullopt;
    const PlanFiles& files = experiment_.global_planners[static_cast<std::size_t>(combination_.global_planner)].plans;
    if (!files.is_given()) return std::nullopt;
    StagedProblem problem;
    stage_first_problem(experiment_, world(), problem);
    const std::uint32_t repetition = trial_id(logged_->number, combinations_.size()).repetition;
    return PlansOfFiles(files).answer(repetition, task_hash(world().scenario), problem.c);
  }

  const VariantWorld& world() const { return own_ ? *own_ : shared_; }

  const Experiment& experiment_;
  std::vector<Combination> combinations_;
  Combination combination_;
  std::uint64_t seed_;
  VariantWorld shared_;
  std::unique_ptr<const VariantWorld> own_;  // of this trial, if robots are drawn; instances keep pointers into it
  CallNote note_{};
  std::optional<LoggedTrial> logged_;
  CallGuard guard_;
  Guests guests_;
};

}  // namespace

int debug_trial(const std::filesystem::path& file, std::uint32_t trials, std::uint64_t trial) {
  box::disable();  // another debugger can attach
  const Experiment experiment = load_experiment(file, trials, &load_here, &probe_library);
  end_own_fork_server();  // a child process would count as a plugin's
  const std::uint64_t count = combinations(experiment).size() * experiment.trials;
  if (trial >= count)
    throw InputError(fmt::format("--debug {}: {} has the trials 0 to {}", trial, file.string(), count - 1));
  return DebuggedTrial(experiment, trial).run();
}

}  // namespace dmrp::host
