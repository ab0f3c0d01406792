// SPDX-License-Identifier: MIT
#include "host/workers/supervisor.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/experiment/identity.hpp"
#include "host/files/open_log.hpp"
#include "host/files/try_to_write.hpp"
#include "host/process/memory_group.hpp"
#include "host/process/orphans.hpp"
#include "host/process/stop_signals.hpp"
#include "host/process/watchdog.hpp"
#include "host/results/trace_path.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/open_trial.hpp"
#include "host/workers/rerun_command.hpp"
#include "host/workers/scratch_folder.hpp"
#include "host/workers/stored_file.hpp"
#include "host/workers/stored_plan.hpp"
#include "host/workers/whole_number.hpp"
#include "host/workers/worker_fault.hpp"
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr int start_attempts = 3;
constexpr int most_kills = 4;  // of one trial: then a plugin of it is to blame, not somebody outside
constexpr int most_kills_between_trials = 20;
constexpr std::int64_t long_call_ns = second_ns;
constexpr std::int64_t shutdown_limit_ns = 2 * second_ns;  // for destroy() and deinit() of plugins

// Something of a worker that may take so long.
struct Watch {
  std::int64_t start_ns = 0;
  std::int64_t waited_before_ns = 0;  // by the worker, before the start
};

struct Slot {
  std::unique_ptr<ScratchFolder> scratch;  // outlives the worker
  std::unique_ptr<WorkerProcess> worker;
  std::int64_t worker_started_ns = 0;
  Watch work;       // the start of the worker, or its trial
  Watch long_call;  // the last that took long
  bool ready = false;
  bool listening = true;    // the worker's end of the channel is open
  bool makes_plan = false;  // its trial has still to give the plan that others wait for
  int trials_begun = 0;     // by this worker
  std::optional<OpenTrial> trial;
  std::optional<std::uint64_t> last_trial;  // that this worker finished
};

std::uint64_t new_stamp() {
  std::uint64_t stamp = 0;
  while (stamp == 0)
    if (getrandom(&stamp, sizeof(stamp), 0) != sizeof(stamp)) throw MachineError("getrandom", errno);
  return stamp;
}

class Supervisor {
 public:
  Supervisor(const Experiment& experiment, PlannedTrials trials, const SupervisorSettings& settings,
             const SupervisorSinks& sinks)
      : experiment_(experiment),
        settings_(settings),
        sinks_(sinks),
        digest_(loaded_digest(experiment)),
        combinations_(combinations(experiment)),
        plans_(settings.run_directory),
        log_(open_log(settings.run_directory / "log.txt")),
        planned_(std::move(trials)),
        open_trials_(planned_.left()) {
    delete_scratch_folders(settings.run_directory);  // of a supervisor that was killed
    adopt_orphans();
    slots_.resize(std::min<std::uint64_t>(settings.jobs, open_trials_));
  }

  ~Supervisor() {
    slots_.clear();
    kill_orphans({});
    delete_scratch_folders(settings_.run_directory);
  }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  RunEnding run() {
    const StopSignals stop;
    while (open_trials_ > 0) {
      for (Slot& slot : slots_) assign_work(slot);
      if (wait_for_workers(stop.descriptor())) return RunEnding::interrupted;
      if (watches_memory_ && monotonic_ns() >= next_look_at_memory_ns_) look_at_memory();
      for (Slot& slot : slots_)
        if (slot.worker) check_time(slot);
      sinks_.on_idle();
    }
    shut_down_workers();
    return RunEnding::done;
  }

