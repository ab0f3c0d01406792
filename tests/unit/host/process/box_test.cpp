// SPDX-License-Identifier: MIT
// What the box refuses. Each case tries it in a child.
#include "host/process/box.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <functional>
#include <string>
#include <thread>

#include "host/process/landlock.hpp"

namespace box_test {

using namespace dmrp::host;

// The text that `function` returns in a child; it has 200 characters at most.
template <class Function>
std::string in_child(Function function) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string text = function();
    _exit(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  close(ends[1]);
  char text[256];
  const ssize_t count = read(ends[0], text, sizeof(text));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  return std::string(text, count > 0 ? static_cast<std::size_t>(count) : 0);
}

// As system calls, so that the upper halves of arguments arrive.
std::string reached() {
  std::string done;
  const auto attempt = [&](const char* name, int error, long result) {
    if (result != -1 || errno != error) done += std::string(name) + " ";
  };
  constexpr unsigned long high = 1ul << 32;
  attempt("type", EPERM, syscall(SYS_ioctl, 0, TIOCSTI | high, "x"));
  attempt("console", EPERM, syscall(SYS_ioctl, 0, TIOCLINUX, "x"));
  attempt("owner", EPERM, syscall(SYS_fcntl, 0, F_SETOWN | high, getpid()));
  attempt("signal", EPERM, syscall(SYS_fcntl, 0, F_SETSIG, SIGKILL));
  attempt("segment", EPERM, syscall(SYS_shmget, IPC_PRIVATE, 4096, 0600));
  attempt("key", EPERM, syscall(SYS_add_key, "user", "dmrp", "x", 1, -4));
  attempt("faults", EPERM, syscall(SYS_userfaultfd, 1));
  attempt("memory file", EPERM, syscall(SYS_memfd_create, "dmrp", 0));
  attempt("ring", ENOSYS, syscall(SYS_io_uring_setup, 8, nullptr));
  attempt("limit", EPERM, syscall(SYS_prlimit64, 0, RLIMIT_CORE, std::array<rlim_t, 2>{}.data(), nullptr));
  const std::string parent = "/proc/" + std::to_string(getppid());
  if (landlock::sets_apart(landlock::version())) attempt("memory", EACCES, open((parent + "/mem").c_str(), O_RDWR));
  attempt("terminal", ENXIO, open("/dev/tty", O_RDONLY));
  if (prctl(PR_GET_DUMPABLE) != 0) done += "dumpable ";
  if (fcntl(0, F_GETFD) < 0) done += "no fcntl ";
  return done;
}

TEST_CASE("in the box a process reaches no other by a way around signals") {
  CHECK(in_child([] {
          box::enter(false);
          return reached();
        }).empty());
  CHECK(in_child([] {  // as a probe does
          box::enter(true);
          box::enter(false);
          return reached();
        })
            .empty());
}

TEST_CASE("what a process may not do to others ends it") {
  const auto signal_of = [](const std::function<void()>& function) {
    const pid_t child = fork();
    if (child == 0) {
      box::enter(false);
      function();
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  };
  const pid_t own = getpid();
  CHECK(signal_of([&] { kill(own, 0); }) == SIGSYS);
  CHECK(signal_of([] { kill(getpid(), 0); }) == 0);
  CHECK(signal_of([] { syscall(SYS_prctl, PR_SET_DUMPABLE | 1ul << 32, 1, 0, 0, 0); }) == SIGSYS);
  CHECK(signal_of([] { syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr); }) == SIGSYS);
  CHECK(signal_of([] { std::thread([] {}).join(); }) == 0);
  CHECK(signal_of([] { _exit(syscall(SYS_clone3, nullptr, 0) == -1 && errno == ENOSYS ? 0 : 1); }) == 0);
#if defined(__x86_64__)
  CHECK(signal_of([] { syscall(0x40000000 | SYS_getpid); }) == SIGSYS);  // x32's
#endif
  CHECK(box::name_of(SYS_kill) == "kill");
  CHECK(box::name_of(SYS_clone) == "fork (clone)");
  CHECK(box::name_of(9999) == "system call 9999");
}

}  // namespace box_test
