// SPDX-License-Identifier: MIT
// memory_group.hpp: a control group (cgroup v2) in which a child lives with all processes that it starts. The kernel counts
// all their memory, shared memory too, and kills them all when it exceeds the limit.
//
// A group is made within the one that dmrp-host was started in, if that is the host's own: delegated to the user, as by
// `systemd-run --user --scope -p Delegate=yes`, and with no other process in it. Only groups without processes of their own
// may limit those below, so the host moves into a group beside its children's, and back as it ends. Where the host is
// killed, its groups are empty, and whoever made the one around them removes them; systemd does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>

namespace dmrp::host {

class MemoryGroup {
 public:
  // Whether this process can make groups: below its own, or beside it where its parent has made them (a worker's guests).
  // Under sanitizers it makes none.
  static bool available();

  // A new group; none without a limit (0), or where there can be none. Throws MachineError.
  static std::unique_ptr<MemoryGroup> make(std::int64_t memory_mb);

  // Kills what is in the group, and removes it.
  ~MemoryGroup();
  MemoryGroup(const MemoryGroup&) = delete;
  MemoryGroup& operator=(const MemoryGroup&) = delete;

  // Moves the process that calls into the group. Async-signal-safe. False on failure.
  bool enter() const;

  // Moves another process into the group. Throws MachineError.
  void take(pid_t process) const;

  // Whether a process was killed because the group had exceeded its own limit, not because the machine had no memory left.
  bool has_exceeded_limit() const;

 private:
  explicit MemoryGroup(std::filesystem::path folder);

  const std::filesystem::path folder_;
  const std::filesystem::path processes_;  // the file to enter by
};

// The folder of a process's group, from its mounts (/proc/self/mountinfo) and groups (/proc/self/cgroup). Empty where the
// machine has no cgroup v2, or mounts a part of it.
std::filesystem::path group_folder(std::istream& mounts, std::istream& groups);

// Whether the text of memory.events says what has_exceeded_limit() asks.
bool tells_of_exceeded_limit(std::istream& events);

}  // namespace dmrp::host
