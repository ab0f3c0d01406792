// SPDX-License-Identifier: MIT
// Scenario files, and the checks of a whole experiment on what they say.
#include "host/errors/input_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  fuzz::write_file("hall/scenario.toml", fuzz::text(data, size));
  try {
    test::load();
  } catch (const host::InputError&) {
  }
  return 0;
}
