// SPDX-License-Identifier: MIT
// What a process with a view of its own sees, and its environment. Each case tries it in a child.
#include "host/process/view.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host/process/environment.hpp"
#include "host/process/orphans.hpp"

namespace view_test {

namespace fs = std::filesystem;
using namespace dmrp::host;

// A folder with what is shown, and what is not.
class Places {
 public:
  Places() {
    std::string name = (fs::temp_directory_path() / "dmrp_view_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    root = name;
    for (const char* folder : {"shown", "hidden"}) fs::create_directory(root / folder);
    for (const char* file : {"beside", "experiment.toml", "shown/file", "hidden/file", "hidden/library"})
      std::ofstream(root / file) << "text";
    fs::create_symlink(root / "hidden/library", root / "link");
  }
  ~Places() { fs::remove_all(root); }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  std::vector<std::string> shown() const { return {root / "shown", root / "link", root / "shown/file", "/none"}; }

  fs::path root;
};

// The text that `function` returns in the second process of a view with these places.
template <class Function>
std::string in_view(const std::vector<std::string>& visible, Function function) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const auto say = [&](const std::string& text) {
    _exit(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 1);
  };
  const pid_t child = fork();
  if (child == 0) {
    view::leave(visible);
    const pid_t first = fork();
    if (first == 0)
      for (;;) pause();
    const pid_t second = fork();
    if (second == 0) say(function());
    waitpid(second, nullptr, 0);
    kill(first, SIGKILL);
    waitpid(first, nullptr, 0);
    _exit(0);
  }
  close(ends[1]);
  std::string all(4096, '\0');
  const ssize_t count = read(ends[0], all.data(), all.size());
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  return all.substr(0, count > 0 ? static_cast<std::size_t>(count) : 0);
}

bool can_write(const fs::path& file) {
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
  attempt("read", std::ifstream(root / "shown/file").is_open());
  attempt("read by link", std::ifstream(root / "link").is_open());
  attempt("temporary", can_write("/tmp/file"));
  attempt("null", can_write("/dev/null"));
  attempt("program", access("/bin/sh", X_OK) == 0);
  attempt("hidden", fs::exists(root / "hidden"));
  attempt("home", fs::exists("/home") || fs::exists("/root") || fs::exists("/etc/passwd"));
  attempt("processors", std::ifstream("/proc/cpuinfo").peek() != EOF && fs::exists("/sys/devices/system/cpu/present"));
  attempt("more of the machine", fs::exists("/proc/self") || fs::exists("/proc/1") || fs::exists("/sys/class"));
  attempt("change processors", can_write("/sys/devices/system/cpu/cpu1/online"));
  attempt("old", fs::exists("/old"));
  attempt("create", can_write(root / "shown/new"));
  attempt("change", can_write(root / "shown/file"));
  attempt("create in root", can_write("/new"));
  attempt("chmod", chmod((root / "shown/file").c_str(), 0600) == 0);
  attempt("remount", mount(nullptr, "/usr", nullptr, MS_BIND | MS_REMOUNT, nullptr) == 0);
  attempt("unmount", umount2("/tmp", MNT_DETACH) == 0);
  attempt("signal", kill(3, 0) == 0);
  attempt("slow", setpriority(PRIO_PROCESS, 3, 19) == 0);
  return done;
}

// More than fits: the kernel says that the disk is full.
std::string fill() {
  const int file = open("/tmp/much", O_WRONLY | O_CREAT, 0600);
  const std::string piece(1 << 20, 'x');
  int pieces = 0;
  while (write(file, piece.data(), piece.size()) == static_cast<ssize_t>(piece.size())) ++pieces;
  return errno == ENOSPC && pieces < 100 ? "full" : std::to_string(pieces);
}

TEST_CASE("a process sees what it was given, and can change nothing but temporary files") {
  if (!view::gap().empty()) return;
  const Places places;
  CHECK(in_view(places.shown(), [&] { return attempts(places.root); }) ==
        "read read by link temporary null program processors ");
  CHECK(in_view({}, [&] { return attempts(places.root); }) == "temporary null program processors ");
  // the files of a folder, and one of a subfolder
  CHECK(in_view({places.root / view::all_files, places.root / "hidden/file"}, [&] {
          std::string seen;
          for (const char* name : {"beside", "experiment.toml", "hidden/file", "hidden/library", "shown/file"})
            if (std::ifstream file(places.root / name); file.peek() != EOF) seen += std::string(name) + " ";
          return seen;
        }) == "beside hidden/file ");
  CHECK(in_view({places.root / view::all_files, places.root / "experiment.toml"}, [&] {
          return std::string(std::ifstream(places.root / "experiment.toml").peek() == EOF ? "empty" : "text");
        }) == "text");
  CHECK(in_view({}, &fill) == "full");
  CHECK(in_view({"/tmp", "/tmp/*", "/"}, [&] { return attempts(places.root); }) ==
        "temporary null program processors ");
  CHECK(in_view({}, [] { return std::to_string(getpid()) + " " + fs::current_path().string(); }) == "2 /tmp");
  CHECK(fs::exists(places.root / "hidden/file"));
}

TEST_CASE("orphans of a namespace are killed, its first process among them") {
  if (!view::gap().empty()) return;
  const pid_t judge = fork();
  if (judge == 0) {
    adopt_orphans();
    const pid_t between = fork();
    if (between == 0) {
      view::leave({});
      for (int i = 0; i < 2; ++i)
        if (fork() == 0)
          for (;;) pause();
      _exit(0);
    }
    waitpid(between, nullptr, 0);
    alarm(20);  // it used to wait for the first one for ever
    kill_orphans({});
    _exit(waitpid(-1, nullptr, 0) < 0 && errno == ECHILD ? 0 : 1);
  }
  int status = 0;
  waitpid(judge, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("a kernel without namespaces is asked once") {
  setenv("DMRP_VIEW", "namespaces: unshare: Operation not permitted", 1);
  CHECK(view::gap() == "namespaces: unshare: Operation not permitted");
  setenv("DMRP_VIEW", "whole", 1);
  CHECK(view::gap().empty());
  unsetenv("DMRP_VIEW");
}

TEST_CASE("plugins have few environment variables, which do not depend on the user") {
  setenv("OMP_NUM_THREADS", "2", 1);
  setenv("DMRP_TEST_WORD", "a=b", 1);
  setenv("DMRP_PLUGIN_PATH", "/none", 1);
  const std::vector<std::string> passed = passed_environment();
  CHECK(passed == std::vector<std::string>{"DMRP_TEST_WORD=a=b", "OMP_NUM_THREADS=2"});
  const pid_t child = fork();
  if (child == 0) {
    reduce_environment("/scratch");
    std::vector<std::string> all;
    for (char** variable = environ; *variable; ++variable) all.emplace_back(*variable);
    const std::vector<std::string> expected = {
        "DMRP_TEST_WORD=a=b", "OMP_NUM_THREADS=2", "PATH=/usr/local/bin:/usr/bin:/bin",
        "LANG=C.UTF-8",       "HOME=/scratch",     "TMPDIR=/scratch"};
    _exit(all == expected ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  for (const char* name : {"OMP_NUM_THREADS", "DMRP_TEST_WORD", "DMRP_PLUGIN_PATH"}) unsetenv(name);
}

}  // namespace view_test
