// SPDX-License-Identifier: MIT
#include "host/evaluate/measure_stored.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>

#include "core/trace/trace_reader.hpp"
#include "host/errors/machine_error.hpp"
#include "host/guests/command_guests.hpp"
#include "host/guests/guest_end.hpp"
#include "host/trial/ask_metric.hpp"
#include "host/trial/kept_trace.hpp"

namespace dmrp::host {

namespace {

class Measurer {
 public:
  Measurer(const Evaluation& evaluation, const MeasureSinks& sinks)
      : evaluation_(evaluation), sinks_(sinks), guests_(evaluation.libraries, evaluation.limits, DMRP_LOG_WARNING) {}

  void measure(const StoredTrial& trial) {
    try {
      core::TraceRecords records(trial.trace);
      KeptTrace kept({}, std::filesystem::temp_directory_path() / fmt::format("dmrp-evaluate-{}", getpid()));
      while (const auto record = records.next()) kept.write(0, record->whole);
      const std::uint32_t robots = core::TraceReader(kept.records()).world().robot_count;
      guests_.begin_trial(trial.id, kept.spool_descriptor());
      for (std::uint32_t i = 0; i < evaluation_.metrics.size(); ++i)
        measure_metric(trial, {kept.in_memory(), nullptr, robots, trial.seed}, i);
    } catch (const MachineError&) {
      throw;
    } catch (const std::exception& error) {
      sinks_.failure(trial, fmt::format("{}: {}", trial.trace.string(), error.what()));
    }
  }

 private:
  void measure_metric(const StoredTrial& trial, const FinishedTrial& finished, std::uint32_t index) {
    const PluginUse& use = evaluation_.metrics[index];
    try {
      const auto budget_ns = static_cast<std::int64_t>(evaluation_.limits.step_time_s * 1e9);
      sinks_.result(trial, ask_metric(guests_.all(), use, index, finished, budget_ns));
    } catch (const PluginFault& fault) {
      sinks_.failure(trial, words_of(fault));
      if (fault.fatal()) guests_.end(use.library);
    }
  }

  const Evaluation& evaluation_;
  const MeasureSinks& sinks_;
  CommandGuests guests_;
};

}  // namespace

void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks) {
  Measurer measurer(evaluation, sinks);
  for (const StoredTrial& trial : trials) measurer.measure(trial);
}

}  // namespace dmrp::host
