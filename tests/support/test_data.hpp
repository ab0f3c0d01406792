// SPDX-License-Identifier: MIT
// The folder with data of others (public maps and scenarios), which is no part of the project.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace dmrp::test {

// The environment's DMRP_TEST_DATA, else the one CMake was configured with. A test case that needs it skips
// without it, with a message, so that CTest says SKIPPED:
//   const auto data = dmrp::test::test_data();
//   if (!data) { WARN("skipped: DMRP_TEST_DATA is not set"); return; }
inline std::optional<std::filesystem::path> test_data() {
  const char* from_environment = std::getenv("DMRP_TEST_DATA");
  const std::filesystem::path folder = from_environment ? from_environment : DMRP_TEST_DATA;
  if (folder.empty() || !std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

}  // namespace dmrp::test
