// SPDX-License-Identifier: MIT
#include "host/process/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string_view>
#include <utility>

#include "host/errors/machine_error.hpp"
#include "host/process/box.hpp"
#include "host/process/orphans.hpp"
#include "host/process/resource_limits.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

constexpr int start_failed_exit = 127;  // as a shell's

// Above this process's.
std::string oom_score_of_children() {
  constexpr int step = 500;
  constexpr int highest = 1000;
  int own = 0;
  std::ifstream("/proc/self/oom_score_adj") >> own;
  return std::to_string(std::min(own + step, highest));
}

// Only async-signal-safe functions. Where it fails, the kernel chooses as it likes.
void be_killed_first(std::string_view score) {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = write(file, score.data(), score.size());
  close(file);
}

void begin_child(std::string_view oom_score) {
  prctl(PR_SET_DUMPABLE, 1);  // the parent is hidden, and so is what it may write in /proc
  be_killed_first(oom_score);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
}

// Between fork and exec: only async-signal-safe functions.
[[noreturn]] void execute_program(const char* const* arguments, const ChildProcess::Program& program) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (program.ignores_terminal)
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(number, SIG_IGN);
  signal(SIGPIPE, SIG_DFL);
  dup2(program.output, STDOUT_FILENO);
  dup2(program.output, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);
  for (const int descriptor : program.inherited) fcntl(descriptor, F_SETFD, 0);
  execv(arguments[0], const_cast<char* const*>(arguments));
  _exit(start_failed_exit);
}

constexpr int longest_wait_factor = 20;  // no limit is exceeded more often than this, however loaded the machine is

}  // namespace

const char* ProcessEnding::fault_kind() const {
  if (signal == SIGSYS) return fault_kind::abi_breach;
  if (signal == SIGXCPU) return fault_kind::hang;
  if (signal != 0) return fault_kind::crash;
  return exit_status == out_of_memory_exit ? fault_kind::out_of_memory : fault_kind::exit;
}

std::string ProcessEnding::explain(std::int64_t memory_mb) const {
  if (exit_status == out_of_memory_exit) return lack_of_memory(memory_mb);
  if (signal == SIGSYS) return "made a system call that its process may not make";
  if (signal == SIGXCPU) return fmt::format("took more than {:.3g} s of processor time", cpu_limit_s);
  if (signal != 0) return fmt::format("crashed (signal {}, {})", signal, strsignal(signal));
  return fmt::format("ended the process with status {}", exit_status);
}

std::int64_t waited_for_processor_ns(pid_t process) {
  std::int64_t ran_ns = 0;
  std::int64_t waited_ns = 0;
  std::ifstream(fmt::format("/proc/{}/schedstat", process)) >> ran_ns >> waited_ns;
  return waited_ns;
}

void be_child() {
  begin_child(oom_score_of_children());
}

bool is_late(std::int64_t elapsed_ns, std::int64_t waited_ns, std::int64_t limit_ns) {
  return elapsed_ns - waited_ns > limit_ns || elapsed_ns / longest_wait_factor > limit_ns;
}

ChildProcess ChildProcess::execute(const Program& program) {
  const std::string executable = executable_path().string();
  std::vector<const char*> arguments = {executable.c_str()};
  for (const std::string& argument : program.arguments) arguments.push_back(argument.c_str());
  arguments.push_back(nullptr);
  box::hide();
  std::fflush(nullptr);  // buffered output would be written twice
  const pid_t parent = getpid();
  const std::string oom_score = oom_score_of_children();
  const pid_t child = fork();
  if (child < 0) throw MachineError("fork", errno);
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(start_failed_exit);  // it ended before prctl()
    begin_child(oom_score);
    execute_program(arguments.data(), program);
  }
  return ChildProcess(child);
}

std::unique_ptr<ChildProcess> ChildProcess::adopt(pid_t number) {
  return std::unique_ptr<ChildProcess>(new ChildProcess(number));
}

ChildProcess::ChildProcess(pid_t number) : pid_(number) {
  ended_ = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, pid_, 0)));
  if (ended_.is_open()) return;
  const int reason = errno;
  kill();
  wait();
  throw MachineError("pidfd_open", reason);
}

ChildProcess::~ChildProcess() {
  kill();
  wait();
}

// The number stays the child's until it has been waited for.
void ChildProcess::kill() {
  if (pid_ < 0) return;
  killed_ = true;
  ::kill(pid_, SIGKILL);
}

MemoryInUse ChildProcess::memory_in_use() const {
  MemoryInUse used;
  if (pid_ < 0) return used;
  std::vector<pid_t> processes = {pid_};
  for (std::size_t i = 0; i < processes.size(); ++i) {
    std::ifstream file(fmt::format("/proc/{}/status", processes[i]));
    const auto kilobytes = [&file] {
      double value = 0.0;
      file >> value;
      return value;
    };
    for (std::string word; file >> word;) {
      if (word == "VmRSS:") used.resident_mb += kilobytes() / 1024.0;
      if (word == "RssShmem:") used.shared_mb += kilobytes() / 1024.0;
    }
    const std::vector<pid_t> children = children_of(processes[i]);
    processes.insert(processes.end(), children.begin(), children.end());
  }
  return used;
}

bool ChildProcess::is_late(std::int64_t elapsed_ns, std::int64_t waited_before_ns, std::int64_t limit_ns) const {
  return elapsed_ns > limit_ns && host::is_late(elapsed_ns, waited_for_processor_ns() - waited_before_ns, limit_ns);
}

void ChildProcess::allow_cpu(double s) {
  clockid_t clock{};
  timespec used{};
  rlimit limit{};
  if (pid_ < 0 || clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &used) != 0 ||
      prlimit(pid_, RLIMIT_CPU, nullptr, &limit) != 0)
    return;  // it has ended
  const auto until_s = static_cast<rlim_t>(used.tv_sec) + static_cast<rlim_t>(std::ceil(s)) + 1;
  limit.rlim_cur = std::min(until_s, limit.rlim_max);
  prlimit(pid_, RLIMIT_CPU, &limit, nullptr);
  ending_.cpu_limit_s = s;
}

const ProcessEnding& ChildProcess::wait() {
  if (pid_ < 0) return ending_;
  int status = 0;
  rusage used{};
  while (wait4(pid_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (WIFSIGNALED(status))
    ending_.signal = WTERMSIG(status);
  else
    ending_.exit_status = WEXITSTATUS(status);
  ending_.killed_from_outside = ending_.signal == SIGKILL && !killed_;
  ending_.peak_rss_mb = static_cast<double>(used.ru_maxrss) / 1024.0;
  return ending_;
}

}  // namespace dmrp::host
