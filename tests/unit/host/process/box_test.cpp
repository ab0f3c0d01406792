// SPDX-License-Identifier: MIT
// What the box and the sandbox refuse, and what is said where the kernel lacks a part. Each case tries it in a child.
#include "host/process/box.hpp"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "host/process/landlock.hpp"

namespace {

namespace fs = std::filesystem;
using namespace dmrp::host;

// A folder with a scratch folder, and a file and a folder that a plugin may not change.
class Places {
 public:
  Places() {
    std::string name = (fs::temp_directory_path() / "dmrp_box_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    root = name;
    fs::create_directory(root / "scratch");
    fs::create_directory(root / "results");
    std::ofstream(root / "results/file") << "kept";
  }
  ~Places() { fs::remove_all(root); }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  fs::path root;
};

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

bool can_create(const fs::path& file) {
  const int number = open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  if (number >= 0) close(number);
  return number >= 0;
}

// Which of its attempts succeed.
std::string attempts(const fs::path& root) {
  std::string done;
  const auto attempt = [&](const char* name, bool succeeds) {
    if (succeeds) done += std::string(name) + " ";
  };
  attempt("scratch", can_create(root / "scratch/file"));
  attempt("null", can_create("/dev/null"));
  attempt("read", std::ifstream(root / "results/file").is_open());
  attempt("create", can_create(root / "results/new"));
  attempt("append", std::ofstream(root / "results/file", std::ios::app).is_open());
  attempt("truncate", truncate((root / "results/file").c_str(), 0) == 0);
  attempt("rename", rename((root / "results/file").c_str(), (root / "results/other").c_str()) == 0);
  attempt("move", rename((root / "results/file").c_str(), (root / "scratch/moved").c_str()) == 0);
  attempt("unlink", unlink((root / "results/file").c_str()) == 0);
  attempt("mkdir", mkdir((root / "results/folder").c_str(), 0700) == 0);
  attempt("rmdir", rmdir((root / "results").c_str()) == 0);
  attempt("chmod", chmod((root / "results").c_str(), 0) == 0);
  attempt("socket", socket(AF_INET, SOCK_STREAM, 0) >= 0);
  attempt("local socket", socket(AF_UNIX, SOCK_STREAM, 0) >= 0);
  return done;
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
  attempt("ring", ENOSYS, syscall(SYS_io_uring_setup, 8, nullptr));
  attempt("limit", EPERM, syscall(SYS_prlimit64, 0, RLIMIT_CORE, std::array<rlim_t, 2>{}.data(), nullptr));
  const std::string parent = "/proc/" + std::to_string(getppid());
  if (landlock::sets_apart(landlock::version())) attempt("memory", EACCES, open((parent + "/mem").c_str(), O_RDWR));
  attempt("terminal", ENXIO, open("/dev/tty", O_RDONLY));
  if (prctl(PR_GET_DUMPABLE) != 0) done += "dumpable ";
  if (fcntl(0, F_GETFD) < 0) done += "no fcntl ";
  return done;
}

// As a kernel without Landlock.
void deny_landlock() {
  sock_filter code[] = {{BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
                        {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, SYS_landlock_create_ruleset},
                        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | ENOSYS},
                        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}};
  const sock_fprog program = {sizeof(code) / sizeof(*code), code};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) _exit(2);
}

}  // namespace

TEST_CASE("in the sandbox a process writes in its scratch folder alone, and opens no socket") {
  const Places places;
  const std::string done = in_child([&] {
    box::demand_sandbox();
    box::enter(false, nullptr, places.root / "scratch");
    return attempts(places.root);
  });
  if (landlock::version() >= 3) CHECK(done == "scratch null read ");
  CHECK(done.find("socket") == std::string::npos);
  CHECK(done.find("chmod") == std::string::npos);
}

TEST_CASE("without a sandbox the box leaves files and sockets alone") {
  const Places places;
  const std::string done = in_child([&] {
    box::enter(false);
    return attempts(places.root);
  });
  CHECK(done == "scratch null read create append truncate rename mkdir chmod socket local socket ");
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
#if defined(__x86_64__)
  CHECK(signal_of([] { syscall(0x40000000 | SYS_getpid); }) == SIGSYS);  // x32's
#endif
  CHECK(box::name_of(SYS_kill) == "kill");
  CHECK(box::name_of(SYS_clone) == "fork (clone)");
  CHECK(box::name_of(9999) == "system call 9999");
}

TEST_CASE("a part of the sandbox that the kernel lacks is named") {
  CHECK(box::sandbox_gaps().empty());  // nobody asked for one
  const std::string gaps = in_child([] {
    deny_landlock();
    box::demand_sandbox();
    return box::sandbox_gaps();
  });
  CHECK(gaps == "plugins can write wherever you can: the kernel has no Landlock, or does not let it be used");
  const Places places;
  const std::string done = in_child([&] {
    deny_landlock();
    box::demand_sandbox();
    box::enter(false, nullptr, places.root / "scratch");
    return attempts(places.root);
  });
  CHECK(done == "scratch null read create append truncate rename mkdir ");

  CHECK(landlock::gap(1).find("version 1, and 3 would") != std::string::npos);
  CHECK(landlock::gap(2).find("can empty files") != std::string::npos);
  CHECK(landlock::gap(3).empty());
}
