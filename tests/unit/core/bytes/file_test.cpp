// SPDX-License-Identifier: MIT
#include "core/bytes/file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <system_error>

namespace file_test {

using namespace dmrp::core;

namespace fs = std::filesystem;

// A folder with a file, and a link to it, a pipe and a folder beside it.
class Planted {
 public:
  Planted() {
    fs::remove_all(root);
    fs::create_directories(root / "folder");
    std::ofstream(root / "file") << "kept";
    fs::create_symlink(root / "file", root / "link");
    REQUIRE(mkfifo((root / "pipe").c_str(), 0600) == 0);
  }
  ~Planted() { fs::remove_all(root); }
  Planted(const Planted&) = delete;
  Planted& operator=(const Planted&) = delete;

  std::string content(const char* name) const {
    std::string text;
    std::ifstream(root / name) >> text;
    return text;
  }

  const fs::path root = fs::temp_directory_path() / ("dmrp_file_" + std::to_string(getpid()));
};

TEST_CASE("a new file takes the place of what has its name") {
  const Planted planted;
  for (const char* name : {"link", "pipe", "folder", "none"}) {
    INFO(name);
    std::fputs("new", create_file(planted.root / name).get());
    CHECK(fs::is_regular_file(fs::symlink_status(planted.root / name)));
    CHECK(planted.content(name) == "new");
  }
  CHECK(planted.content("file") == "kept");
  CHECK_THROWS_AS(create_file(planted.root / "no/folder"), std::system_error);
}

TEST_CASE("what is no regular file is not opened, and not waited for") {
  const Planted planted;
  for (const Links links : {Links::followed, Links::refused}) {
    CHECK(std::fgetc(open_file(planted.root / "file", links).get()) == 'k');
    CHECK_THROWS_WITH(open_file(planted.root / "pipe", links), Catch::Contains("pipe: is no regular file"));
    CHECK_THROWS_WITH(open_file(planted.root / "folder", links), Catch::Contains("folder: is no regular file"));
    CHECK_THROWS_WITH(open_file(planted.root / "none", links), Catch::Contains("No such file"));
  }
  CHECK(std::fgetc(open_file(planted.root / "link", Links::followed).get()) == 'k');
  CHECK_THROWS_WITH(open_file(planted.root / "link", Links::refused), Catch::Contains("link: is no regular file"));
}

}  // namespace file_test
