// SPDX-License-Identifier: MIT
#include "host/workers/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <dmrp/toolkit/random.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "host/errors/input_error.hpp"
#include "host/experiment/digest.hpp"
#include "host/plugins/call_guard.hpp"
#include "host/plugins/plugin_fault.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr int poll_interval_ms = 100;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr int start_attempts = 3;
constexpr std::int64_t farewell_ns = 2 * second_ns;  // for plugins' deinit() when a run is over

std::string for_shell(const std::string& word) {
  if (word.find_first_of(" \t\"'\\$&;()<>|*?`~#!") == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// A trial that is waited for: what is known of it so far, and which metrics need not be asked (again).
struct OpenTrial {
  TrialRecord record;
  std::vector<std::uint32_t> skip_metrics;
  std::int64_t started_ns = 0;
  std::optional<std::uint32_t> measuring;  // the metric that runs now
};

struct Slot {
  std::unique_ptr<WorkerProcess> worker;
  std::int64_t worker_started_ns = 0;
  bool ready = false;
  std::optional<OpenTrial> trial;
};

// SIGINT, SIGTERM and SIGHUP (unless nohup took it away) as a descriptor to poll, while it lives.
class StopSignals {
 public:
  StopSignals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    struct sigaction hangup {};
    sigaction(SIGHUP, nullptr, &hangup);
    if (hangup.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
    sigprocmask(SIG_BLOCK, &set, &before_);
    descriptor_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~StopSignals() {
    // those that were heeded shall not kill the process when they are let through again
    for (signalfd_siginfo heeded; read(descriptor_, &heeded, sizeof(heeded)) > 0;) {
    }
    close(descriptor_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  sigset_t before_{};
  int descriptor_ = -1;
};

class Supervisor {
 public:
  Supervisor(const Experiment& experiment, const std::vector<std::uint64_t>& trials, const SupervisorSettings& settings,
             const std::function<void(TrialRecord&&)>& on_trial)
      : experiment_(experiment), settings_(settings), on_trial_(on_trial), digest_(experiment_digest(experiment)) {
    log_ = open((settings.run_directory / "log.txt").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (log_ < 0) throw std::runtime_error("cannot write log.txt");
    for (const std::uint64_t trial : trials) waiting_.push_back({blank_record(experiment, trial), {}, 0, {}});
    open_trials_ = trials.size();
    slots_.resize(std::min<std::size_t>(settings.jobs, trials.size()));
  }
  ~Supervisor() { close(log_); }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  RunEnding run(const std::function<void()>& on_idle) {
    const StopSignals stop;
    signal(SIGPIPE, SIG_IGN);
    while (open_trials_ > 0) {
      for (Slot& slot : slots_) supply(slot);
      const std::int64_t before_ns = monotonic_ns();
      if (wait_for_news(stop.descriptor())) return RunEnding::interrupted;
      // a terminal's Ctrl-Z stops the workers too: the time until it goes on is nobody's hang
      if (monotonic_ns() - before_ns > second_ns) awake_since_ns_ = monotonic_ns();
      for (Slot& slot : slots_)
        if (slot.worker) watch(slot);
      on_idle();
    }
    dismiss_workers();
    return RunEnding::done;
  }

 private:
  // Gives the slot a worker, and the worker a trial, if it needs one.
  void supply(Slot& slot) {
    if (slot.trial || waiting_.empty()) return;
    if (!slot.worker) {
      slot.worker = std::make_unique<WorkerProcess>(experiment_.file, experiment_.trials, log_);
      slot.worker_started_ns = monotonic_ns();
      slot.ready = false;
    }
    if (!slot.ready) return;
    slot.trial = std::move(waiting_.front());
    waiting_.pop_front();
    slot.trial->started_ns = monotonic_ns();
    slot.trial->measuring.reset();
    // A worker that died in between is noticed by its closed pipe.
    slot.worker->channel().send(job_of(*slot.trial));
  }

  // Lets plugins say goodbye: destroy() and deinit().
  void dismiss_workers() {
    for (Slot& slot : slots_)
      if (slot.worker) slot.worker->channel().hang_up();
    const std::int64_t until_ns = monotonic_ns() + farewell_ns;
    for (Slot& slot : slots_)
      if (slot.worker)
        slot.worker->ends_within(static_cast<int>(std::max<std::int64_t>(until_ns - monotonic_ns(), 0) / 1'000'000));
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

  // True when the user wants it to end.
  bool wait_for_news(int stop) {
    std::vector<pollfd> watched = {{stop, POLLIN, 0}};
    for (const Slot& slot : slots_)
      if (slot.worker) watched.push_back({slot.worker->channel().read_end(), POLLIN, 0});
    poll(watched.data(), watched.size(), poll_interval_ms);
    std::size_t next = 1;
    for (Slot& slot : slots_) {
      if (!slot.worker) continue;
      if (watched[next++].revents != 0) listen(slot);
    }
    return (watched[0].revents & POLLIN) != 0;
  }

  void listen(Slot& slot) {
    const bool alive = slot.worker->channel().fill();
    try {
      while (slot.worker)
        if (const auto message = slot.worker->channel().take())
          hear(slot, *message);
        else
          break;
    } catch (const nlohmann::json::exception&) {
      FaultRecord fault = fault_at(slot.worker->noted_call());
      fault.kind = fault_kind::abi_breach;
      fault.detail = "the worker process sent a message that cannot be read";
      return end_by_fault(slot, std::move(fault));
    }
    if (!alive && slot.worker) bury(slot);
  }

  void hear(Slot& slot, const nlohmann::json& message) {
    const auto type = message.at("type").get<std::string>();
    if (type == "ready") {
      if (message.at("digest").get<std::string>() != digest_)
        throw InputError(experiment_.file.string() + ": changed (it, a scenario or a plugin) while it was being run");
      slot.ready = true;
      failed_starts_ = 0;
    } else if (type == "error") {
      throw InputError(message.at("text").get<std::string>());
    } else if (slot.trial) {
      hear_of_trial(slot, type, message);
    }
  }

  void hear_of_trial(Slot& slot, const std::string& type, const nlohmann::json& message) {
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
      // should a later metric kill the worker, this one need not fail a second time
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
    fault.rerun =
        fmt::format("dmrp-host run {} --trials {} --shard {}/{} --out rerun-{}", for_shell(experiment_.file.string()),
                    experiment_.trials, trial.record.id, settings_.trial_count, trial.record.id);
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

  // Looks for calls, trials and starts that take too long. The note is only believed where it is possible.
  void watch(Slot& slot) {
    if (slot.ready && !slot.trial) return;
    const auto longest_ns =
        static_cast<std::int64_t>(experiment_.limits.trial_wall_time_s * static_cast<double>(second_ns));
    const std::int64_t began_ns = slot.trial ? slot.trial->started_ns : slot.worker_started_ns;
    const NotedCall call = slot.worker->noted_call();
    const std::int64_t now = monotonic_ns();
    FaultRecord fault = fault_at(call);
    fault.kind = fault_kind::hang;
    if (now - std::max(began_ns, awake_since_ns_) > longest_ns) {
      fault.detail = fmt::format("the {} took longer than trial_wall_time_s = {} s",
                                 slot.trial ? "trial" : "start of a worker", experiment_.limits.trial_wall_time_s);
      return end_by_fault(slot, std::move(fault));
    }
    if (!call.inside || call.start_ns < began_ns || call.start_ns > now) return;
    const std::int64_t limit_ns = call.limit_ns > 0 ? std::min(call.limit_ns, longest_ns) : longest_ns;
    if (now - std::max(call.start_ns, awake_since_ns_) <= limit_ns) return;
    fault.detail = fmt::format("did not return within {:.1f} s", static_cast<double>(now - call.start_ns) * 1e-9);
    end_by_fault(slot, std::move(fault));
  }

  // The worker died by itself.
  void bury(Slot& slot) {
    FaultRecord fault = fault_at(slot.worker->noted_call());
    slot.worker->kill();  // it may have closed its channel and live on; one that is dying keeps its status
    const int status = slot.worker->wait();
    if (WIFSIGNALED(status)) {
      fault.kind = fault_kind::crash;
      fault.signal = WTERMSIG(status);
      fault.detail = strsignal(fault.signal);
    } else if (WEXITSTATUS(status) == out_of_memory_exit) {
      fault.kind = fault_kind::out_of_memory;
      fault.detail = fmt::format("more than memory_mb = {}", experiment_.limits.memory_mb);
    } else {
      fault.kind = fault_kind::exit;
      fault.detail = fmt::format("the process ended with status {}", WEXITSTATUS(status));
    }
    end_by_fault(slot, std::move(fault));
  }

  // Ends the worker, and with it what it was about.
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

  // A metric that killed the worker loses only itself: the trial is run again without it. Otherwise it is over.
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
  int log_ = -1;
  std::deque<OpenTrial> waiting_;
  std::vector<Slot> slots_;
  std::size_t open_trials_ = 0;
  int failed_starts_ = 0;
  std::int64_t awake_since_ns_ = 0;
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