 private:
  // Starts a worker if the slot has none, and gives an idle worker a trial.
  void assign_work(Slot& slot) {
    if (slot.trial || (again_.empty() && waiting_.empty() && planned_.left() == 0)) return;
    if (!slot.worker) {
      slot = Slot();
      slot.scratch = std::make_unique<ScratchFolder>(settings_.run_directory);
      slot.worker = std::make_unique<WorkerProcess>(experiment_, slot.scratch->path());
      slot.worker_started_ns = monotonic_ns();
      slot.work = {slot.worker_started_ns, 0};
      allow_cpu(slot);
    }
    if (!slot.ready) return;
    slot.trial = next_trial();
    if (!slot.trial) return;
    slot.trial->started_ns = monotonic_ns();
    slot.work = {slot.trial->started_ns, slot.worker->process().waited_for_processor_ns()};
    // a worker that has died is noticed by its end
    slot.scratch->restore();
    allow_cpu(slot);
    Job job = slot.trial->begin(new_stamp());
    if (experiment_.traces != RecordTraces::none) job.trace_file = scratch_trace(slot, job.trial).string();
    job.scratch_file = (slot.scratch->path() / "samples").string();
    job.plan = plan_of(job.trial);
    slot.makes_plan = !job.plan.empty() && !plans_.has(job.plan);
    if (slot.makes_plan) {
      job.new_plan = scratch_plan(slot).string();
      planning_[job.plan] = job.trial;
    }
    slot.worker->channel().send(job);
  }

  // Nothing if all trials that are left wait for plans. Of a fault of the planner each trial of the plan has a row.
  std::optional<OpenTrial> next_trial() {
    if (!again_.empty()) {
      OpenTrial trial = std::move(again_.back());
      again_.pop_back();
      return trial;
    }
    while (const auto number = next_number()) {
      OpenTrial trial(experiment_, blank_record(experiment_, *number));
      const std::string plan = plan_of(*number);
      if (!plans_.has(plan)) return trial;
      StoredPlan stored = plans_.read_call(plan);
      if (!stored.fault) return trial;
      trial.end_without_plan(std::move(stored));
      fs::remove(stored_trace(*number));  // of an earlier attempt
      end_trial(trial.take_record());
    }
    return std::nullopt;
  }

  // The first trial in order that need not wait for the plan that another one makes.
  std::optional<std::uint64_t> next_number() {
    const auto waits = [this](std::uint64_t trial) { return planning_.contains(plan_of(trial)); };
    if (const auto ready = std::find_if_not(waiting_.begin(), waiting_.end(), waits); ready != waiting_.end()) {
      const std::uint64_t trial = *ready;
      waiting_.erase(ready);
      return trial;
    }
    while (const auto trial = planned_.next()) {
      if (!waits(*trial)) return trial;
      waiting_.push_back(*trial);
    }
    return std::nullopt;
  }

  std::string plan_of(std::uint64_t trial) const {
    const TrialId id = trial_id(trial, combinations_.size());
    return plan_name(combinations_[id.combination], id.repetition);
  }
  static fs::path scratch_plan(const Slot& slot) { return slot.scratch->path() / "plan.csv"; }

  // For one trial.
  void allow_cpu(Slot& slot) const {
    slot.worker->process().allow_cpu(
        processor_time_s(experiment_.limits.trial_wall_time_s, static_cast<unsigned>(slots_.size())));
  }

  fs::path stored_trace(std::uint64_t trial) const { return trace_path(settings_.run_directory, trial); }
  fs::path scratch_trace(const Slot& slot, std::uint64_t trial) const {
    return slot.scratch->path() / stored_trace(trial).filename();
  }

  // True when a signal asks to stop.
  bool wait_for_workers(int stop) {
    std::vector<pollfd> watched = {{stop, POLLIN, 0}};
    for (const Slot& slot : slots_) {
      if (!slot.worker) continue;
      watched.push_back({slot.worker->process().ended().number(), POLLIN, 0});
      watched.push_back({slot.worker->log().read_end(), POLLIN, 0});
      watched.push_back({slot.listening ? slot.worker->channel().read_end() : -1, POLLIN, 0});
    }
    watchdog_.wait(watched);
    std::size_t next = 1;
    for (Slot& slot : slots_) {
      if (!slot.worker) continue;
      const bool ended = watched[next++].revents != 0;
      if (watched[next++].revents != 0) slot.worker->log().copy(log_);
      const bool said_something = watched[next++].revents != 0;
      if (said_something || ended) read_messages(slot, ended);
      if (ended && slot.worker) worker_ended(slot);
    }
    return (watched[0].revents & POLLIN) != 0;
  }

