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

// What headers of older kernels lack.
struct RulesetAttributes {
  std::uint64_t handled_access_fs;
  std::uint64_t handled_access_net;
  std::uint64_t scoped;
};
constexpr std::uint64_t truncate_access = 1ull << 14;
constexpr std::uint64_t scopes = 3;  // abstract sockets and signals

constexpr int first_with_moves = 2;  // between folders; without it they are always refused
constexpr int first_with_truncation = 3;
constexpr int first_with_scopes = 6;

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

Descriptor make_rules(std::uint64_t accesses, int version) {
  const RulesetAttributes attributes = {accesses, 0, version >= first_with_scopes ? scopes : 0};
  Descriptor rules(static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0)));
  if (!rules.is_open()) throw MachineError("Landlock", errno);
  return rules;
}

void allow(const Descriptor& rules, const std::filesystem::path& path, std::uint64_t accesses) {
  const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
  const landlock_path_beneath_attr rule = {accesses, place.number()};
  if (!place.is_open() || syscall(SYS_landlock_add_rule, rules.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) != 0)
    throw MachineError("Landlock: " + path.string(), errno);
}

void obey(const Descriptor& rules) {
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (syscall(SYS_landlock_restrict_self, rules.number(), 0) != 0) throw MachineError("Landlock", errno);
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

bool sets_apart(int version) {
  return version >= first_with_moves;
}

void set_apart() {
  const int found = version();
  if (!sets_apart(found)) return;
  // rules must be about something: where there are no scopes, they are about moves between folders, and allow them
  const std::uint64_t moves = found < first_with_scopes ? LANDLOCK_ACCESS_FS_REFER : 0;
  const Descriptor rules = make_rules(moves, found);
  if (moves != 0) allow(rules, "/", moves);
  obey(rules);
}

void restrict_writing(const std::filesystem::path& folder) {
  const int found = version();
  if (found == 0) return;
  const std::uint64_t writing = known(folder_writing, found);
  const Descriptor rules = make_rules(writing, found);
  if (!folder.empty()) allow(rules, folder, writing);
  allow(rules, "/dev/null", known(file_writing, found) & ~std::uint64_t{LANDLOCK_ACCESS_FS_REFER});
  obey(rules);
}

}  // namespace dmrp::host::landlock
