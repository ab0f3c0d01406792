// SPDX-License-Identifier: MIT
#include "host/check/case_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "host/check/rehearsal/fence.hpp"
#include "host/check/rehearsal/stage.hpp"
#include "host/errors/escaped_text.hpp"
#include "host/errors/machine_error.hpp"
#include "host/guests/fork_server.hpp"
#include "host/plugins/calls/own_process.hpp"
#include "host/process/box.hpp"
#include "host/process/call_note.hpp"
#include "host/process/child_process.hpp"
#include "host/process/descriptor.hpp"
#include "host/process/orphans.hpp"
#include "host/process/resource_limits.hpp"
#include "host/process/sanitized.hpp"
#include "host/process/watchdog.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t memory_mb = 2048;
constexpr std::int64_t file_mb = 16;  // what a plugin prints is kept in memory

std::int64_t case_limit_s() {
  return sanitizer_is_loaded() ? 300 : 30;
}

bool is_late(const ChildProcess& child, std::int64_t elapsed_ns) {
  return child.is_late(elapsed_ns, 0, case_limit_s() * 1'000'000'000);
}

// A file in memory, by which a child returns an answer of any length.
class MemoryFile {
 public:
  MemoryFile();                                                     // throws MachineError
  explicit MemoryFile(Descriptor file) : file_(std::move(file)) {}  // another process has made it

  void append(std::string_view bytes) const;  // throws MachineError
  std::string read() const;
  int descriptor() const { return file_.number(); }

 private:
  Descriptor file_;
};

MemoryFile::MemoryFile() : file_(memfd_create("dmrp-answer", MFD_CLOEXEC)) {
  if (!file_.is_open()) throw MachineError("memfd_create", errno);
}

void MemoryFile::append(std::string_view bytes) const {
  if (!file_.write(bytes)) throw MachineError("an answer cannot be written", errno);
}

std::string MemoryFile::read() const {
  const off_t size = lseek(file_.number(), 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = pread(file_.number(), text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  text.resize(done);
  return text;
}

// A line of the answer. Texts of plugins need not be UTF-8: invalid bytes are replaced.
void send(const MemoryFile& answer, const nlohmann::json& message) {
  answer.append(message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

// Runs in the guest.
void examine(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
             std::uint64_t seed, CallNote& note, const MemoryFile& answer) {
  const auto progress = [&](const std::string& what) { send(answer, {{"at", what}}); };
  // in memory that is never freed: after a fatal fault no function of the library may be called
  auto* const examination = new Examination(file, plugin, seed, note, progress);
  CheckResult result = CheckResult::pass;
  try {
    check_case.run(*examination);
    examination->deinit();
  } catch (const Skipped& skipped) {
    return send(answer, {{"result", CheckResult::skip}, {"text", skipped.reason}});
  } catch (const PluginFault& fault) {
    if (fault.kind() == std::string_view(fault_kind::unsupported))
      return send(answer, {{"result", CheckResult::skip}, {"text", "it says that this trial is not for it"}});
    examination->fail(fault.text());
  } catch (const std::bad_alloc&) {
    examination->fail(lack_of_memory(memory_mb));
  } catch (const std::exception& error) {
    examination->fail(error.what());
  }
  result = examination->result();
  send(answer, {{"result", result}, {"text", examination->text()}, {"call_ns", examination->call_ns()}});
}

int answer_descriptor = -1;  // for the signal handler

// Says what the plugin did, if it touched what a case fences. Async-signal-safe.
void note_breach(int number, siginfo_t* info, void*) {
  if (const char* const what = fence::breach(info->si_addr))
    for (const std::string_view part :
         {std::string_view(R"({"breach":")"), std::string_view(what), std::string_view("\"}\n")}) {
      [[maybe_unused]] const ssize_t written = write(answer_descriptor, part.data(), part.size());
    }
  signal(number, SIG_DFL);
  raise(number);
}

void watch_fences(int descriptor) {
  if (sanitizer_is_loaded()) return;  // it has a handler of its own
  answer_descriptor = descriptor;
  struct sigaction action {};
  action.sa_sigaction = &note_breach;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &action, nullptr);
}

struct Answer {
  std::string at;      // what was tried last
  std::string breach;  // of a fence
  std::optional<CheckResult> result;
  std::string text;
  std::int64_t call_ns = 0;
};

// A plugin can have written to the file: what cannot be read is ignored.
Answer read_answer(const std::string& text) {
  Answer answer;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin)) {
    const auto line = nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (!line.is_object()) continue;
    if (line.contains("at") && line["at"].is_string()) answer.at = line["at"].get<std::string>();
    if (line.contains("breach") && line["breach"].is_string()) answer.breach = line["breach"].get<std::string>();
    if (!line.contains("result") || !line["result"].is_number_integer()) continue;
    const auto result = line["result"].get<std::int64_t>();
    if (result < 0 || result > static_cast<std::int64_t>(CheckResult::crash)) continue;
    answer.result = static_cast<CheckResult>(result);
    answer.text = line.value("text", "");
    answer.call_ns = line.value("call_ns", std::int64_t{0});
  }
  return answer;
}

// How a child ended that gave no answer.
std::string explain(const ProcessEnding& ending, bool hung, bool too_large, const NotedCall& call,
                    const Answer& answer) {
  std::string text = too_large ? fmt::format("needs more than {} MB of memory", memory_mb)
                     : hung    ? fmt::format("does not end within {} s", case_limit_s())
                               : ending.explain(memory_mb);
  if (ending.signal == SIGSEGV && !answer.breach.empty()) text = answer.breach;
  if (ending.signal == SIGSYS) text = "makes a system call that the box refuses: " + box::name_of(call.refused);
  if (call.inside) text = call_text(call.plugin, call.function, text);
  return answer.at.empty() ? text : answer.at + ": " + text;
}

}  // namespace

