// SPDX-License-Identifier: MIT
#include "host/errors/machine_error.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "host/errors/input_error.hpp"

using namespace dmrp::host;

namespace {

bool fails_by_machine(int error_number) {
  return is_machine_failure(std::system_error(error_number, std::generic_category(), "file"));
}

}  // namespace

TEST_CASE("a full disk, an I/O error and a lack of memory or processes are failures of the machine") {
  for (const int number : {ENOSPC, EDQUOT, EFBIG, EIO, ENOMEM, EMFILE, ENFILE, EAGAIN}) CHECK(fails_by_machine(number));
  CHECK(is_machine_failure(std::bad_alloc()));
  CHECK(is_machine_failure(MachineError("full")));
  const std::filesystem::filesystem_error full("file", std::make_error_code(std::errc::no_space_on_device));
  CHECK(is_machine_failure(full));
}

TEST_CASE("a path that cannot be used is the user's mistake, as any other input") {
  for (const int number : {ENOENT, EACCES, EPERM, ENOTDIR, EISDIR, EROFS, ENAMETOOLONG})
    CHECK_FALSE(fails_by_machine(number));
  CHECK_FALSE(is_machine_failure(InputError("bad")));
  CHECK_FALSE(is_machine_failure(std::runtime_error("bad")));
}

TEST_CASE("error texts are one line") {
  CHECK(MachineError("log.txt", ENOSPC).what() == std::string("log.txt: No space left on device"));
  CHECK(MachineError("a\nb").what() == std::string("a b"));
  CHECK(error_text(std::runtime_error("a\nb")) == "a b");
  CHECK(error_text(std::bad_alloc()) == "out of memory");
}
