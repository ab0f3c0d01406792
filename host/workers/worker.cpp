// SPDX-License-Identifier: MIT
#include "host/workers/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "core/bytes/file.hpp"
#include "core/trace/trace_encoder.hpp"
#include "host/errors/machine_error.hpp"
#include "host/experiment/identity.hpp"
#include "host/guests/guest_process.hpp"
#include "host/plans/plan_file.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/one_processor.hpp"
#include "host/process/orphans.hpp"
#include "host/trial/ask_metric.hpp"
#include "host/trial/kept_trace.hpp"
#include "host/trial/run_trial.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/scratch_folder.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

namespace {

constexpr int most_kills_of_guests = 4;  // from outside, in one trial: then a plugin of it is to blame

FaultRecord record_of(const PluginFault& fault) {
  FaultRecord record;
  record.kind = fault.kind();
  record.plugin = fault.plugin();
  record.function = fault.function();
  record.step = fault.step();
  record.robot = fault.robot();
  record.detail = fault.what();
  if (const auto* const end = dynamic_cast<const GuestEnd*>(&fault)) record.signal = end->signal();
  return record;
}

nlohmann::json typed(const char* type, nlohmann::json message) {
  message["type"] = type;
  return message;
}

// What the worker says.
class Sender {
 public:
  explicit Sender(LineChannel& channel) : channel_(channel) {}

  void send(const nlohmann::json& message) const {
    if (!channel_.send(message)) _exit(1);
  }

 private:
  LineChannel& channel_;
};

void write_text(const std::string& file, const std::string& text) {
  const core::File out = core::create_file(file);
  if (std::fwrite(text.data(), 1, text.size(), out.get()) != text.size() || std::fflush(out.get()) != 0)
    throw std::system_error(errno, std::generic_category(), file);
}

GuestLimits guest_limits(const Experiment& experiment, const WorkerTask& task) {
  GuestLimits limits;
  limits.scratch = task.scratch / "plugins";
  limits.memory_mb = experiment.limits.memory_mb;
  limits.trial_wall_time_s = experiment.limits.trial_wall_time_s;
  limits.sharers = task.jobs;
  return limits;
}

// A file as it was when the worker compared its content.
struct FileStamp {
  dev_t device;
  ino_t file;
  off_t bytes;
  std::int64_t changed_ns;

  bool operator==(const FileStamp&) const = default;
};

FileStamp stamp_of(const std::string& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) throw std::system_error(errno, std::generic_category(), file);
  return {found.st_dev, found.st_ino, found.st_size,
          std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec};
}

class Worker {
 public:
  Worker(const Experiment& experiment, const WorkerTask& task, const ForkServer& fork_server, LineChannel& channel,
         Sender& sender)
      : experiment_(experiment),
        plans_(run_directory_of(task.scratch)),
        combinations_(combinations(experiment)),
        channel_(channel),
        sender_(sender),
        fork_server_(fork_server),
        limits_(guest_limits(experiment, task)),
        processor_(task.processor),
        guests_(experiment.libraries,
                [this](const LibraryUse& library, std::uint32_t kind) { return start_guest(library, kind); }) {}

  void serve() {
    for (const LibraryUse& library : experiment_.libraries) check_unchanged(library);
    for (const PluginUse& planner : experiment_.global_planners)
      if (planner.plans.is_given()) check_unchanged(planner.plans.all());
    sender_.send({{"type", "ready"}, {"digest", loaded_digest(experiment_)}});
    while (const auto message = channel_.receive()) {
      const auto job = message->get<Job>();
      sender_.send({{"type", "began"}});
      run(job);
    }
    attempt_late([&] { guests_.shut_down(); });
  }

 private:
  // A trial and what is known of it.
  struct Open {
    const Job& job;
    const Combination& combination;
    const VariantWorld& world;
    std::uint64_t seed;
    std::optional<StoredPlan> plan{};  // as stored, or as an attempt has made it
    TrialDone done{};
    int killed = 0;
  };

  // Rows of two versions of a library, or of a file of plans, would stand in one table.
  void check_unchanged(const LibraryUse& library) {
    VisiblePaths files(library.objects.begin(), library.objects.end());
    files.push_back(library.file);
    check_unchanged(files);
  }
  void check_unchanged(const VisiblePaths& files) {
    for (const std::string file : files)
      if (stamps_.try_emplace(file, stamp_of(file)).first->second != stamp_of(file))
        throw std::runtime_error(file + ": changed while it was being run");
  }

