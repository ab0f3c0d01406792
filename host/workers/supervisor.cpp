// SPDX-License-Identifier: MIT
#include "host/workers/supervisor.hpp"

#include <fmt/format.h>
#include <sched.h>

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
#include "host/files/sha256.hpp"
#include "host/files/try_to_write.hpp"
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
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr int start_attempts = 3;
constexpr int most_kills = 4;  // of one trial: then it is to blame, not somebody outside
constexpr int most_kills_between_trials = 20;
constexpr std::int64_t worker_limit_ns = 30 * second_ns;    // for what a worker does itself, beyond a trial's limit
constexpr std::int64_t shutdown_limit_ns = 10 * second_ns;  // for destroy() and deinit() of plugins

// What a worker does, and may take so long.
struct Watch {
  std::int64_t start_ns = 0;
  std::int64_t waited_before_ns = 0;  // by the worker, before the start
};

struct Slot {
  std::unique_ptr<ScratchFolder> scratch;  // outlives the worker
  std::unique_ptr<WorkerProcess> worker;
  Watch work;  // the start of the worker, or its trial
  bool ready = false;
  bool listening = true;  // the worker's end of the channel is open
  int trials_begun = 0;   // by this worker
  std::optional<OpenTrial> trial;
  std::optional<std::uint64_t> last_trial;  // that this worker finished
};