  // `all`: what an ended worker has left in the channel. A copy of the worker can keep the channel open.
  void read_messages(Slot& slot, bool all) {
    LineChannel& channel = slot.worker->channel();
    if (slot.listening && channel.has_input()) slot.listening = channel.fill();
    while (all && slot.listening && !channel.is_flooded() && channel.has_input()) slot.listening = channel.fill();
    try {
      const WorkerProcess* const sender = slot.worker.get();
      while (slot.worker.get() == sender)
        if (const auto message = channel.take())
          read_message(slot, *message);
        else
          break;
      if (slot.worker.get() == sender && channel.is_flooded()) throw UnbelievableMessage("longer than any may be");
    } catch (const nlohmann::json::exception&) {
      breach(slot, "that cannot be read");
    } catch (const UnbelievableMessage& message) {
      breach(slot, message.what());
    }
  }

  void breach(Slot& slot, const std::string& text) {
    FaultRecord fault = fault_at(slot.worker->last_call());
    fault.kind = fault_kind::abi_breach;
    // the plugin that runs now need not be the one
    fault.detail += fmt::format("a plugin of this trial wrote to the channel of its worker: a message {}", text);
    end_worker(slot, std::move(fault), slot.trials_begun > 1);
  }

  void read_message(Slot& slot, const nlohmann::json& message) {
    const auto type = message.at("type").get<std::string>();
    if (!slot.ready)
      read_start(slot, type, message);
    else if (!slot.trial)
      throw UnbelievableMessage("without a trial");
    else if (type == "error")
      worker_gave_up(slot, message);
    else
      read_trial_message(slot, type, message);
  }

  void read_start(Slot& slot, const std::string& type, const nlohmann::json& message) {
    if (type == "error") throw_error(message);
    if (type != "ready") throw UnbelievableMessage("before it was ready");
    if (message.at("digest").get<std::string>() != digest_)
      throw InputError(experiment_.file.string() + ": changed (it, a scenario or a plugin) while it was being run");
    slot.ready = true;
    failed_starts_ = 0;
  }

  [[noreturn]] static void throw_error(const nlohmann::json& message) {
    const auto text = message.at("text").get<std::string>();
    if (message.at("machine").get<bool>()) throw MachineError(text);
    throw InputError(text);
  }

  void read_trial_message(Slot& slot, const std::string& type, const nlohmann::json& message) {
    if (type == "planned") return store_plan(slot, message);
    const OpenTrial::State state = slot.trial->take(message);
    if (type == "began") {
      ++slot.trials_begun;
      kills_between_trials_ = 0;
    }
    if (type == "fault" && state != OpenTrial::State::running) end_process(slot);  // fatal
    settle(slot, state);
  }

  // Other trials may have it from now on, however this one ends.
  void store_plan(Slot& slot, const nlohmann::json& message) {
    slot.trial->check_sender(message);
    if (!std::exchange(slot.makes_plan, false)) throw UnbelievableMessage("of a plan that was not asked for");
    const std::string name = plan_of(slot.trial->record().id);
    const fs::path csv = plans_.csv_file(name);
    const auto make_folder = [&] { fs::create_directories(csv.parent_path()); };
    make_folder();
    if (!store_file(scratch_plan(slot), csv, make_folder))
      throw UnbelievableMessage("of a plan that is not in the scratch folder of the worker");
    StoredPlan plan = message.get<StoredPlan>();
    plan.fault.reset();
    plans_.write_call(name, std::move(plan));
    planning_.erase(name);
  }