  // A planner may have threads, and is asked seldom.
  std::unique_ptr<Guest> start_guest(const LibraryUse& library, std::uint32_t kind) {
    check_unchanged(library);
    const auto started = [&](pid_t process) {
      if (kind != DMRP_KIND_GLOBAL_PLANNER) processor_.add(process);
    };
    return std::make_unique<GuestProcess>(fork_server_, library, limits_, GuestTask::load, spool_, started,
                                          [this] { return look(); });
  }

  // While guests are asked. Why the trial may not go on; "" if it may.
  std::string look() {
    watchdog_.look();
    if (!is_late(watchdog_.elapsed_ns(trial_started_ns_), waited_ns() - waited_before_ns_,
                 nanoseconds(limits_.trial_wall_time_s)))
      return "";
    return fmt::format("the trial took longer than trial_wall_time_s = {} s", experiment_.limits.trial_wall_time_s);
  }

  std::int64_t waited_ns() const {
    std::int64_t waited_ns = waited_for_processor_ns(getpid());
    guests_.for_each([&](const Guest& guest) {
      waited_ns += static_cast<const GuestProcess&>(guest).process().waited_for_processor_ns();
    });
    return waited_ns;
  }

  const VariantWorld& variant(std::uint32_t scenario) {
    auto& made = variants_[scenario];
    if (!made) made = std::make_unique<VariantWorld>(experiment_, experiment_.scenarios[scenario]);
    return *made;
  }

  void run(const Job& job) {
    const TrialId id = trial_id(job.trial, combinations_.size());
    const Combination& combination = combinations_[id.combination];
    const VariantWorld& shared = variant(combination.scenario);
    std::unique_ptr<const VariantWorld> own;
    if (const ScenarioVariant& scenario = experiment_.scenarios[combination.scenario]; is_drawn(scenario))
      own = std::make_unique<VariantWorld>(
          experiment_, scenario, shared,
          task_seed(experiment_, scenario.scenario.name, scenario.wishes, id.repetition));
    std::filesystem::create_directories(limits_.scratch);  // a plugin of an earlier trial can have deleted it
    Open trial = {job, combination, own ? *own : shared, trial_seed(experiment_, job.trial)};
    trial.done.task = task_hash(trial.world.scenario);
    if (!job.plan.empty() && job.new_plan.empty()) trial.plan = plans_.read(job.plan);
    if (!job.new_plan.empty() && planner_of(trial).plans.is_given()) store_plan_of_file(trial, id.repetition);
    if (trial.plan) trial.done.timing = trial.plan->timing;
    while (!attempt(trial)) {
    }
    sender_.send(typed("done", trial.done));
    if (own) attempt_late([&] { guests_.clear(); });  // instances may keep pointers into their world
  }

