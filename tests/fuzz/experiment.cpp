// SPDX-License-Identifier: MIT
// Experiment files: one that is accepted has an effective form that means the same.
#include <cstdio>
#include <cstdlib>

#include "host/errors/input_error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dmrp;
  static const test::ExperimentFolder folder;
  host::Experiment experiment;
  try {
    experiment = test::load(std::string(fuzz::text(data, size)));
  } catch (const host::InputError&) {
    return 0;
  }
  const std::string effective = host::effective_toml(experiment);
  if (host::effective_toml(test::load(effective)) == effective) return 0;
  std::fputs(effective.c_str(), stderr);
  std::abort();
}
