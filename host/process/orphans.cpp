// SPDX-License-Identifier: MIT
#include "host/process/orphans.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

namespace dmrp::host {

namespace {

constexpr int most_rounds = 50'000;  // an orphan can start others while it is being killed

}  // namespace

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> found;
  std::error_code gone;  // the process can end at any time
  std::filesystem::directory_iterator thread("/proc/" + std::to_string(process) + "/task", gone);
  for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
    std::ifstream file(thread->path() / "children");
    for (pid_t child = 0; file >> child;) found.push_back(child);
  }
  return found;
}

void adopt_orphans() {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void kill_orphans(const std::vector<pid_t>& keep) {
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<pid_t> orphans = children_of(getpid());
    std::erase_if(orphans, [&](pid_t child) { return std::find(keep.begin(), keep.end(), child) != keep.end(); });
    if (orphans.empty()) return;
    for (const pid_t orphan : orphans) kill(orphan, SIGKILL);
    // for none in particular: the first process of a namespace ends only when the others have been waited for, and these
    // may become children later
    for (const pid_t orphan : orphans) waitpid(orphan, nullptr, WNOHANG | __WALL);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace dmrp::host
