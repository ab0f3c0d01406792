// SPDX-License-Identifier: MIT
#include "host/evaluate/measure_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "core/trace/trace_reader.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/watchdog.hpp"
#include "host/trial/measure.hpp"

namespace dmrp::host {

namespace {

// The metric of a trial that is measured next.
struct Position {
  std::size_t trial = 0;
  std::uint32_t metric = 0;
};

void log_warning(std::int32_t level, const std::string& plugin, const std::string& text) {
  if (level >= DMRP_LOG_WARNING) std::fprintf(stderr, "%s: %s\n", plugin.c_str(), text.c_str());
}

// In the child: sends its position, then the result there. The messages:
//   {"at": [trial, metric]}            metric null: it reads the trace of the trial
//   {"result": MetricResult}           of the position in the last "at"
//   {"failure": text}                  likewise
//   {"error": text}                    nothing can be measured
//   {"finished": true}
class Measurer {
 public:
  Measurer(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, CallNote& note, LineChannel& channel)
      : evaluation_(evaluation),
        trials_(trials),
        channel_(channel),
        guard_(note),
        pool_(evaluation.libraries, guard_, &log_warning) {}

  void measure_from(Position position) {
    for (; position.trial < trials_.size(); position = {position.trial + 1, 0})
      measure_trial(position.trial, position.metric);
  }

 private:
  void measure_trial(std::size_t index, std::uint32_t first_metric) {
    const StoredTrial& trial = trials_[index];
    channel_.send({{"at", {index, nullptr}}});
    try {
      core::TraceReader reader(core::TraceRecords(trial.trace), core::TraceExtent::samples);
      if (!reader.end()) throw std::runtime_error("was cut short: it has no end");
      const auto walking_grids = std::make_shared<WalkingGrids>(reader.world());
      for (std::uint32_t i = first_metric; i < evaluation_.metrics.size(); ++i) {
        channel_.send({{"at", {index, i}}});
        measure_metric(reader, walking_grids, i, trial.seed);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      send_failure(fmt::format("{}: {}", trial.trace.string(), error.what()));
    }
  }

  void measure_metric(core::TraceReader& reader, const std::shared_ptr<WalkingGrids>& walking_grids,
                      std::uint32_t index, std::uint64_t seed) {
    const PluginUse& use = evaluation_.metrics[index];
    try {
      channel_.send({{"result", measure(reader, walking_grids, pool_.get(use, DMRP_NO_ROBOT), use.info, index, seed,
                                        static_cast<std::int64_t>(evaluation_.limits.step_time_s * 1e9))}});
    } catch (const PluginFault& fault) {
      send_failure(fault.text());
      if (fault.fatal()) _exit(0);  // no function of the library may be called again; another process continues
    }
  }

  void send_failure(const std::string& text) { channel_.send({{"failure", text}}); }

  const Evaluation& evaluation_;
  const std::vector<StoredTrial>& trials_;
  LineChannel& channel_;
  CallGuard guard_;
  InstancePool pool_;
};

// In the child.
void measure(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, Position position, CallNote& note,
             LineChannel& channel) {
  try {
    Measurer(evaluation, trials, note, channel).measure_from(position);
    channel.send({{"finished", true}});
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const PluginFault& fault) {
    channel.send({{"error", fault.text()}});
  } catch (const std::exception& error) {
    channel.send({{"error", error.what()}});
  }
}

// In the parent: a child that measures from a position on.
class MeasureProcess {
 public:
  MeasureProcess(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, Position position)
      : MeasureProcess(evaluation, trials, position, make_pipe()) {}

  // For what it measures next.
  void allow_cpu(double s) { process_.allow_cpu(s); }

  // The next message. Nothing when the process has ended, when it sent an invalid message, or when a call hangs.
  std::optional<nlohmann::json> receive() {
    auto message =
        channel_.receive([this] { return watchdog_.wait(channel_.read_end(), [this] { return is_hanging(); }); });
    sent_invalid_ = message && !message->is_object();
    return sent_invalid_ ? std::nullopt : message;
  }

  // Why the process ended early, with the plugin function that it was in.
  std::string explain(std::int64_t memory_mb) {
    const bool hung = is_hanging();
    const NotedCall call = note_.read();
    if (hung || sent_invalid_) process_.kill();
    const ProcessEnding& ending = process_.wait();
    const std::string text = hung            ? "did not return, and was killed"
                             : sent_invalid_ ? "sent an invalid message, and was killed"
                                             : ending.explain(memory_mb);
    return call.inside ? call_text(call.plugin, call.function, text) : "the measuring process: " + text;
  }

 private:
  MeasureProcess(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, Position position, Pipe pipe)
      : process_(ChildProcess::fork({evaluation.limits.memory_mb, evaluation.limits.processes},
                                    [&] {
                                      LineChannel to_parent(Descriptor(), std::move(pipe.write_end));
                                      measure(evaluation, trials, position, note_.note(), to_parent);
                                    })),
        channel_(std::move(pipe.read_end), Descriptor()) {}

  bool is_hanging() const {
    const NotedCall call = note_.read();
    return call.limit_ns > 0 && watchdog_.is_overdue(call, start_ns_, call.limit_ns);
  }

  SharedCallNote note_{make_call_note()};
  std::int64_t start_ns_ = monotonic_ns();
  ChildProcess process_;
  LineChannel channel_;
  Watchdog watchdog_;
  bool sent_invalid_ = false;
};

// Measures from `position` on until all is measured or the child ends; then moves `position` to where to continue.
void measure_some(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks,
                  Position& position) {
  MeasureProcess process(evaluation, trials, position);
  const double cpu_s = processor_time_s(evaluation.limits.trial_wall_time_s);
  process.allow_cpu(cpu_s);
  bool started = false;
  bool reading = false;   // the trace at `position`
  bool answered = false;  // for `position`
  while (const auto message = process.receive()) {
    if (message->contains("error")) throw std::runtime_error(message->at("error").get<std::string>());
    if (message->contains("finished")) {
      position = {trials.size(), 0};
      return;
    }
    if (message->contains("at")) {
      const auto& at = message->at("at");
      reading = at.at(1).is_null();
      position = {at.at(0).get<std::size_t>(), reading ? 0 : at.at(1).get<std::uint32_t>()};
      started = true;
      answered = false;
      process.allow_cpu(cpu_s);
      continue;
    }
    if (message->contains("result"))
      sinks.result(trials.at(position.trial), message->at("result").get<MetricResult>());
    else
      sinks.failure(trials.at(position.trial), message->at("failure").get<std::string>());
    answered = true;
  }
  const std::string reason = process.explain(evaluation.limits.memory_mb);
  if (!started) throw std::runtime_error(reason);
  if (!answered) sinks.failure(trials.at(position.trial), reason);
  position = reading ? Position{position.trial + 1, 0} : Position{position.trial, position.metric + 1};
}

}  // namespace

void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks) {
  Position position;
  while (position.trial < trials.size()) measure_some(evaluation, trials, sinks, position);
}

}  // namespace dmrp::host
