// SPDX-License-Identifier: MIT
#include "host/workers/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <dmrp/toolkit/random.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/experiment/digest.hpp"
#include "host/process/stop_signals.hpp"
#include "host/process/watchdog.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr int start_attempts = 3;
constexpr std::int64_t shutdown_limit_ns = 2 * second_ns;  // for destroy() and deinit() of plugins

std::string quoted_for_shell(const std::string& word) {
  if (word.find_first_of(" \t\"'\\$&;()<>|*?`~#!") == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// A trial that is not over: its results so far.
struct OpenTrial {
  TrialRecord record;
  std::vector<std::uint32_t> skip_metrics;  // that are measured, or ended in a fault
  std::int64_t started_ns = 0;
  std::optional<std::uint32_t> measuring;  // the metric that runs
};

struct Slot {
  std::unique_ptr<WorkerProcess> worker;
  std::int64_t worker_started_ns = 0;
  bool ready = false;
  std::optional<OpenTrial> trial;
};

class Supervisor {
 public:
  Supervisor(const Experiment& experiment, const std::vector<std::uint64_t>& trials, const SupervisorSettings& settings,
             const std::function<void(TrialRecord&&)>& on_trial)
      : experiment_(experiment), settings_(settings), on_trial_(on_trial), digest_(experiment_digest(experiment)) {
    const fs::path log = settings.run_directory / "log.txt";
    log_ = Descriptor(open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
    if (!log_.is_open()) throw std::system_error(errno, std::generic_category(), log.string());
    for (const std::uint64_t trial : trials) waiting_.push_back({blank_record(experiment, trial), {}, 0, {}});
    open_trials_ = trials.size();
    slots_.resize(std::min<std::size_t>(settings.jobs, trials.size()));
  }

  RunEnding run(const std::function<void()>& on_idle) {
    const StopSignals stop;
    while (open_trials_ > 0) {
      for (Slot& slot : slots_) assign_work(slot);
      if (wait_for_messages(stop.descriptor())) return RunEnding::interrupted;
      for (Slot& slot : slots_)
        if (slot.worker) check_time(slot);
      on_idle();
    }
    shut_down_workers();
    return RunEnding::done;
  }

 private:
  // Starts a worker if the slot has none, and gives an idle worker a trial.
  void assign_work(Slot& slot) {
    if (slot.trial || waiting_.empty()) return;
    if (!slot.worker) {
      slot.worker = std::make_unique<WorkerProcess>(experiment_.file, experiment_.trials, log_.number());
      slot.worker_started_ns = monotonic_ns();
      slot.ready = false;
    }
    if (!slot.ready) return;
    slot.trial = std::move(waiting_.front());
    waiting_.pop_front();
    slot.trial->started_ns = monotonic_ns();
    slot.trial->measuring.reset();
    // a worker that has died is noticed by its closed pipe
    slot.worker->channel().send(job_of(*slot.trial));
  }

  // Lets the workers call destroy() and deinit() of the plugins.
  void shut_down_workers() {
    for (Slot& slot : slots_)
      if (slot.worker) slot.worker->channel().close_write_end();
    const std::int64_t until_ns = monotonic_ns() + shutdown_limit_ns;
    for (Slot& slot : slots_)
      if (slot.worker)
        watchdog_.wait(slot.worker->process().ended().number(), [&] { return monotonic_ns() >= until_ns; });
  }

  nlohmann::json job_of(const OpenTrial& trial) const {
    Job job;
    job.trial = trial.record.id;
    job.skip_metrics = trial.skip_metrics;
    job.known_events = trial.record.events;
    job.keep_trace_of_success = experiment_.traces == RecordTraces::all;
    const fs::path directory = fs::absolute(settings_.run_directory);
    if (experiment_.traces != RecordTraces::none)
      job.trace_file = (directory / "traces" / fmt::format("trial_{:06}.mcap", trial.record.id)).string();
    job.scratch_file = (directory / fmt::format("trial_{:06}.scratch", trial.record.id)).string();
    return job;
  }

  // True when a signal asks to stop.
  bool wait_for_messages(int stop) {
    std::vector<pollfd> watched = {{stop, POLLIN, 0}};
    for (const Slot& slot : slots_)
      if (slot.worker) watched.push_back({slot.worker->channel().read_end(), POLLIN, 0});
    watchdog_.wait(watched);
    std::size_t next = 1;
    for (Slot& slot : slots_) {
      if (!slot.worker) continue;
      if (watched[next++].revents != 0) read_messages(slot);
    }
    return (watched[0].revents & POLLIN) != 0;
  }

  void read_messages(Slot& slot) {
    const bool open = slot.worker->channel().fill();
    try {
      while (slot.worker)
        if (const auto message = slot.worker->channel().take())
          read_message(slot, *message);
        else
          break;
    } catch (const nlohmann::json::exception&) {
      FaultRecord fault = fault_at(slot.worker->last_call());
      fault.kind = fault_kind::abi_breach;
      fault.detail = "the worker process sent a message that cannot be read";
      return end_by_fault(slot, std::move(fault));
    }
    if (!open && slot.worker) reap(slot);
  }

  void read_message(Slot& slot, const nlohmann::json& message) {
    const auto type = message.at("type").get<std::string>();
    if (type == "ready") {
      if (message.at("digest").get<std::string>() != digest_)
        throw InputError(experiment_.file.string() + ": changed (it, a scenario or a plugin) while it was being run");
      slot.ready = true;
      failed_starts_ = 0;
    } else if (type == "error") {
      const auto text = message.at("text").get<std::string>();
      if (message.at("machine").get<bool>()) throw MachineError(text);
      throw InputError(text);
    } else if (slot.trial) {
      read_trial_message(slot, type, message);
    }
  }

  void read_trial_message(Slot& slot, const std::string& type, const nlohmann::json& message) {
    OpenTrial& trial = *slot.trial;
    if (type == "measuring") {
      trial.measuring = message.at("index").get<std::uint32_t>();
    } else if (type == "metric") {
      auto result = message.get<MetricResult>();
      std::move(result.values.begin(), result.values.end(), std::back_inserter(trial.record.values));
      std::move(result.events.begin(), result.events.end(), std::back_inserter(trial.record.events));
      trial.skip_metrics.push_back(result.index);
    } else if (type == "fault") {
      if (message.at("fatal").get<bool>()) return end_by_fault(slot, message.get<FaultRecord>());
      add_fault(trial, message.get<FaultRecord>());
      // should a later metric kill the worker, this one is not measured a second time
      if (trial.measuring) trial.skip_metrics.push_back(*trial.measuring);
    } else if (type == "done") {
      const auto done = message.get<TrialDone>();
      trial.record.outcome = done.outcome;
      trial.record.repeatable = done.repeatable;
      trial.record.sim_time_s = done.sim_time_s;
      finish(slot);
    }
  }

  void add_fault(OpenTrial& trial, FaultRecord fault) const {
    fault.rerun = fmt::format("dmrp-host run {} --trials {} --shard {}/{} --out rerun-{}",
                              quoted_for_shell(experiment_.file.string()), experiment_.trials, trial.record.id,
                              settings_.trial_count, trial.record.id);
    trial.record.faults.push_back(std::move(fault));
  }

  void finish(Slot& slot) {
    slot.trial->record.wall_time_s =
        static_cast<double>(monotonic_ns() - slot.trial->started_ns) / static_cast<double>(second_ns);
    TrialRecord record = std::move(slot.trial->record);
    slot.trial.reset();
    --open_trials_;
    on_trial_(std::move(record));
  }

  // Ends a worker whose call, trial or start takes too long.
  void check_time(Slot& slot) {
    if (slot.ready && !slot.trial) return;
    const auto longest_ns =
        static_cast<std::int64_t>(experiment_.limits.trial_wall_time_s * static_cast<double>(second_ns));
    const std::int64_t began_ns = slot.trial ? slot.trial->started_ns : slot.worker_started_ns;
    const NotedCall call = slot.worker->last_call();
    FaultRecord fault = fault_at(call);
    fault.kind = fault_kind::hang;
    if (watchdog_.elapsed_ns(began_ns) > longest_ns) {
      fault.detail = fmt::format("the {} took longer than trial_wall_time_s = {} s",
                                 slot.trial ? "trial" : "start of a worker", experiment_.limits.trial_wall_time_s);
      return end_by_fault(slot, std::move(fault));
    }
    const std::int64_t limit_ns = call.limit_ns > 0 ? std::min(call.limit_ns, longest_ns) : longest_ns;
    if (!watchdog_.is_overdue(call, began_ns, limit_ns)) return;
    fault.detail =
        fmt::format("did not return within {:.1f} s", static_cast<double>(monotonic_ns() - call.start_ns) * 1e-9);
    end_by_fault(slot, std::move(fault));
  }

  // The worker ended by itself.
  void reap(Slot& slot) {
    FaultRecord fault = fault_at(slot.worker->last_call());
    ChildProcess& process = slot.worker->process();
    process.kill();  // it can have closed its channel and live on; one that is dying keeps its status
    const ProcessEnding& ending = process.wait();
    fault.kind = ending.fault_kind();
    if (ending.signal != 0) {
      fault.signal = ending.signal;
      fault.detail = strsignal(fault.signal);
    } else if (ending.exit_status == out_of_memory_exit) {
      fault.detail = fmt::format("more than memory_mb = {}", experiment_.limits.memory_mb);
    } else {
      fault.detail = fmt::format("the process ended with status {}", ending.exit_status);
    }
    end_by_fault(slot, std::move(fault));
  }

  // Kills the worker, and ends its trial.
  void end_by_fault(Slot& slot, FaultRecord fault) {
    slot.worker.reset();
    if (slot.trial)
      conclude(slot, std::move(fault));
    else if (!slot.ready && (fault.kind == fault_kind::hang || ++failed_starts_ >= start_attempts))
      throw std::runtime_error(fmt::format("worker processes fail as they start: {}{}; see {}",
                                           fault.plugin.empty() ? "" : fault.plugin + " " + fault.function + "(): ",
                                           fault.detail, (settings_.run_directory / "log.txt").string()));
  }

  static FaultRecord fault_at(const NotedCall& call) {
    FaultRecord fault;
    if (!call.inside) return fault;
    fault.plugin = call.plugin;
    fault.function = call.function;
    fault.step = std::max<std::int64_t>(call.step, 0);
    fault.robot = std::max(call.robot, -1);
    return fault;
  }

  // A trial whose metric killed the worker is run again without that metric. Otherwise the trial is over.
  void conclude(Slot& slot, FaultRecord fault) {
    OpenTrial& trial = *slot.trial;
    if (fault.kind == fault_kind::hang) trial.record.repeatable = false;
    add_fault(trial, std::move(fault));
    if (trial.measuring) {
      trial.skip_metrics.push_back(*trial.measuring);
      waiting_.push_front(std::move(trial));
      slot.trial.reset();
    } else {
      trial.record.outcome = trial_outcome::fault;
      finish(slot);
    }
  }

  const Experiment& experiment_;
  const SupervisorSettings& settings_;
  const std::function<void(TrialRecord&&)>& on_trial_;
  const std::string digest_;
  Descriptor log_;
  Watchdog watchdog_;
  std::deque<OpenTrial> waiting_;
  std::vector<Slot> slots_;
  std::size_t open_trials_ = 0;
  int failed_starts_ = 0;
};

}  // namespace

RunEnding supervise(const Experiment& experiment, const std::vector<std::uint64_t>& trials,
                    const SupervisorSettings& settings, const std::function<void(TrialRecord&&)>& on_trial,
                    const std::function<void()>& on_idle) {
  return Supervisor(experiment, trials, settings, on_trial).run(on_idle);
}

TrialRecord blank_record(const Experiment& experiment, std::uint64_t trial) {
  const auto all = combinations(experiment);
  const TrialId id = trial_id(trial, all.size());
  const Combination& combination = all[id.combination];
  const ScenarioVariant& variant = experiment.scenarios[combination.scenario];
  TrialRecord record;
  record.id = trial;
  record.scenario = variant.scenario.name;
  record.robots = robot_count(variant);
  const auto label = [](const std::vector<PluginUse>& uses, std::int32_t index) {
    return index < 0 ? std::string() : uses[static_cast<std::size_t>(index)].label;
  };
  record.global_planner = label(experiment.global_planners, combination.global_planner);
  record.local_controller = label(experiment.local_controllers, combination.local_controller);
  record.pedestrian_model = label(experiment.pedestrian_models, combination.pedestrian_model);
  record.repetition = id.repetition;
  record.seed = trial_seed(experiment, trial);
  return record;
}

}  // namespace dmrp::host
