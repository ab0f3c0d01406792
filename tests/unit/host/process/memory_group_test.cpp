// SPDX-License-Identifier: MIT
#include "host/process/memory_group.hpp"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>

using namespace dmrp::host;

namespace {

std::string folder(const std::string& mounts, const std::string& groups) {
  std::istringstream of_mounts(mounts);
  std::istringstream of_groups(groups);
  return group_folder(of_mounts, of_groups).string();
}

bool exceeded(const std::string& text) {
  std::istringstream events(text);
  return tells_of_exceeded_limit(events);
}

}  // namespace

TEST_CASE("the folder of a process's group is found where cgroup v2 is mounted") {
  const std::string mount = "28 1 0:25 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
  CHECK(folder("21 1 0:19 / /sys rw - sysfs sysfs rw\n" + mount, "0::/user.slice/run-1.scope\n") ==
        "/sys/fs/cgroup/user.slice/run-1.scope");
  CHECK(folder(mount, "4:memory:/old\n0::/new\n") == "/sys/fs/cgroup/new");
  CHECK(folder("", "0::/new\n") == "");
  CHECK(folder(mount, "4:memory:/old\n") == "");
  // a part of the tree: the paths of groups do not begin there
  CHECK(folder("28 1 0:25 /box /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n", "0::/box/new\n") == "");
  CHECK(folder("28 1 0:25 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n", "0::/new\n") == "");
}

TEST_CASE("a group has exceeded its limit if it had no more memory, and a process was killed for that") {
  CHECK(exceeded("low 0\nhigh 0\nmax 31\noom 1\noom_kill 1\noom_group_kill 1\n"));
  CHECK_FALSE(exceeded("low 0\nhigh 0\nmax 31\noom 0\noom_kill 0\n"));
  CHECK_FALSE(exceeded("low 0\nhigh 0\nmax 0\noom 0\noom_kill 1\n"));  // the machine had no more
  CHECK_FALSE(exceeded(""));
}
