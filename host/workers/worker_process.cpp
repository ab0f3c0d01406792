// SPDX-License-Identifier: MIT
#include "host/workers/worker_process.hpp"

#include <string>
#include <utility>

namespace dmrp::host {

namespace {

ChildProcess start(const std::filesystem::path& experiment, std::uint32_t trials, int log, int read_end, int write_end,
                   int note) {
  ChildProcess::Program program;
  program.arguments = {"worker", experiment.string(), std::to_string(trials)};
  program.inherited = {read_end, write_end, note};
  for (const int descriptor : program.inherited) program.arguments.push_back(std::to_string(descriptor));
  program.output = log;
  program.ignores_terminal = true;  // the supervisor ends its workers
  return ChildProcess::execute(program);
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log)
    : WorkerProcess(experiment, trials, log, make_call_note(), make_pipe(), make_pipe()) {}

WorkerProcess::WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log, Descriptor note,
                             Pipe to_worker, Pipe from_worker)
    : process_(
          start(experiment, trials, log, to_worker.read_end.number(), from_worker.write_end.number(), note.number())),
      note_(std::move(note)),
      channel_(std::move(from_worker.read_end), std::move(to_worker.write_end)) {}

}  // namespace dmrp::host
