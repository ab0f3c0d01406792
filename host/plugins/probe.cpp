// SPDX-License-Identifier: MIT
// A library is loaded in a child process first: a truncated file raises SIGBUS inside dlopen, static initialisers may do
// anything, and neither may end the host.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/plugin_host.hpp"
#include "host/process/box.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/process/orphans.hpp"
#include "host/process/own_process.hpp"
#include "host/process/watchdog.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t probe_limit_s = 20;

// Runs `dmrp-host probe FILE` and returns its answer. Throws std::runtime_error if it gives none.
nlohmann::json answer_of_child(const std::filesystem::path& file) {
  adopt_orphans();
  Pipe pipe = make_pipe();
  const int write_end = pipe.write_end.number();
  ChildProcess child = ChildProcess::execute({{"probe", file.string(), std::to_string(write_end)}, {write_end}});
  child.allow_cpu(processor_time_s(probe_limit_s));
  pipe.write_end.close();
  LineChannel channel(std::move(pipe.read_end), Descriptor());

  Watchdog watchdog;
  const std::int64_t start_ns = monotonic_ns();
  bool late = false;
  // copies of the child may keep the channel open
  const auto wait = [&] {
    std::array<pollfd, 2> watched = {{{channel.read_end(), POLLIN, 0}, {child.ended().number(), POLLIN, 0}}};
    while (!watchdog.wait(watched))
      if (late = watchdog.elapsed_ns(start_ns) > probe_limit_s * 1'000'000'000; late) return false;
    return watched[0].revents != 0;
  };
  std::optional<nlohmann::json> answer;
  std::string stage = "dlopen";  // what the child said last that it does
  while ((answer = channel.receive(wait)) && answer->is_object() && answer->contains("stage"))
    if ((*answer)["stage"].is_string()) stage = escaped((*answer)["stage"].get<std::string>().c_str());
  const bool closed = !answer && !late && !watchdog.wait(child.ended().number(), [] { return true; });
  child.kill();
  child.wait();
  kill_orphans({});
  if (late) throw std::runtime_error(fmt::format("hangs while it is loaded, in {} ({} s)", stage, probe_limit_s));
  if (answer) return *answer;
  if (closed) throw std::runtime_error("closes its channel to the host while it is loaded, in " + stage);
  const ProcessEnding& ending = child.wait();
  if (ending.signal == SIGSYS)
    throw std::runtime_error("makes a system call while it is loaded, in " + stage +
                             ", that the box refuses (see --no-box)");
  if (ending.signal != 0)
    throw std::runtime_error(fmt::format("crashes while it is loaded, in {} (signal {}, {}{})", stage, ending.signal,
                                         strsignal(ending.signal), stage == "dlopen" ? "; a truncated file?" : ""));
  throw std::runtime_error("ends the process while it is loaded, in " + stage);
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

bool starts_processes(const Library& library) {
  return std::any_of(library.plugins().begin(), library.plugins().end(),
                     [](const PluginInfo& info) { return info.has_flag(DMRP_FLAG_PROCESSES); });
}

}  // namespace

Probe probe_library(const std::filesystem::path& file) {
  const nlohmann::json answer = answer_of_child(file);
  if (answer.contains("error")) throw std::runtime_error(answer.at("error").get<std::string>());
  return {answer.at("plugins").get<std::vector<PluginInfo>>(), answer.at("warnings").get<std::vector<std::string>>(),
          answer.at("init_error").get<std::string>()};
}

void run_probe(const std::filesystem::path& file, int descriptor) {
  LineChannel channel{Descriptor(), Descriptor(descriptor)};
  nlohmann::json answer;
  try {
    own_process::watch({descriptor});
    box::enter(true);  // which plugins may start processes is known only after loading
    const auto send_stage = [&](const std::string& stage) { channel.send({{"stage", stage}}); };
    const Library library(file, send_stage);
    send_stage("init()");
    box::enter(starts_processes(library));
    answer = {{"plugins", library.plugins()}, {"warnings", library.warnings()}, {"init_error", try_init(library)}};
  } catch (const std::exception& error) {
    answer = {{"error", error.what()}};
  }
  if (own_process::is_other_process()) _exit(0);
  const bool sent = channel.send(answer);
  _exit(sent ? 0 : 1);  // not exit(): that would run destructors of the library's static objects
}

}  // namespace dmrp::host