int run_case_in_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors) {
  const auto found = std::find_if(check_cases().begin(), check_cases().end(),
                                  [&](const CheckCase& one) { return one.name == arguments.at(0); });
  const std::filesystem::path file = arguments.at(1);
  std::optional<PluginInfo> plugin;
  if (!arguments.at(2).empty()) plugin = nlohmann::json::parse(arguments[2]).get<PluginInfo>();
  for (const int descriptor : descriptors) fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  const MemoryFile answer(Descriptor(descriptors.at(0)));
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(descriptors.at(1), stream);
  close(descriptors[1]);
  const SharedCallNote note(Descriptor(descriptors.at(2)));
  try {
    adopt_orphans();
    own_process::watch();
    limit_ticks(static_cast<std::uint32_t>(std::stoul(arguments.at(5))));
    set_resource_limits(std::stoll(arguments.at(4)));
    limit_files(file_mb);
    watch_fences(answer.descriptor());
    box::enter(plugin && plugin->has_flag(DMRP_FLAG_PROCESSES), &note.note().refused);
    examine(*found, file, plugin ? &*plugin : nullptr, std::stoull(arguments.at(3)), note.note(), answer);
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory_exit);
  }
  std::fflush(stderr);
  _exit(0);  // destructors of static objects in the library are not run
}

CaseOutcome run_case(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
                     std::uint64_t seed, std::uint32_t ticks) {
  const ForkServer& fork_server = own_fork_server();
  const MemoryFile answer_file;
  const MemoryFile output;
  Descriptor note_memory = make_call_note();
  const std::int64_t start_ns = monotonic_ns();
  const bool counts_resident = plugin && plugin->has_flag(DMRP_FLAG_RESIDENT_MEMORY);
  const std::string info = plugin ? nlohmann::json(*plugin).dump() : "";
  const std::unique_ptr<ChildProcess> started =
      fork_server.start({GuestOrder::Program::check_case,
                         {check_case.name, file.string(), info, std::to_string(seed),
                          std::to_string(counts_resident ? 0 : memory_mb), std::to_string(ticks)},
                         visible_paths_of({"", file, {}}),
                         {answer_file.descriptor(), output.descriptor(), note_memory.number()}});
  ChildProcess& child = *started;
  const SharedCallNote note(std::move(note_memory));
  child.allow_cpu(processor_time_s(case_limit_s()));
  Watchdog watchdog;
  bool too_large = false;
  const bool ended = watchdog.wait(child.ended().number(), [&] {
    too_large = !sanitizer_is_loaded() && child.memory_in_use().resident_mb > static_cast<double>(memory_mb);
    return too_large || is_late(child, watchdog.elapsed_ns(start_ns));
  });
  child.kill();
  const ProcessEnding& ending = child.wait();
  kill_orphans({fork_server.number()});

  CaseOutcome outcome;
  outcome.hung = !ended && !too_large;
  outcome.printed = escaped(output.read().substr(0, 400).c_str());
  const Answer answer = read_answer(answer_file.read());
  if (ended && ending.succeeded() && answer.result) {
    outcome.result = *answer.result;
    outcome.detail = escaped(answer.text.c_str());
    outcome.call_ns = answer.call_ns;
  } else {
    outcome.result = CheckResult::crash;
    outcome.detail = escaped(explain(ending, outcome.hung, too_large, note.read(), answer).c_str());
  }
  return outcome;
}

}  // namespace dmrp::host
