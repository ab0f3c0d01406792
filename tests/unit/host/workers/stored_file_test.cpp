// SPDX-License-Identifier: MIT
// The supervisor takes a trace from a folder in which plugins can have done anything.
#include "host/workers/stored_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <system_error>

#include "host/workers/scratch_folder.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace stored_file_test {

namespace fs = std::filesystem;
using namespace dmrp::host;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

TEST_CASE("a trace takes the place of an older one") {
  const dmrp::test::ScratchFolder folder;
  write(folder / "written", "new");
  write(folder / "stored", "old");
  CHECK(store_file(folder / "written", folder / "stored", [] {}));
  CHECK(dmrp::test::content_of(folder / "stored") == "new");
  CHECK_FALSE(fs::exists(folder / "written"));
}

TEST_CASE("what is no file is no trace") {
  const dmrp::test::ScratchFolder folder;
  write(folder / "secret", "of the user");
  write(folder / "stored", "old");
  CHECK_FALSE(store_file(folder / "missing", folder / "stored", [] {}));
  fs::create_symlink(folder / "secret", folder / "link");
  CHECK_FALSE(store_file(folder / "link", folder / "stored", [] {}));
  fs::create_directory(folder / "directory");
  CHECK_FALSE(store_file(folder / "directory", folder / "stored", [] {}));
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_FALSE(store_file(folder / "pipe", folder / "stored", [] {}));
  CHECK(dmrp::test::content_of(folder / "stored") == "old");
}

TEST_CASE("a folder that is gone is the machine's failure") {
  const dmrp::test::ScratchFolder folder;
  write(folder / "written", "new");
  CHECK_THROWS_AS(store_file(folder / "written", folder / "none" / "stored", [] {}), std::system_error);
}

TEST_CASE("a folder that is deleted meanwhile is made again") {
  const dmrp::test::ScratchFolder folder;
  write(folder / "written", "new");
  const auto make_folder = [&] { fs::create_directory(folder / "traces"); };
  CHECK(store_file(folder / "written", folder / "traces" / "stored", make_folder));
  CHECK(dmrp::test::content_of(folder / "traces" / "stored") == "new");
}

TEST_CASE("scratch folders are apart, can be made again and leave nothing") {
  const dmrp::test::ScratchFolder folder;
  {
    const ScratchFolder one(folder / ".");
    const ScratchFolder other(folder / ".");
    CHECK(one.path() != other.path());
    CHECK(one.path().is_absolute());
    write(one.path() / "file", "text");
    fs::remove_all(other.path().parent_path());
    other.restore();
    CHECK(fs::is_directory(other.path()));
  }
  delete_scratch_folders(folder / ".");
  CHECK(fs::is_empty(folder / "."));
}

}  // namespace stored_file_test
