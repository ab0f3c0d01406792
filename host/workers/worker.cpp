// SPDX-License-Identifier: MIT
#include "host/workers/worker.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "core/bytes/file.hpp"
#include "core/trace/trace_encoder.hpp"
#include "core/trace/trace_reader.hpp"
#include "host/errors/machine_error.hpp"
#include "host/experiment/identity.hpp"
#include "host/process/box.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/orphans.hpp"
#include "host/process/own_process.hpp"
#include "host/trial/kept_trace.hpp"
#include "host/trial/log_line.hpp"
#include "host/trial/measure.hpp"
#include "host/trial/run_trial.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/scratch_folder.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

namespace {

FaultRecord record_of(const PluginFault& fault) {
  FaultRecord record;
  record.kind = fault.kind();
  record.plugin = fault.plugin();
  record.function = fault.function();
  record.step = fault.step();
  record.robot = fault.robot();
  record.detail = fault.what();
  return record;
}

nlohmann::json typed(const char* type, nlohmann::json message) {
  message["type"] = type;
  return message;
}

mode_t current_umask() {
  const mode_t mask = umask(0);
  umask(mask);
  return mask;
}

// What the worker says. Copies of it say nothing.
class Sender {
 public:
  explicit Sender(LineChannel& channel) : channel_(channel) {}

  void begin(const Job& job) {
    trial_ = job.trial;
    own_process::set_stamp(job.stamp);
    send({{"type", "began"}});
  }

  void send(nlohmann::json message) {
    if (own_process::is_other_process()) _exit(0);
    message["trial"] = trial_;
    message["stamp"] = own_process::stamp();
    if (!channel_.send(message)) _exit(channel_closed_exit);
  }

 private:
  LineChannel& channel_;
  std::uint64_t trial_ = 0;
};

void write_text(const std::string& file, const std::string& text) {
  const core::File out = core::create_file(file);
  if (std::fwrite(text.data(), 1, text.size(), out.get()) != text.size() || std::fflush(out.get()) != 0)
    throw std::system_error(errno, std::generic_category(), file);
}

class Worker {
 public:
  Worker(const Experiment& experiment, const std::filesystem::path& run_directory, LineChannel& channel, Sender& sender,
         CallNote& note)
      : experiment_(experiment),
        plans_(run_directory),
        combinations_(combinations(experiment)),
        channel_(channel),
        sender_(sender),
        guard_(note),
        pool_(experiment.libraries, guard_,
              [&](std::int32_t level, const std::string& plugin, const std::string& text) {
                std::fputs(log_line(level, plugin, text, logged_, note).c_str(), stderr);
              }) {}

  void serve() {
    if (experiment_.limits.processes) guard_.allow_processes();
    sender_.send({{"type", "ready"}, {"digest", loaded_digest(experiment_)}});
    while (const auto message = channel_.receive()) {
      const auto job = message->get<Job>();
      sender_.begin(job);
      run(job);
    }
  }

 private:
  const VariantWorld& variant(std::uint32_t scenario) {
    auto& made = variants_[scenario];
    if (!made) made = std::make_unique<VariantWorld>(experiment_, experiment_.scenarios[scenario]);
    return *made;
  }

