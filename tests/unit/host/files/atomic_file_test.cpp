// SPDX-License-Identifier: MIT
#include "host/files/atomic_file.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "tests/unit/host/results/results_example.hpp"

using namespace dmrp::host;
using dmrp::test::content_of;
using dmrp::test::ScratchFolder;

TEST_CASE("files are replaced atomically, with default permissions", "[files]") {
  const ScratchFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  write_file_atomically(folder / "a.txt", "new");
  CHECK(content_of(folder / "a.txt") == "new");
  const auto entries = std::filesystem::directory_iterator(folder.path());
  CHECK(std::distance(begin(entries), end(entries)) == 1);  // nothing lies beside it
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat status {};
  REQUIRE(::stat((folder / "a.txt").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777u) == (0666u & ~mask));
  CHECK_THROWS_WITH(write_file_atomically(folder / "no/folder.txt", "x"), Catch::Contains("no/folder.txt"));
}