  // False: the trial is run again in fresh guests.
  bool attempt(Open& trial) {
    KeptTrace kept(trial.job.trace_file, trial.job.scratch_file, most_trace_bytes_in_memory());
    core::TraceEncoder trace(
        trial.world.view.world(),
        [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { kept.write(t_ns, record); }, kept.foxglove());
    trial_started_ns_ = monotonic_ns();
    waited_before_ns_ = waited_ns();
    try {
      guests_.begin_trial({trial.job.trial, trial.world.simulation.step_ns});
      const TrialEnding ending =
          run_trial({experiment_, trial.combination, trial.world, trial.seed, first_plan_of(trial)}, guests_, trace);
      trial.done.outcome = ending.succeeded ? trial_outcome::succeeded : trial_outcome::failed;
      trial.done.sim_time_s = ending.sim_time_s;
    } catch (const GuestEnd& end) {
      if (is_run_again(trial, end)) return false;
      end_by(trial, end, kept);
      return true;
    } catch (const PluginFault& fault) {
      end_by(trial, fault, kept);
      return true;
    }
    measure_all(kept, trial);
    add_timing(trial);
    return true;
  }

  // An earlier trial can have left its mark on the guest, or somebody outside has killed it.
  bool is_run_again(Open& trial, const GuestEnd& end) {
    const bool again =
        end.killed() ? ++trial.killed < most_kills_of_guests : end.depends_on_past() && guests_.have_served_trials();
    if (!again) return false;
    std::fprintf(stderr, "[info] dmrp-host: trial %llu is run again: %s: %s\n",
                 static_cast<unsigned long long>(trial.job.trial), end.kind(), end.text().c_str());
    end_guests();
    return true;
  }

  void end_guests() {
    guests_.end_all();
    kill_strays();
  }

  // Processes that plugins have left behind.
  void kill_strays() const {
    std::vector<pid_t> own = {fork_server_.number()};
    guests_.for_each(
        [&](const Guest& guest) { own.push_back(static_cast<const GuestProcess&>(guest).process().number()); });
    kill_orphans(own);
  }

  void end_by(Open& trial, const PluginFault& fault, KeptTrace& kept) {
    trial.done.outcome = outcome_of(fault.kind());
    kept.finish();
    add_timing(trial);
    sender_.send(typed("fault", record_of(fault)));
    if (fault.fatal())
      end_guests();
    else
      attempt_late([&] { guests_.clear(); });
  }

  // A guest that ends by this question has done its work.
  void add_timing(Open& trial) {
    try {
      for (TimingReason& reason : guests_.timing()) trial.done.timing.push_back(std::move(reason));
    } catch (const PluginFault&) {
      end_guests();
    }
  }

  // What the plugins do after a trial is over; a fault is told of the last one.
  template <class Body>
  void attempt_late(Body&& body) {
    try {
      body();
    } catch (const PluginFault& fault) {
      sender_.send(typed("late_fault", record_of(fault)));
      end_guests();
    }
  }

  // As stored, or to be stored. A trial is as repeatable as the plan that it gets.
  FirstPlan first_plan_of(Open& trial) {
    if (trial.job.plan.empty()) return {};
    const std::string& planner = planner_of(trial).info.id;
    return {trial.plan ? &trial.plan->answer : nullptr, [&, planner](const PlannerAnswer& made) {
              if (!trial.plan) return store(trial, planner, made);
              trial.done.timing.clear();
              if (!same_plan(made, trial.plan->answer))
                trial.done.timing.push_back({planner, "its first plan is another than the run has stored"});
            }};
  }

  // Of a trial that has a planner.
  const PluginUse& planner_of(const Open& trial) const {
    return experiment_.global_planners[static_cast<std::size_t>(trial.combination.global_planner)];
  }

  void store(Open& trial, const std::string& planner, const PlannerAnswer& made) {
    std::vector<TimingReason> timing = guests_.timing();
    std::erase_if(timing, [&](const TimingReason& reason) { return reason.plugin != planner; });
    store(trial, made, std::move(timing));
  }

  void store_plan_of_file(Open& trial, std::uint32_t repetition) {
    PlansOfFiles& plans =
        plans_of_files_.try_emplace(trial.combination.global_planner, planner_of(trial).plans).first->second;
    if (const auto file = planner_of(trial).plans.of(repetition); !file.empty()) check_unchanged(VisiblePaths{file});
    StagedProblem problem;
    stage_first_problem(experiment_, trial.world, problem);
    store(trial, plans.answer(repetition, trial.done.task, problem.c), {});
  }

  void store(Open& trial, const PlannerAnswer& made, std::vector<TimingReason> timing) {
    write_text(trial.job.new_plan, plan_csv(made.paths));
    trial.plan = StoredPlan{made, std::move(timing)};
    sender_.send(typed("planned", *trial.plan));
  }

  static void finish(KeptTrace& kept, std::vector<MetricEvent> events) {
    std::stable_sort(events.begin(), events.end(),
                     [](const MetricEvent& a, const MetricEvent& b) { return a.from_ns < b.from_ns; });
    if (core::FoxgloveChannels* const foxglove = kept.foxglove())
      for (const MetricEvent& event : events)
        foxglove->metric_event({event.metric, event.from_ns, event.to_ns, event.robots, event.text});
    kept.finish();
  }

  void measure_all(KeptTrace& kept, const Open& trial) {
    spool_ = kept.spool_descriptor();
    if (spool_ >= 0) end_guests_of_metrics();  // those that are started now have the spool
    std::vector<MetricEvent> events;
    for (std::uint32_t i = 0; i < experiment_.metrics.size(); ++i) measure(kept, trial, i, events);
    if (spool_ >= 0) end_guests_of_metrics();
    spool_ = -1;
    finish(kept, std::move(events));
  }

  void end_guests_of_metrics() {
    for (const PluginUse& metric : experiment_.metrics) guests_.end(metric.library);
  }

  void measure(KeptTrace& kept, const Open& trial, std::uint32_t index, std::vector<MetricEvent>& events) {
    const std::uint32_t library = experiment_.metrics[index].library;
    const auto robots = static_cast<std::uint32_t>(trial.world.scenario.robots.size());
    const FinishedTrial finished = {kept.in_memory(), &trial.world, robots, trial.seed, trial.done.sim_time_s};
    for (bool fresh = false;; fresh = true) {
      try {
        MetricResult result =
            ask_metric(guests_, experiment_.metrics[index], index, finished, experiment_.limits.step_time_s);
        send_in_pieces(result, [&](const MetricResult& piece) { sender_.send(typed("metric", piece)); });
        std::move(result.events.begin(), result.events.end(), std::back_inserter(events));
        return;
      } catch (const PluginFault& fault) {
        const auto* const end = dynamic_cast<const GuestEnd*>(&fault);
        if (fault.fatal()) {
          guests_.end(library);
          kill_strays();
        }
        if (end && end->depends_on_past() && !fresh) continue;  // another trial or metric can have left its mark
        sender_.send(typed("fault", record_of(fault)));
        return;
      }
    }
  }

  // A trace that does not fit into the memory of a guest goes to a spool.
  static std::size_t most_trace_bytes_in_memory() {
    return std::min(core::TraceRecords::small_trace_bytes, GuestMemory::part_bytes() / 2);
  }

  const Experiment& experiment_;
  const StoredPlans plans_;
  std::vector<Combination> combinations_;
  LineChannel& channel_;
  Sender& sender_;
  const ForkServer& fork_server_;
  const GuestLimits limits_;
  int spool_ = -1;                                                   // of the trial that is measured
  std::map<std::uint32_t, std::unique_ptr<VariantWorld>> variants_;  // guests keep copies of them
  std::map<std::int32_t, PlansOfFiles> plans_of_files_;              // by planner
  std::map<std::string, FileStamp> stamps_;                          // of libraries and what they need, and of plans
  OneProcessor processor_;
  Watchdog watchdog_;
  std::int64_t trial_started_ns_ = 0;
  std::int64_t waited_before_ns_ = 0;  // for a processor, by this process and its guests
  Guests guests_;
};

// As the supervisor has probed them.
PluginSource source_of(const nlohmann::json& setup) {
  return [setup](const std::filesystem::path& file, const VisiblePaths&) -> Probe {
    const auto found = setup.at("libraries").find(file.string());
    if (found == setup.at("libraries").end()) return {{}, {}, {}, "the supervisor has left it out"};
    return {found->at("plugins").get<std::vector<PluginInfo>>(), {}, found->at("objects"), "", found->at("runtime")};
  };
}

void send_error(Sender& sender, const std::string& text, const std::exception& error) {
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  sender.send({{"type", "error"},
               {"text", text},
               {"machine", is_machine_failure(error)},
               {"number", system ? system->code().value() : 0}});
}

}  // namespace

int run_worker(const WorkerTask& task) {
  for (const int descriptor : {task.read_end, task.write_end}) fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  LineChannel channel{Descriptor(task.read_end), Descriptor(task.write_end)};
  Sender sender(channel);
  try {
    adopt_orphans();
    const ForkServer fork_server;  // before anything is known
    const auto setup = channel.receive();
    if (!setup) return 1;
    Experiment experiment = load_checked_experiment(task.experiment, task.trials, source_of(*setup));
    experiment.traces = setup->at("traces").get<RecordTraces>();
    for (const auto& [entry, routes] : setup->at("routes").items()) {
      const auto found = std::make_shared<const core::FlowRoutes>(routes_in(routes));
      for (ScenarioVariant& variant : experiment.scenarios)
        if (std::to_string(variant.entry) == entry) variant.routes = found;
    }
    Worker(experiment, task, fork_server, channel, sender).serve();
    return 0;
  } catch (const std::bad_alloc&) {
    return out_of_memory_exit;
  } catch (const PluginFault& fault) {
    send_error(sender, fault.text(), fault);
  } catch (const std::exception& error) {
    send_error(sender, error_text(error), error);
  }
  return 1;
}

}  // namespace dmrp::host