// "crash in org.example.controller step(): Segmentation fault"
std::string text_of(const FaultRecord& fault) {
  if (fault.plugin.empty()) return fault.kind + ": " + fault.detail;
  return fmt::format("{} in {} {}(): {}", fault.kind, fault.plugin, fault.function, fault.detail);
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
      for (Slot& slot : slots_)
        if (slot.worker) check_time(slot);
      if (!sinks_.goes_on()) return RunEnding::interrupted;
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
      slot.worker = std::make_unique<WorkerProcess>(experiment_, slot.scratch->path(), place_of(slot));
      slot.work = {monotonic_ns(), 0};
    }
    if (!slot.ready) return;
    slot.trial = next_trial();
    if (!slot.trial) return;
    slot.trial->started_ns = monotonic_ns();
    slot.work = {slot.trial->started_ns, slot.worker->process().waited_for_processor_ns()};
    // a worker that has died is noticed by its end
    slot.scratch->restore();
    Job job = slot.trial->begin();
    if (experiment_.traces != RecordTraces::none) job.trace_file = scratch_trace(slot, job.trial).string();
    job.scratch_file = (slot.scratch->path() / "samples").string();
    job.plan = plan_of(job.trial);
    if (!job.plan.empty() && !plans_.has(job.plan)) {
      job.new_plan = scratch_plan(slot).string();
      planning_[job.plan] = job.trial;
    }
    slot.worker->channel().send(job);
  }

  // The kernel has started this process where there was little to do.
  JobPlace place_of(const Slot& slot) const {
    return {static_cast<unsigned>(slots_.size()), first_processor_ + static_cast<unsigned>(&slot - slots_.data())};
  }

  // Nothing if all trials that are left wait for plans. Of a fault of the planner each trial of the plan has a row.
  std::optional<OpenTrial> next_trial() {
    if (!again_.empty()) {
      OpenTrial trial = std::move(again_.back());
      again_.pop_back();
      return trial;
    }
    while (const auto number = next_number()) {
      OpenTrial trial(row_of(experiment_, *number));
      const std::string plan = plan_of(*number);
      if (!plans_.has(plan)) return trial;
      StoredPlan stored = plans_.read_call(plan);
      if (!stored.fault) {
        plans_.check_paths(plan, stored);
        return trial;
      }
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
    while (all && slot.listening && channel.has_input()) slot.listening = channel.fill();
    try {
      const WorkerProcess* const sender = slot.worker.get();
      while (slot.worker.get() == sender)
        if (const auto message = channel.take())
          read_message(slot, *message);
        else
          break;
    } catch (const nlohmann::json::exception& error) {  // somebody outside writes to the channel
      end_worker(slot, worker_error(fmt::format("its worker sent a message that cannot be read: {}", error.what())),
                 slot.trials_begun > 1);
    }
  }

  // Of a process, not of a plugin.
  static FaultRecord worker_error(std::string detail) {
    FaultRecord fault;
    fault.kind = fault_kind::worker_error;
    fault.detail = std::move(detail);
    return fault;
  }

  void read_message(Slot& slot, const nlohmann::json& message) {
    const auto type = message.at("type").get<std::string>();
    if (!slot.ready)
      read_start(slot, type, message);
    else if (type == "late_fault")
      blame_last_trial(slot, message.get<FaultRecord>());
    else if (type == "error" && slot.trial)
      worker_gave_up(slot, message);
    else if (slot.trial)
      read_trial_message(slot, type, message);
  }

  void read_start(Slot& slot, const std::string& type, const nlohmann::json& message) {
    if (type == "error") throw_error(message);
    if (message.at("digest").get<std::string>() != digest_)
      throw InputError(experiment_.file.string() + ": changed (it, or a file that it names) while it was being run");
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
    const bool is_over = slot.trial->take(message);
    if (type == "began") {
      ++slot.trials_begun;
      kills_between_trials_ = 0;
    }
    if (is_over) finish(slot);
  }

  // Other trials may have it from now on, however this one ends.
  void store_plan(Slot& slot, const nlohmann::json& message) {
    const std::string name = plan_of(slot.trial->record().id);
    const fs::path csv = plans_.csv_file(name);
    const auto make_folder = [&] { fs::create_directories(csv.parent_path()); };
    make_folder();
    if (!store_file(scratch_plan(slot), csv, make_folder))
      return end_worker(slot, worker_error("the plan was deleted or replaced in the scratch folder of the worker"),
                        slot.trials_begun > 1);
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
    const bool ended = record.outcome == trial_outcome::fault || record.outcome == trial_outcome::unsupported;
    if (!ended || record.faults.empty()) return nullptr;
    const FaultRecord& fault = record.faults.back();
    const Combination& combination = combinations_[trial_id(record.id, combinations_.size()).combination];
    const PluginUse& planner = experiment_.global_planners[static_cast<std::size_t>(combination.global_planner)];
    const bool plans = fault.function == "create" || fault.function == "start" || fault.function == "plan";
    return plans && fault.plugin == planner.info.id ? &fault : nullptr;
  }

  // The worker cannot write a file, or the like. The machine has failed if it fails in a fresh worker, and here too.
  void worker_gave_up(Slot& slot, const nlohmann::json& message) {
    const auto text = message.at("text").get<std::string>();
    if (slot.trial->worker_failed && message.at("machine").get<bool>() &&
        machine_fails(message.at("number").get<int>()))
      throw MachineError(text);
    FaultRecord fault = worker_error(text);
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
      return end_worker(slot, worker_error("the trace was deleted or replaced in the scratch folder of the worker"),
                        slot.trials_begun > 1);
    }
    TrialRecord record = slot.trial->take_record();
    add_digests(record);
    record.wall_time_s = static_cast<double>(monotonic_ns() - slot.trial->started_ns) / static_cast<double>(second_ns);
    slot.trial.reset();
    slot.last_trial = record.id;
    end_planning(record);
    end_trial(std::move(record));
  }

  // So that readers know whether plan and trace are those of the row.
  void add_digests(TrialRecord& record) const {
    if (const std::string plan = plan_of(record.id); !plan.empty() && plans_.has(plan))
      record.plan_sha256 = plans_.read_call(plan).paths_sha256;
    if (const fs::path trace = stored_trace(record.id); experiment_.traces != RecordTraces::none && fs::exists(trace))
      record.trace_sha256 = sha256_of_file(trace);
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
    if (!keeps_trace(experiment_.traces, record)) {
      fs::remove(stored);  // of an earlier attempt
      return true;
    }
    return store_file(scratch_trace(slot, record.id), stored, make_folder) || record.outcome == trial_outcome::fault;
  }

  void run_again(Slot& slot) {
    again_.push_back(std::move(*slot.trial));
    slot.trial.reset();
  }

  // Ends a worker whose trial or start takes too long, although it watches over its guests itself.
  void check_time(Slot& slot) {
    if (slot.ready && !slot.trial) return;
    const auto longest_ns =
        static_cast<std::int64_t>(experiment_.limits.trial_wall_time_s * static_cast<double>(second_ns));
    if (!slot.worker->process().is_late(watchdog_.elapsed_ns(slot.work.start_ns), slot.work.waited_before_ns,
                                        2 * longest_ns + worker_limit_ns))
      return;
    FaultRecord fault =
        worker_error(fmt::format("the {} took longer than trial_wall_time_s = {} s",
                                 slot.trial ? "trial" : "start of a worker", experiment_.limits.trial_wall_time_s));
    fault.kind = fault_kind::hang;
    end_worker(slot, std::move(fault), false);
  }

  // The worker ended by itself, or was killed from outside.
  void worker_ended(Slot& slot) {
    FaultRecord fault = worker_error("the worker " + slot.worker->process().wait().explain(0));
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
      note(fmt::format("trial {} is run again: {}", slot.trial->record().id, text_of(fault)));
      slot.trial->restart();
      return run_again(slot);
    }
    slot.trial->end_by(std::move(fault));
    finish(slot);
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
      slot.worker->log().copy_rest(log_);
      if (ended)
        read_messages(slot, true);
      else if (slot.last_trial)
        blame_last_trial(
            slot, worker_error(fmt::format("its worker did not end within {} s", shutdown_limit_ns / second_ns)));
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
  const Descriptor log_;
  const unsigned first_processor_ = static_cast<unsigned>(std::max(0, sched_getcpu()));
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
