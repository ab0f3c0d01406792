// SPDX-License-Identifier: MIT
// A library is loaded in a child process first: a truncated file raises SIGBUS inside dlopen, static initialisers may do
// anything, and neither may end the host.
#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "host/plugins/library.hpp"
#include "host/plugins/plugin_host.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/watchdog.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t probe_limit_s = 20;

// Runs `dmrp-host probe FILE` and returns its answer. Throws std::runtime_error if it gives none.
nlohmann::json answer_of_child(const std::filesystem::path& file) {
  Pipe pipe = make_pipe();
  const int write_end = pipe.write_end.number();
  ChildProcess child = ChildProcess::execute({{"probe", file.string(), std::to_string(write_end)}, {write_end}});
  pipe.write_end.close();
  LineChannel channel(std::move(pipe.read_end), Descriptor());

  Watchdog watchdog;
  const std::int64_t start_ns = monotonic_ns();
  bool late = false;
  const auto wait = [&] {
    return watchdog.wait(channel.read_end(),
                         [&] { return late = watchdog.elapsed_ns(start_ns) > probe_limit_s * 1'000'000'000; });
  };
  const std::optional<nlohmann::json> answer = channel.receive(wait);
  if (late) throw std::runtime_error(fmt::format("hangs while it is loaded ({} s)", probe_limit_s));
  if (answer) return *answer;
  const ProcessEnding& ending = child.wait();
  if (ending.signal != 0)
    throw std::runtime_error(fmt::format("crashes while it is loaded (signal {}, {}; a truncated file?)", ending.signal,
                                         strsignal(ending.signal)));
  throw std::runtime_error("ends the process while it is loaded");
}

// Calls init(), so that a library that cannot work here is found before a run begins. Why it cannot; "" if it can.
std::string try_init(const Library& library) {
  const auto note = std::make_unique<CallNote>();
  CallGuard guard(*note);
  const PluginHost host("library", library.file().string(), {}, guard,
                        [](std::int32_t, const std::string&, const std::string&) {});
  try {
    guard.call(host.c(), {"library", "init"}, init_budget_ns, Answers::no_other,
               [&] { return library.entry().init(host.c()); });
  } catch (const PluginFault& fault) {
    return std::string("its init() failed: ") + fault.what();
  }
  library.entry().deinit();
  return "";
}

}  // namespace

Probe probe_library(const std::filesystem::path& file) {
  const nlohmann::json answer = answer_of_child(file);
  if (answer.contains("error")) throw std::runtime_error(answer.at("error").get<std::string>());
  return {answer.at("plugins").get<std::vector<PluginInfo>>(), answer.at("warnings").get<std::vector<std::string>>(),
          answer.at("init_error").get<std::string>()};
}

void run_probe(const std::filesystem::path& file, int descriptor) {
  nlohmann::json answer;
  try {
    const Library library(file);
    answer = {{"plugins", library.plugins()}, {"warnings", library.warnings()}, {"init_error", try_init(library)}};
  } catch (const std::exception& error) {
    answer = {{"error", error.what()}};
  }
  const bool sent = LineChannel(Descriptor(), Descriptor(descriptor)).send(answer);
  _exit(sent ? 0 : 1);  // not exit(): that would run destructors of the library's static objects
}

}  // namespace dmrp::host
