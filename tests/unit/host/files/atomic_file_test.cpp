// SPDX-License-Identifier: MIT
#include "host/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "tests/unit/host/results/results_example.hpp"

namespace atomic_file_test {

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

TEST_CASE("what is no file is replaced, not written into", "[files]") {
  const ScratchFolder folder;
  write_file_atomically(folder / "target", "kept");
  std::filesystem::create_symlink(folder / "target", folder / "link");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const char* name : {"link", "pipe"}) {
    write_file_atomically(folder / name, "new");
    CHECK(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / name)));
    CHECK(content_of(folder / name) == "new");
  }
  CHECK(content_of(folder / "target") == "kept");
}

TEST_CASE("a pipe, a link and a device that the user names stay what they are, and get the content", "[files]") {
  namespace fs = std::filesystem;
  const ScratchFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  const auto is_read = [reader](const std::string& expected) {
    std::string got(100, ' ');
    const ssize_t size = ::read(reader, got.data(), got.size());
    return size >= 0 && got.substr(0, static_cast<std::size_t>(size)) == expected;
  };
  write_named_file(pipe, "written");
  CHECK(fs::is_fifo(pipe));
  CHECK(is_read("written"));
  ::close(reader);

  write_file_atomically(folder / "target", "a longer text");
  fs::create_symlink(folder / "target", folder / "link");
  write_named_file(folder / "link", "short");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(content_of(folder / "target") == "short");
  fs::create_symlink("/dev/full", folder / "full");
  CHECK_THROWS_WITH(write_named_file(folder / "full", "x"), Catch::Contains("full: No space left"));
  CHECK(fs::is_symlink(folder / "full"));
  CHECK_THROWS_WITH(write_named_file(folder.path(), "x"), Catch::Contains("Is a directory"));
}

}  // namespace atomic_file_test