  // A trial that makes the plan of others has ended.
  void end_planning(const TrialRecord& record) {
    const std::string name = plan_of(record.id);
    const auto own = planning_.find(name);
    if (own == planning_.end() || own->second != record.id) return;
    planning_.erase(own);
    if (const FaultRecord* const fault = planner_fault(record))
      plans_.write_call(name, {{}, record.timing, *fault, record.task});
  }

  // The fault by which the planner gives no first plan; nullptr if there is none.
  const FaultRecord* planner_fault(const TrialRecord& record) const {
    if (record.outcome != trial_outcome::fault || record.faults.empty()) return nullptr;
    const FaultRecord& fault = record.faults.back();
    const Combination& combination = combinations_[trial_id(record.id, combinations_.size()).combination];
    const PluginUse& planner = experiment_.global_planners[static_cast<std::size_t>(combination.global_planner)];
    const bool plans = fault.function == "create" || fault.function == "start" || fault.function == "plan";
    return plans && fault.plugin == planner.info.id ? &fault : nullptr;
  }

  void settle(Slot& slot, OpenTrial::State state) {
    if (state == OpenTrial::State::done) finish(slot);
    if (state == OpenTrial::State::ended_by_fault) run_again(slot);
  }

  // The worker cannot write a file, or the like. The machine has failed if it fails in a fresh worker, and here too.
  void worker_gave_up(Slot& slot, const nlohmann::json& message) {
    slot.trial->check_sender(message);
    const auto text = message.at("text").get<std::string>();
    if (slot.trial->worker_failed && message.at("machine").get<bool>() &&
        machine_fails(whole_number<int>(message.at("number"))))
      throw MachineError(text);
    FaultRecord fault = fault_at(slot.worker->last_call());
    fault.kind = fault_kind::worker_error;
    fault.detail += text;
    const bool again = !std::exchange(slot.trial->worker_failed, true);
    end_worker(slot, std::move(fault), again);
  }

  bool machine_fails(int error_number) const {
    if (error_number == ENOSPC || error_number == EDQUOT || error_number == EIO) return true;
    if (error_number == EFBIG && files_are_limited()) return true;
    return !can_write_in(settings_.run_directory);
  }

  void finish(Slot& slot) {
    if (!store_trace_of(slot)) {
      FaultRecord fault = fault_at(slot.worker->last_call());
      fault.kind = fault_kind::worker_error;
      fault.detail += "the trace was deleted or replaced in the scratch folder of the worker";
      return end_worker(slot, std::move(fault), slot.trials_begun > 1);
    }
    TrialRecord record = slot.trial->take_record();
    record.wall_time_s = static_cast<double>(monotonic_ns() - slot.trial->started_ns) / static_cast<double>(second_ns);
    slot.trial.reset();
    slot.last_trial = record.id;
    end_planning(record);
    end_trial(std::move(record));
  }

  void end_trial(TrialRecord&& record) {
    for (FaultRecord& fault : record.faults) fault.rerun = rerun_command(experiment_, record.id, settings_.trial_count);
    --open_trials_;
    sinks_.on_trial(std::move(record));
  }

  // Before the row: no row lacks its trace, whenever the power fails. False if the trial has not left the trace that it
  // should have; one that ended in a fault need not have any.
  bool store_trace_of(const Slot& slot) {
    if (experiment_.traces == RecordTraces::none) return true;
    const TrialRecord& record = slot.trial->record();
    const fs::path stored = stored_trace(record.id);
    const auto make_folder = [&] {
      if (!fs::create_directory(stored.parent_path())) return;
      const std::string text = stored.parent_path().string() + ": was deleted, with the traces of earlier trials";
      sinks_.on_warning(text);
      note(text);
    };
    make_folder();
    if (experiment_.traces == RecordTraces::failed && record.outcome == trial_outcome::succeeded) {
      fs::remove(stored);  // of an earlier attempt
      return true;
    }
    return store_file(scratch_trace(slot, record.id), stored, make_folder) || record.outcome == trial_outcome::fault;
  }

  void run_again(Slot& slot) {
    again_.push_back(std::move(*slot.trial));
    slot.trial.reset();
  }

