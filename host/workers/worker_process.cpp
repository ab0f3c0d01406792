// SPDX-License-Identifier: MIT
#include "host/workers/worker_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
  return {ends[0], ends[1]};
}

// Between fork and exec: only what is async-signal-safe.
[[noreturn]] void become_worker(const char* const* arguments, pid_t supervisor, int log, std::array<int, 3> inherited) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  // Ctrl-C and the like reach the whole group; the supervisor decides what becomes of a trial.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(number, SIG_IGN);
  signal(SIGPIPE, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != supervisor) _exit(127);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  // whatever else the supervisor has open or was given itself is none of a plugin's business
  close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);
  for (const int descriptor : inherited) fcntl(descriptor, F_SETFD, 0);
  execv(arguments[0], const_cast<char* const*>(arguments));
  _exit(127);
}

}  // namespace

CallNote& map_call_note(int descriptor) {
  void* memory = mmap(nullptr, sizeof(CallNote), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory == MAP_FAILED) fail("mmap");
  close(descriptor);  // nobody shall shorten the file below the mapping
  return *static_cast<CallNote*>(memory);
}

WorkerProcess::WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log) {
  const int note = memfd_create("dmrp-call-note", MFD_CLOEXEC);
  if (note < 0 || ftruncate(note, sizeof(CallNote)) != 0) fail("memfd_create");
  const Pipe to_worker = make_pipe();
  const Pipe from_worker = make_pipe();

  const std::array<std::string, 7> words = {executable_path().string(),
                                            "worker",
                                            experiment.string(),
                                            std::to_string(trials),
                                            std::to_string(to_worker.read_end),
                                            std::to_string(from_worker.write_end),
                                            std::to_string(note)};
  std::array<const char*, words.size() + 1> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].c_str();

  const pid_t supervisor = getpid();
  pid_ = fork();
  if (pid_ < 0) fail("fork");
  if (pid_ == 0) become_worker(arguments.data(), supervisor, log, {to_worker.read_end, from_worker.write_end, note});
  note_ = &map_call_note(note);
  close(to_worker.read_end);
  close(from_worker.write_end);
  channel_ = std::make_unique<LineChannel>(from_worker.read_end, to_worker.write_end);
  pid_descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
}

WorkerProcess::~WorkerProcess() {
  kill();
  wait();
  if (pid_descriptor_ >= 0) close(pid_descriptor_);
  munmap(note_, sizeof(CallNote));
}

void WorkerProcess::kill() {
  if (pid_ < 0) return;
  if (pid_descriptor_ >= 0)
    syscall(SYS_pidfd_send_signal, pid_descriptor_, SIGKILL, nullptr, 0);
  else
    ::kill(pid_, SIGKILL);
}

bool WorkerProcess::ends_within(int wait_ms) const {
  pollfd watched = {pid_descriptor_, POLLIN, 0};
  return pid_descriptor_ >= 0 && poll(&watched, 1, wait_ms) > 0;
}

int WorkerProcess::wait() {
  if (pid_ < 0) return 0;
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return status;
}

}  // namespace dmrp::host
