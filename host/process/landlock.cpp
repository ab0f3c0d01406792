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
constexpr std::uint64_t scopes = 3;  // abstract sockets and signals

constexpr int first_with_moves = 2;  // between folders; without it they are always refused
constexpr int first_with_scopes = 6;

void require(bool succeeded) {
  if (!succeeded) throw MachineError("Landlock", errno);
}

}  // namespace

int version() {
  const long found = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return found < 0 ? 0 : static_cast<int>(found);
}

bool sets_apart(int version) {
  return version >= first_with_moves;
}

void set_apart() {
  const int found = version();
  if (!sets_apart(found)) return;
  // rules must be about something: where there are no scopes, they are about moves between folders, and allow them
  const bool has_scopes = found >= first_with_scopes;
  const RulesetAttributes attributes = {has_scopes ? 0 : LANDLOCK_ACCESS_FS_REFER, 0, has_scopes ? scopes : 0};
  const Descriptor rules(static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0)));
  require(rules.is_open());
  if (!has_scopes) {
    const Descriptor root(open("/", O_PATH | O_CLOEXEC));
    const landlock_path_beneath_attr rule = {LANDLOCK_ACCESS_FS_REFER, root.number()};
    require(syscall(SYS_landlock_add_rule, rules.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0);
  }
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  require(syscall(SYS_landlock_restrict_self, rules.number(), 0) == 0);
}

}  // namespace dmrp::host::landlock
