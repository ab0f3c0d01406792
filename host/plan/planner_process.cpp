// SPDX-License-Identifier: MIT
#include "host/plan/planner_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

#include "host/plugins/call_note.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/workers/messages.hpp"
#include "host/workers/resource_limits.hpp"
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

namespace {

constexpr int poll_interval_ms = 100;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t call_grace_ns = 5 * second_ns;      // after should_stop() has said yes
constexpr std::int64_t least_limit_ns = 15 * second_ns;    // for all functions but plan()
constexpr std::int64_t process_grace_ns = 60 * second_ns;  // for what is no call: loading

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// The answer crosses in a file in memory: a line of JSON, then the waypoints of all robots as they are.
class AnswerFile {
 public:
  AnswerFile() : descriptor_(memfd_create("dmrp-plan", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail("memfd_create");
  }
  ~AnswerFile() { close(descriptor_); }
  AnswerFile(const AnswerFile&) = delete;
  AnswerFile& operator=(const AnswerFile&) = delete;

  void write(const nlohmann::json& head, const PlannedPaths& paths) const {
    // a plugin's text need not be UTF-8
    append(head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    for (const auto& path : paths)
      append({reinterpret_cast<const char*>(path.data()), path.size() * sizeof(dmrp_waypoint)});
  }

  std::string read() const {
    const off_t size = lseek(descriptor_, 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t count = pread(descriptor_, text.data() + done, text.size() - done, static_cast<off_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    text.resize(done);
    return text;
  }

 private:
  void append(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("write");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  int descriptor_;
};

nlohmann::json head_of(const PlannerAnswer& answer) {
  nlohmann::json statistics = nlohmann::json::array();
  for (const PlanStatistic& statistic : answer.statistics) statistics.push_back({statistic.name, statistic.value});
  nlohmann::json counts = nlohmann::json::array();
  for (const auto& path : answer.paths) counts.push_back(path.size());
  return {{"status", answer.status},
          {"planning_ns", answer.planning_ns},
          {"text", answer.text},
          {"statistics", std::move(statistics)},
          {"counts", std::move(counts)}};
}

// Nothing where it is no answer: a plugin may have written over it.
std::optional<PlannerAnswer> answer_of(const nlohmann::json& head, std::string_view waypoints) {
  PlannerAnswer answer;
  answer.status = head.at("status").get<std::int32_t>();
  answer.planning_ns = head.at("planning_ns").get<std::int64_t>();
  answer.text = head.at("text").get<std::string>();
  for (const nlohmann::json& statistic : head.at("statistics"))
    if (statistic.at(1).is_number())  // JSON has no infinity: such a number is none
      answer.statistics.push_back({statistic.at(0).get<std::string>(), statistic.at(1).get<double>()});
  for (const nlohmann::json& count : head.at("counts")) {
    const auto bytes = count.get<std::size_t>() * sizeof(dmrp_waypoint);
    if (bytes > waypoints.size()) return std::nullopt;
    auto& path = answer.paths.emplace_back(count.get<std::size_t>());
    if (bytes > 0) std::memcpy(path.data(), waypoints.data(), bytes);
    waypoints.remove_prefix(bytes);
  }
  return waypoints.empty() ? std::optional(std::move(answer)) : std::nullopt;
}

// "org.example.planner: plan(): what happened"
std::string detail_of(const std::string& plugin, const std::string& function, const std::string& text) {
  return fmt::format("{}: {}(): {}", plugin, function, text);
}

nlohmann::json head_of(const PluginFault& fault) {
  return {{"fault", fault.kind()}, {"detail", detail_of(fault.plugin(), fault.function(), fault.what())}};
}

void log_line(std::int32_t level, const std::string& plugin, const std::string& text) {
  if (level != DMRP_LOG_DEBUG) std::fprintf(stderr, "%s: %s\n", plugin.c_str(), text.c_str());
}

// In the child.
void plan(const Experiment& experiment, const PlanTask& task, CallNote& note, const AnswerFile& file) {
  CallGuard guard(note);
  const PluginUse& use = experiment.global_planners[0];
  InstancePool pool(experiment.libraries, guard, &log_line);
  try {
    Instance& planner = pool.get(use, -1);
    planner.start(task.world(), experiment.seed, task.problem.c.time_budget_ns);
    const PlannerAnswer answer = ask_planner(planner, task.problem.c, 0);
    file.write(head_of(answer), answer.paths);
  } catch (const PluginFault& fault) {
    file.write(head_of(fault), {});
    if (fault.fatal()) _exit(0);  // no function of the library may be called again
  }
}

// Never returns into the parent's code, not by an exception either.
[[noreturn]] void become_planner(const Experiment& experiment, const PlanTask& task, CallNote& note,
                                 const AnswerFile& file, pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);  // what a plugin prints shall not end up in the answer
  set_resource_limits(experiment.limits.memory_mb);
  try {
    plan(experiment, task, note, file);
  } catch (const PluginFault& fault) {
    file.write(head_of(fault), {});
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory_exit);
  } catch (const std::exception& error) {
    file.write({{"fault", fault_kind::abi_breach}, {"detail", error.what()}}, {});
  }
  std::fflush(stderr);
  // not exit(): static objects of a stranger's library are nobody's business any more
  _exit(0);
}

CallNote& shared_note() {
  void* memory = mmap(nullptr, sizeof(CallNote), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail("mmap");
  return *static_cast<CallNote*>(memory);
}

struct Ending {
  bool killed = false;  // for taking too long
  NotedCall call;       // the last one
  int wait_status = 0;
  rusage used{};
};

// Waits for the process, or ends it when a call takes too long.
Ending watch(pid_t child, const CallNote& note, std::int64_t budget_ns) {
  Ending ending;
  const auto descriptor = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  if (descriptor < 0) fail("pidfd_open");
  const std::int64_t began_ns = monotonic_ns();
  for (;;) {
    pollfd watched = {descriptor, POLLIN, 0};
    if (poll(&watched, 1, poll_interval_ms) > 0) break;
    ending.call = noted_call(note);
    const std::int64_t now_ns = monotonic_ns();
    // the note is only believed where it is possible
    const bool in_call = ending.call.inside && ending.call.start_ns >= began_ns;
    const std::int64_t limit_ns = budget_ns + call_grace_ns;
    ending.killed = now_ns - began_ns > limit_ns + process_grace_ns ||
                    (in_call && now_ns - ending.call.start_ns >
                                    (ending.call.function == "plan" ? limit_ns : std::max(limit_ns, least_limit_ns)));
    if (!ending.killed) continue;
    syscall(SYS_pidfd_send_signal, descriptor, SIGKILL, nullptr, 0);
    break;
  }
  while (wait4(child, &ending.wait_status, 0, &ending.used) < 0 && errno == EINTR) {
  }
  close(descriptor);
  if (!ending.killed) ending.call = noted_call(note);
  return ending;
}

// Why a process that gave no answer ended.
void explain(const Ending& ending, const Experiment& experiment, PlannerRun& run) {
  const auto at_call = [&](const std::string& text) {
    const std::string& id = experiment.global_planners[0].info.id;
    return ending.call.inside ? detail_of(ending.call.plugin, ending.call.function, text) : id + ": " + text;
  };
  if (ending.killed) {
    run.fault = fault_kind::hang;
    run.detail = at_call(
        fmt::format("did not stop when its time of {} s was over, and was killed", experiment.limits.planner_time_s));
  } else if (WIFSIGNALED(ending.wait_status)) {
    const int signal = WTERMSIG(ending.wait_status);
    run.fault = fault_kind::crash;
    run.detail = at_call(fmt::format("crashed (signal {}, {})", signal, strsignal(signal)));
  } else if (WEXITSTATUS(ending.wait_status) == out_of_memory_exit) {
    run.fault = fault_kind::out_of_memory;
    run.detail = at_call(fmt::format("needs more than {} MB of memory", experiment.limits.memory_mb));
  } else {
    run.fault = fault_kind::exit;
    run.detail = at_call(fmt::format("ended the process with status {}", WEXITSTATUS(ending.wait_status)));
  }
}

}  // namespace

PlannerRun run_planner(const Experiment& experiment, const PlanTask& task) {
  const AnswerFile file;
  CallNote& note = shared_note();
  std::fflush(nullptr);  // what is buffered would be written twice
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) become_planner(experiment, task, note, file, parent);
  const Ending ending = watch(child, note, task.problem.c.time_budget_ns);
  munmap(&note, sizeof(CallNote));

  PlannerRun run;
  run.peak_rss_mb = static_cast<double>(ending.used.ru_maxrss) / 1024.0;
  const std::string text = file.read();
  const std::size_t line_end = std::min(text.find('\n'), text.size());
  const bool ended_well =
      !ending.killed && WIFEXITED(ending.wait_status) && WEXITSTATUS(ending.wait_status) == 0 && line_end < text.size();
  if (!ended_well) {
    explain(ending, experiment, run);
    return run;
  }
  try {
    const auto head = nlohmann::json::parse(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(line_end));
    if (head.contains("fault")) {
      run.fault = head.at("fault").get<std::string>();
      run.detail = head.at("detail").get<std::string>();
      return run;
    }
    run.answer = answer_of(head, std::string_view(text).substr(line_end + 1));
  } catch (const nlohmann::json::exception&) {
    run.answer.reset();
  }
  if (!run.answer) {
    run.fault = fault_kind::abi_breach;
    run.detail = experiment.global_planners[0].info.id + ": its process gave an answer that cannot be read";
  }
  return run;
}

}  // namespace dmrp::host
