// SPDX-License-Identifier: MIT
#include "host/results/machine.hpp"

#include <catch2/catch.hpp>

namespace machine_test {

using namespace dmrp::host;

TEST_CASE("the level of a CPU is the highest whose features are all present", "[results]") {
  const std::string v2 = "cx16 lahf_lm popcnt pni sse4_1 sse4_2 ssse3";
  const std::string v3 = v2 + " avx avx2 bmi1 bmi2 f16c fma abm movbe";
  const auto level = [](const std::string& flags) {
    return x86_64_level_of(cpu_features_of("processor\t: 0\nflags\t\t: " + flags + "\nbugs\t\t: some\n"));
  };
  CHECK(level("fpu sse sse2") == "x86-64-v1");
  CHECK(level(v2) == "x86-64-v2");
  CHECK(level(v3) == "x86-64-v3");
  CHECK(level(v3 + " avx512f") == "x86-64-v3");
  CHECK(level(v3 + " avx512f avx512bw avx512cd avx512dq avx512vl") == "x86-64-v4");
  CHECK(cpu_features_of("Features\t: fp asimd\n") == std::vector<std::string>{"asimd", "fp"});
}

}  // namespace machine_test
