// SPDX-License-Identifier: MIT
#include "host/process/memory_group.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "host/errors/machine_error.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view this_process = "0";  // as the kernel's files call the one that writes
constexpr const char* group_of_host = "dmrp-host";
constexpr int removals = 100;  // of a group whose processes were killed, and may need a moment to be gone
constexpr unsigned removal_pause_us = 10'000;

// Async-signal-safe. The kernel takes or refuses the whole text.
bool put(const char* file, std::string_view text) {
  const int descriptor = open(file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool written = write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  close(descriptor);
  errno = reason;
  return written;
}

bool put(const fs::path& file, std::string_view text) {
  return put(file.c_str(), text);
}

bool has_word(const fs::path& file, std::string_view wanted) {
  std::ifstream stream(file);
  for (std::string word; stream >> word;)
    if (word == wanted) return true;
  return false;
}

bool is_alone_in(const fs::path& group) {
  std::ifstream stream(group / "cgroup.procs");
  std::vector<pid_t> processes;
  for (pid_t process = 0; stream >> process;) processes.push_back(process);
  return processes == std::vector<pid_t>{getpid()};
}

// Root may write everywhere: what systemd has not delegated is systemd's.
bool is_delegated(const fs::path& group) {
  if (access((group / "cgroup.procs").c_str(), W_OK) != 0 || access(group.c_str(), W_OK) != 0) return false;
  if (geteuid() != 0 || access("/run/systemd/system", F_OK) != 0) return true;
  return getxattr(group.c_str(), "trusted.delegate", nullptr, 0) > 0 ||
         getxattr(group.c_str(), "user.delegate", nullptr, 0) > 0;
}

// Whether a process has moved itself here to make groups beside.
bool is_of_parent(const fs::path& group) {
  return group.filename() == group_of_host && has_word(group.parent_path() / "cgroup.subtree_control", "memory") &&
         access(group.parent_path().c_str(), W_OK) == 0;
}

fs::path own_group() {
  std::ifstream mounts("/proc/self/mountinfo");
  std::ifstream groups("/proc/self/cgroup");
  return group_folder(mounts, groups);
}

// The groups of this process's children, and its own beside them.
class Groups {
 public:
  Groups() {
    const fs::path around = own_group();
    if (!sanitizer_is_loaded() && is_of_parent(around)) {
      around_ = around.parent_path();
      is_parents_ = true;
      return;
    }
    if (sanitizer_is_loaded() || around.empty() || !has_word(around / "cgroup.controllers", "memory") ||
        !is_delegated(around) || !is_alone_in(around))
      return;
    around_ = around;
    move_below();
  }

  ~Groups() {
    if (around_.empty()) return;
    for (int i = 0; i < removals && !remove_left(); ++i) usleep(removal_pause_us);
    if (!is_parents_) move_back();
  }
  Groups(const Groups&) = delete;
  Groups& operator=(const Groups&) = delete;

  bool usable() const { return !around_.empty(); }

  fs::path add() {
    remove_left();
    fs::path folder = around_ / fmt::format("dmrp-child-{}-{}", getpid(), ++made_);
    if (mkdir(folder.c_str(), 0755) != 0) throw MachineError("mkdir " + folder.string(), errno);
    return folder;
  }

  void remove(const fs::path& folder) {
    left_.push_back(folder);
    remove_left();
  }

 private:
  // Forgets around_ if the kernel refuses a part of it.
  void move_below() {
    if ((mkdir(host().c_str(), 0755) == 0 || errno == EEXIST) && put(host() / "cgroup.procs", this_process) &&
        put(around_ / "cgroup.subtree_control", "+memory"))
      return;
    move_back();
    around_.clear();
  }

  void move_back() const {
    put(around_ / "cgroup.subtree_control", "-memory");
    put(around_ / "cgroup.procs", this_process);
    rmdir(host().c_str());
  }

  // A group that still has processes stays.
  bool remove_left() {
    std::erase_if(left_, [](const fs::path& folder) { return rmdir(folder.c_str()) == 0 || errno == ENOENT; });
    return left_.empty();
  }

  fs::path host() const { return around_ / group_of_host; }

  fs::path around_;  // empty: there can be no groups
  bool is_parents_ = false;
  std::vector<fs::path> left_;
  std::uint64_t made_ = 0;
};

Groups& groups() {
  static Groups all;
  return all;
}

}  // namespace

bool MemoryGroup::available() {
  return groups().usable();
}

std::unique_ptr<MemoryGroup> MemoryGroup::make(std::int64_t memory_mb) {
  if (memory_mb == 0 || !available()) return nullptr;
  std::unique_ptr<MemoryGroup> group(new MemoryGroup(groups().add()));
  const fs::path limit = group->folder_ / "memory.max";
  if (!put(limit, std::to_string(memory_mb << 20))) throw MachineError(limit.string(), errno);
  put(group->folder_ / "memory.swap.max", "0");  // there is none without swap
  put(group->folder_ / "memory.oom.group", "1");
  return group;
}

MemoryGroup::MemoryGroup(fs::path folder) : folder_(std::move(folder)), processes_(folder_ / "cgroup.procs") {}

MemoryGroup::~MemoryGroup() {
  put(folder_ / "cgroup.kill", "1");  // before Linux 5.14, those that adopt orphans kill them
  groups().remove(folder_);
}

bool MemoryGroup::enter() const {
  return put(processes_.c_str(), this_process);
}

void MemoryGroup::take(pid_t process) const {
  if (!put(processes_, std::to_string(process))) throw MachineError(processes_.string(), errno);
}

bool MemoryGroup::has_exceeded_limit() const {
  std::ifstream events(folder_ / "memory.events");
  return tells_of_exceeded_limit(events);
}

fs::path group_folder(std::istream& mounts, std::istream& groups) {
  constexpr std::string_view type = " - cgroup2 ";
  fs::path mounted;
  for (std::string line; std::getline(mounts, line);) {
    if (line.find(type) == std::string::npos) continue;
    std::istringstream fields(line);
    std::string field, root, folder;
    fields >> field >> field >> field >> root >> folder;
    if (root == "/") mounted = folder;
  }
  if (mounted.empty()) return {};
  constexpr std::string_view unified = "0::/";
  for (std::string line; std::getline(groups, line);)
    if (line.starts_with(unified)) return mounted / line.substr(unified.size());
  return {};
}

bool tells_of_exceeded_limit(std::istream& events) {
  // "oom": it was this group that had no more; "oom_kill": killed for whatever group, or for the machine
  std::uint64_t exceeded = 0;
  std::uint64_t killed = 0;
  std::string name;
  for (std::uint64_t count = 0; events >> name >> count;) {
    if (name == "oom") exceeded = count;
    if (name == "oom_kill") killed = count;
  }
  return exceeded > 0 && killed > 0;
}

}  // namespace dmrp::host
