// SPDX-License-Identifier: MIT
#include "host/workers/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "host/workers/messages.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t longest_line = 65536;
constexpr int most_reads = 64;  // a copy of the worker may go on printing

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

// The plugins that the experiment uses, since the worker loads no library, what the run has chosen, and what it has found.
nlohmann::json setup_of(const Experiment& experiment) {
  nlohmann::json libraries = nlohmann::json::object();
  for (const LibraryUse& library : experiment.libraries)
    libraries[library.file.string()] = {
        {"plugins", nlohmann::json::array()}, {"objects", library.objects}, {"runtime", library.runtime}};
  std::set<std::string> added;
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses)
      if (!use.plans.is_given() && added.insert(use.info.id).second)
        libraries[experiment.libraries[use.library].file.string()]["plugins"].push_back(use.info);
  nlohmann::json routes = nlohmann::json::object();
  for (const ScenarioVariant& variant : experiment.scenarios)
    if (const std::string entry = std::to_string(variant.entry); variant.routes && !routes.contains(entry))
      routes[entry] = json_of(*variant.routes);
  return {{"libraries", libraries}, {"traces", experiment.traces}, {"routes", std::move(routes)}};
}

}  // namespace

CappedLog::CappedLog(Descriptor read_end) : read_end_(std::move(read_end)) {
  fcntl(read_end_.number(), F_SETFL, O_NONBLOCK);
}

bool CappedLog::copy(const Descriptor& log) {
  std::array<char, 65536> chunk;
  const ssize_t count = read(read_end_.number(), chunk.data(), chunk.size());
  if (count == 0) read_end_.close();
  if (count <= 0) return false;
  line_.append(chunk.data(), static_cast<std::size_t>(count));
  std::size_t whole = line_.rfind('\n') + 1;  // 0 if there is none
  if (line_.size() - whole > longest_line) whole = line_.size();
  write(std::string_view(line_).substr(0, whole), log);
  line_.erase(0, whole);
  return true;
}

void CappedLog::copy_rest(const Descriptor& log) {
  for (int i = 0; i < most_reads && copy(log); ++i) {
  }
  if (!line_.empty()) write(line_ + "\n", log);
  line_.clear();
}

void CappedLog::write(std::string_view text, const Descriptor& log) {
  if (written_ > most_bytes) return;
  written_ += text.size();
  log.write(text);
  if (written_ > most_bytes)
    log.write(fmt::format("[warning] dmrp-host: a worker printed more than {} MB; what follows is left out\n",
                          most_bytes >> 20));
}

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
