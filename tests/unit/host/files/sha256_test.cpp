// SPDX-License-Identifier: MIT
#include "host/files/sha256.hpp"

#include <catch2/catch.hpp>

#include "host/files/atomic_file.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace sha256_test {

using namespace dmrp::host;
using dmrp::test::ScratchFolder;

TEST_CASE("SHA-256", "[files]") {
  // FIPS 180-4's examples
  CHECK(sha256_of_bytes("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of_bytes("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const ScratchFolder folder;
  const std::string large(1'000'000, 'a');
  write_file_atomically(folder / "large", large);
  CHECK(sha256_of_file(folder / "large") == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK_THROWS_AS(sha256_of_file(folder / "none"), std::system_error);
}

}  // namespace sha256_test
