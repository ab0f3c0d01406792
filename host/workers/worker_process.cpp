// SPDX-License-Identifier: MIT
#include "host/workers/worker_process.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

namespace dmrp::host {

namespace {

ChildProcess start(const Experiment& experiment, const std::filesystem::path& scratch, JobPlace place, int log,
                   std::initializer_list<int> inherited) {
  ChildProcess::Program program;
  program.arguments = {"worker",
                       experiment.file.string(),
                       std::to_string(experiment.trials),
                       std::to_string(place.jobs),
                       std::to_string(place.processor),
                       scratch.string()};
  program.inherited = inherited;
  for (const int descriptor : program.inherited) program.arguments.push_back(std::to_string(descriptor));
  program.output = log;
  program.ignores_terminal = true;  // the supervisor ends its workers
  return ChildProcess::execute(program);
}

// The plugins that the experiment uses: the worker loads no library.
nlohmann::json setup_of(const Experiment& experiment) {
  nlohmann::json libraries = nlohmann::json::object();
  for (const LibraryUse& library : experiment.libraries)
    libraries[library.file.string()] = {
        {"plugins", nlohmann::json::array()}, {"objects", library.objects}, {"runtime", library.runtime}};
  std::set<std::string> added;
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses)
      if (added.insert(use.info.id).second)
        libraries[experiment.libraries[use.library].file.string()]["plugins"].push_back(use.info);
  return {{"libraries", libraries}};
}

}  // namespace

WorkerProcess::WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, JobPlace place)
    : WorkerProcess(experiment, scratch, place, make_pipe(), make_pipe(), make_pipe()) {}

WorkerProcess::WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, JobPlace place,
                             Pipe to_worker, Pipe from_worker, Pipe output)
    : process_(start(experiment, scratch, place, output.write_end.number(),
                     {to_worker.read_end.number(), from_worker.write_end.number()})),
      channel_(std::move(from_worker.read_end), std::move(to_worker.write_end)),
      log_(std::move(output.read_end)) {
  to_worker.read_end.close();  // a worker that ends before it reads closes the pipe
  channel_.send(setup_of(experiment));
}

}  // namespace dmrp::host