  void run(const Job& job) {
    const TrialId id = trial_id(job.trial, combinations_.size());
    const Combination& combination = combinations_[id.combination];
    const std::uint64_t seed = trial_seed(experiment_, job.trial);
    const VariantWorld& shared = variant(combination.scenario);
    std::unique_ptr<const VariantWorld> own;
    if (const ScenarioVariant& scenario = experiment_.scenarios[combination.scenario]; is_drawn(scenario))
      own = std::make_unique<VariantWorld>(
          experiment_, scenario, shared,
          task_seed(experiment_, scenario.scenario.name, scenario.wishes, id.repetition));
    const VariantWorld& world = own ? *own : shared;

    umask(umask_);  // a plugin of an earlier trial can have changed it
    KeptTrace kept(job.trace_file, job.scratch_file);
    core::TraceEncoder trace(
        world.view.world(), [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { kept.write(t_ns, record); },
        kept.foxglove());

    guard_.reset_timing();
    logged_ = {job.trial, world.simulation.step_ns};
    std::optional<StoredPlan> stored;
    TrialDone done;
    done.task = task_hash(world.scenario);
    try {
      const TrialEnding ending = run_trial(
          {experiment_, combination, world, seed, first_plan_of(job, combination, stored, done.timing)}, pool_, trace);
      done.outcome = ending.succeeded ? trial_outcome::succeeded : trial_outcome::failed;
      done.sim_time_s = ending.sim_time_s;
      guard_.check_no_children();
    } catch (const PluginFault& fault) {
      done.outcome = trial_outcome::fault;
      kept.finish();
      report(fault);
      pool_.clear();
    }
    if (done.outcome != trial_outcome::fault) {
      std::vector<MetricEvent> events;
      measure_all(kept, world, seed, job, events);
      finish(kept, std::move(events));
    }
    for (TimingReason& reason : guard_.timing()) done.timing.push_back(std::move(reason));
    sender_.send(typed("done", done));
    if (own) pool_.clear();  // instances may keep pointers into their world
  }

  // As stored, or to be stored. A trial is as repeatable as the plan that it gets.
  FirstPlan first_plan_of(const Job& job, const Combination& combination, std::optional<StoredPlan>& stored,
                          std::vector<TimingReason>& timing) {
    if (job.plan.empty()) return {};
    const std::string& planner =
        experiment_.global_planners[static_cast<std::size_t>(combination.global_planner)].info.id;
    if (job.new_plan.empty()) {
      stored = plans_.read(job.plan);
      timing = stored->timing;
    }
    return {stored ? &stored->answer : nullptr, [&, planner](const PlannerAnswer& made) {
              if (!stored) return store(job, planner, made);
              timing.clear();
              if (!same_plan(made, stored->answer))
                timing.push_back({planner, "its first plan is another than the run has stored"});
            }};
  }

  void store(const Job& job, const std::string& planner, const PlannerAnswer& made) {
    std::vector<TimingReason> timing = guard_.timing();
    std::erase_if(timing, [&](const TimingReason& reason) { return reason.plugin != planner; });
    umask(umask_);  // the planner can have changed it
    write_text(job.new_plan, plan_csv(made.paths));
    sender_.send(typed("planned", StoredPlan{made, std::move(timing)}));
  }

  static void finish(KeptTrace& kept, std::vector<MetricEvent> events) {
    std::stable_sort(events.begin(), events.end(),
                     [](const MetricEvent& a, const MetricEvent& b) { return a.from_ns < b.from_ns; });
    if (core::FoxgloveChannels* const foxglove = kept.foxglove())
      for (const MetricEvent& event : events)
        foxglove->metric_event({event.metric, event.from_ns, event.to_ns, event.robots, event.text});
    kept.finish();
  }

  void report(const PluginFault& fault) {
    nlohmann::json message = typed("fault", record_of(fault));
    message["fatal"] = fault.fatal();
    sender_.send(std::move(message));
    // no function of the library may be called, not even destroy(): another worker continues
    if (fault.fatal()) _exit(1);
  }

  void measure_all(KeptTrace& kept, const VariantWorld& world, std::uint64_t seed, const Job& job,
                   std::vector<MetricEvent>& events) {
    core::TraceReader reader(kept.records(), core::TraceExtent::samples);
    for (std::uint32_t i = 0; i < experiment_.metrics.size(); ++i) {
      if (std::find(job.skip_metrics.begin(), job.skip_metrics.end(), i) != job.skip_metrics.end()) continue;
      sender_.send({{"type", "measuring"}, {"index", i}});
      const PluginUse& use = experiment_.metrics[i];
      try {
        MetricResult result = measure(reader, world.walking_grids, pool_.get(use, DMRP_NO_ROBOT), use.info, i, seed,
                                      static_cast<std::int64_t>(experiment_.limits.step_time_s * 1e9));
        guard_.check_no_children();
        send_in_pieces(result, [&](const MetricResult& piece, bool last) {
          nlohmann::json message = typed("metric", piece);
          message["last"] = last;
          sender_.send(std::move(message));
        });
        std::move(result.events.begin(), result.events.end(), std::back_inserter(events));
      } catch (const PluginFault& fault) {
        report(fault);
      }
    }
  }

  const Experiment& experiment_;
  const StoredPlans plans_;
  std::vector<Combination> combinations_;
  LineChannel& channel_;
  Sender& sender_;
  const mode_t umask_ = current_umask();
  CallGuard guard_;
  std::optional<LoggedTrial> logged_;
  std::map<std::uint32_t, std::unique_ptr<VariantWorld>> variants_;  // instances keep pointers into them
  InstancePool pool_;
};

// Without a child process: the supervisor has already probed these libraries.
Probe read_descriptors(const std::filesystem::path& file) {
  const Library library(file);
  return {library.plugins(), library.warnings(), ""};
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
  // processes that a plugin starts do not inherit them
  for (const int descriptor : {task.read_end, task.write_end}) fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  LineChannel channel{Descriptor(task.read_end), Descriptor(task.write_end)};
  Sender sender(channel);
  setenv("TMPDIR", task.scratch.c_str(), 1);  // temporary files of plugins go there, too
  try {
    own_process::watch({task.read_end, task.write_end});
    adopt_orphans();
    const SharedCallNote shared{Descriptor(task.note)};
    set_resource_limits(task.limits.memory_mb);
    box::enter(task.limits.processes, &shared.note().refused, task.scratch);
    const auto refuse_unloadable = [&](const std::filesystem::path& file) -> Probe {
      const auto& all = task.unloadable;
      return {{}, {}, std::find(all.begin(), all.end(), file) == all.end() ? "" : "the supervisor has left it out"};
    };
    const Experiment experiment = load_experiment(task.experiment, task.trials, &read_descriptors, refuse_unloadable);
    Worker(experiment, run_directory_of(task.scratch), channel, sender, shared.note()).serve();
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
