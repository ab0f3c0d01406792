// SPDX-License-Identifier: MIT
#include "host/workers/worker_process.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "host/process/memory_group.hpp"

namespace dmrp::host {

namespace {

ChildProcess start(const Experiment& experiment, const std::filesystem::path& scratch, int log,
                   std::initializer_list<int> inherited) {
  const bool counts_data = !MemoryGroup::available() && !counts_resident_memory(experiment);
  const std::int64_t data_mb = counts_data ? experiment.limits.memory_mb : 0;
  ChildProcess::Program program;
  program.arguments = {"worker",
                       experiment.file.string(),
                       std::to_string(experiment.trials),
                       std::to_string(data_mb),
                       experiment.limits.processes ? "processes" : "no_processes",
                       scratch.string()};
  program.inherited = inherited;
  for (const int descriptor : program.inherited) program.arguments.push_back(std::to_string(descriptor));
  for (const std::filesystem::path& library : experiment.unloadable) program.arguments.push_back(library.string());
  program.output = log;
  program.group_memory_mb = experiment.limits.memory_mb;
  program.ignores_terminal = true;  // the supervisor ends its workers
  return ChildProcess::execute(program);
}

}  // namespace

WorkerProcess::WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch)
    : WorkerProcess(experiment, scratch, make_call_note(), make_pipe(), make_pipe(), make_pipe()) {}

WorkerProcess::WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, Descriptor note,
                             Pipe to_worker, Pipe from_worker, Pipe output)
    : process_(start(experiment, scratch, output.write_end.number(),
                     {to_worker.read_end.number(), from_worker.write_end.number(), note.number()})),
      note_(std::move(note)),
      channel_(std::move(from_worker.read_end), std::move(to_worker.write_end)),
      log_(std::move(output.read_end)) {}

}  // namespace dmrp::host
