// SPDX-License-Identifier: MIT
#include "host/process/landlock.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "host/errors/machine_error.hpp"
#include "host/process/descriptor.hpp"

namespace dmrp::host::landlock {

namespace {

// Headers of older kernels have no name for it.
constexpr std::uint64_t truncate_access = 1ull << 14;
constexpr int first_with_moves = 2;  // between folders; without it they are always refused
constexpr int first_with_truncation = 3;

constexpr std::uint64_t file_writing = LANDLOCK_ACCESS_FS_WRITE_FILE;
constexpr std::uint64_t folder_writing =
    file_writing | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

// What this version knows of `accesses`, moves and truncation.
std::uint64_t known(std::uint64_t accesses, int version) {
  if (version >= first_with_moves) accesses |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= first_with_truncation) accesses |= truncate_access;
  return accesses;
}

void allow(const Descriptor& rules, const std::filesystem::path& path, std::uint64_t accesses) {
  const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
  const landlock_path_beneath_attr rule = {accesses, place.number()};
  if (!place.is_open() || syscall(SYS_landlock_add_rule, rules.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) != 0)
    throw MachineError("Landlock: " + path.string(), errno);
}

}  // namespace

int version() {
  const long found = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return found < 0 ? 0 : static_cast<int>(found);
}

std::string gap(int version) {
  if (version == 0) return "plugins can write wherever you can: the kernel has no Landlock, or does not let it be used";
  if (version < first_with_truncation)
    return "plugins can empty files that you can write to: the kernel's Landlock is of version " +
           std::to_string(version) + ", and 3 would refuse that";
  return "";
}

void restrict_writing(const std::filesystem::path& folder) {
  const int found = version();
  if (found == 0) return;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = known(folder_writing, found);
  const Descriptor rules(static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0)));
  if (!rules.is_open()) throw MachineError("Landlock", errno);
  if (!folder.empty()) allow(rules, folder, attributes.handled_access_fs);
  allow(rules, "/dev/null", known(file_writing, found) & ~std::uint64_t{LANDLOCK_ACCESS_FS_REFER});
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (syscall(SYS_landlock_restrict_self, rules.number(), 0) != 0) throw MachineError("Landlock", errno);
}

}  // namespace dmrp::host::landlock