  // Ends a worker whose call, trial or start takes too long.
  void check_time(Slot& slot) {
    if (slot.ready && !slot.trial) return;
    const auto longest_ns =
        static_cast<std::int64_t>(experiment_.limits.trial_wall_time_s * static_cast<double>(second_ns));
    const NotedCall call = slot.worker->last_call();
    FaultRecord fault = fault_at(call);
    fault.kind = fault_kind::hang;
    if (is_late(slot, slot.work, longest_ns)) {
      fault.detail += fmt::format("the {} took longer than trial_wall_time_s = {} s",
                                  slot.trial ? "trial" : "start of a worker", experiment_.limits.trial_wall_time_s);
      return end_worker(slot, std::move(fault), false);
    }
    const std::int64_t limit_ns = call.limit_ns > 0 ? std::min(call.limit_ns, longest_ns) : longest_ns;
    if (!is_overdue(slot, call, limit_ns)) return;
    fault.detail =
        fmt::format("did not return within {:.1f} s", static_cast<double>(monotonic_ns() - call.start_ns) * 1e-9);
    end_worker(slot, std::move(fault), false);
  }

  bool is_late(Slot& slot, const Watch& watch, std::int64_t limit_ns) const {
    return slot.worker->process().is_late(watchdog_.elapsed_ns(watch.start_ns), watch.waited_before_ns, limit_ns);
  }

  bool is_overdue(Slot& slot, const NotedCall& call, std::int64_t limit_ns) const {
    // most calls are short, and cost no look at what the worker has waited
    if (!watchdog_.is_overdue(call, slot.worker_started_ns, std::min(long_call_ns, limit_ns))) return false;
    if (slot.long_call.start_ns != call.start_ns)
      slot.long_call = {call.start_ns, slot.worker->process().waited_for_processor_ns()};
    return is_late(slot, slot.long_call, limit_ns);
  }

  void look_at_memory() {
    next_look_at_memory_ns_ = monotonic_ns() + second_ns / 10;
    for (Slot& slot : slots_)
      if (slot.worker) check_memory(slot);
  }

  // What the kernel's limit on data does not count: shared memory, or all where that limit does not fit the plugins.
  void check_memory(Slot& slot) {
    const MemoryInUse used = slot.worker->process().memory_in_use();
    const double counted_mb = counts_resident_memory_ ? used.resident_mb : used.shared_mb;
    if (counted_mb <= static_cast<double>(experiment_.limits.memory_mb)) return;
    FaultRecord fault = fault_at(slot.worker->last_call());
    fault.kind = fault_kind::out_of_memory;
    fault.detail +=
        fmt::format("{:.0f} MB {}in use, more than memory_mb = {}; when this is noticed depends on timing", counted_mb,
                    counts_resident_memory_ ? "" : "of shared memory ", experiment_.limits.memory_mb);
    end_worker(slot, std::move(fault), slot.trials_begun > 1);
  }

  // The worker ended by itself, or was killed from outside.
  void worker_ended(Slot& slot) {
    FaultRecord fault = fault_of_end(*slot.worker, experiment_.limits.memory_mb);
    const bool killed = slot.worker->process().wait().killed_from_outside;
    const bool has_begun = slot.trial && slot.trial->has_begun();
    if (killed && !has_begun && ++kills_between_trials_ < most_kills_between_trials) return drop_worker(slot);
    const bool again = killed && has_begun ? ++slot.trial->killed < most_kills : slot.trials_begun > 1;
    end_worker(slot, std::move(fault), again);
  }

  // Kills the worker, and processes that its plugins have started.
  void end_process(Slot& slot) {
    slot.worker->process().kill();
    slot.worker->process().wait();
    slot.worker->log().copy_rest(log_);
    slot.worker.reset();
    std::vector<pid_t> workers;
    for (const Slot& other : slots_)
      if (other.worker) workers.push_back(other.worker->process().number());
    kill_orphans(workers);
  }

