// SPDX-License-Identifier: MIT
#include "host/errors/machine_error.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "host/errors/input_error.hpp"

namespace machine_error_test {

using namespace dmrp::host;

TEST_CASE("errors of the operating system and a lack of memory are failures of the machine") {
  CHECK(is_machine_failure(MachineError("full")));
  CHECK(is_machine_failure(std::bad_alloc()));
  const auto full = std::make_error_code(std::errc::no_space_on_device);
  CHECK(is_machine_failure(std::system_error(full, "file")));
  CHECK(is_machine_failure(std::filesystem::filesystem_error("file", full)));
  CHECK_FALSE(is_machine_failure(InputError("bad")));
  CHECK_FALSE(is_machine_failure(std::runtime_error("bad")));
}

TEST_CASE("a path that cannot be used is the user's to correct, a full disk is not") {
  for (const int number : {ENOENT, EACCES, EPERM, ENOTDIR, EISDIR, EROFS, ENAMETOOLONG})
    CHECK_THROWS_AS(throw_path_error("file", {number, std::generic_category()}), InputError);
  for (const int number : {ENOSPC, EDQUOT, EFBIG, EIO, ENOMEM, EMFILE, ENFILE})
    CHECK_THROWS_AS(throw_path_error("file", {number, std::generic_category()}), MachineError);
  CHECK_THROWS_WITH(throw_path_error("--csv a.csv", {ENOENT, std::generic_category()}),
                    "--csv a.csv: No such file or directory");
}

TEST_CASE("error texts are one line") {
  CHECK(MachineError("log.txt", ENOSPC).what() == std::string("log.txt: No space left on device"));
  CHECK(MachineError("a\nb").what() == std::string("a b"));
  CHECK(error_text(std::runtime_error("a\nb")) == "a b");
  CHECK(error_text(std::bad_alloc()) == "out of memory");
}

}  // namespace machine_error_test