  // Between two trials.
  void drop_worker(Slot& slot) {
    end_process(slot);
    if (slot.trial) run_again(slot);
  }

  // Kills the worker. Its trial is run again from its beginning, or ends by the fault.
  void end_worker(Slot& slot, FaultRecord fault, bool again) {
    if (!slot.trial || !slot.trial->has_begun()) {
      drop_worker(slot);
      return blame_last_trial(slot, std::move(fault));
    }
    end_process(slot);
    if (again) {
      // of an instance of an earlier trial
      if (fault.function == "destroy" && slot.last_trial) blame_last_trial(slot, fault);
      note(fmt::format("trial {} is run again: {}", slot.trial->record().id, text_of(fault)));
      slot.trial->restart();
      return run_again(slot);
    }
    settle(slot, slot.trial->end_attempt(std::move(fault)));
  }

  // The worker ended between two trials.
  void blame_last_trial(const Slot& slot, FaultRecord fault) {
    if (slot.last_trial) {
      fault.rerun = rerun_command(experiment_, *slot.last_trial, settings_.trial_count);
      return sinks_.on_late_fault(*slot.last_trial, fault);
    }
    if ((fault.kind == fault_kind::hang && !slot.ready) || ++failed_starts_ >= start_attempts)
      throw std::runtime_error(fmt::format("worker processes fail as they start: {}; see {}", text_of(fault),
                                           (settings_.run_directory / "log.txt").string()));
  }

  // Lets the workers call destroy() and deinit() of the plugins.
  void shut_down_workers() {
    for (Slot& slot : slots_)
      if (slot.worker) slot.worker->channel().close_write_end();
    const std::int64_t until_ns = monotonic_ns() + shutdown_limit_ns;
    for (Slot& slot : slots_) {
      if (!slot.worker) continue;
      const bool ended =
          watchdog_.wait(slot.worker->process().ended().number(), [&] { return monotonic_ns() >= until_ns; });
      FaultRecord fault =
          ended ? fault_of_end(*slot.worker, experiment_.limits.memory_mb) : fault_at(slot.worker->last_call());
      if (!ended) {
        fault.kind = fault_kind::hang;
        fault.detail += fmt::format("did not return within {} s", shutdown_limit_ns / second_ns);
      }
      slot.worker->log().copy_rest(log_);
      const bool is_fault = !ended || slot.worker->last_call().inside || slot.worker->process().wait().signal != 0;
      if (is_fault && slot.last_trial && !slot.worker->process().wait().killed_from_outside)
        blame_last_trial(slot, std::move(fault));
    }
  }

  // A line in log.txt.
  void note(const std::string& text) const { log_.write("[info] dmrp-host: " + text + "\n"); }

  const Experiment& experiment_;
  const SupervisorSettings& settings_;
  const SupervisorSinks& sinks_;
  const std::string digest_;
  const std::vector<Combination> combinations_;
  const StoredPlans plans_;
  const bool watches_memory_ = experiment_.limits.memory_mb > 0 && !MemoryGroup::available();
  const bool counts_resident_memory_ = counts_resident_memory(experiment_);
  std::int64_t next_look_at_memory_ns_ = 0;
  const Descriptor log_;
  Watchdog watchdog_;
  PlannedTrials planned_;
  std::vector<OpenTrial> again_;                   // trials that have begun and lost their worker
  std::vector<std::uint64_t> waiting_;             // in order, for the plan that another trial makes
  std::map<std::string, std::uint64_t> planning_;  // by plan: the trial that makes it
  std::vector<Slot> slots_;
  std::uint64_t open_trials_;
  int failed_starts_ = 0;
  int kills_between_trials_ = 0;
};

}  // namespace

RunEnding supervise(const Experiment& experiment, PlannedTrials trials, const SupervisorSettings& settings,
                    const SupervisorSinks& sinks) {
  return Supervisor(experiment, std::move(trials), settings, sinks).run();
}

}  // namespace dmrp::host
