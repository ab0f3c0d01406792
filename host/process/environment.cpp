// SPDX-License-Identifier: MIT
#include "host/process/environment.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace dmrp::host {

namespace {

constexpr std::string_view prefix_for_tests = "DMRP_TEST_";
constexpr std::array<std::string_view, 6> passed = {"AMENT_PREFIX_PATH=",    "MKL_NUM_THREADS=", "OMP_NUM_THREADS=",
                                                    "OPENBLAS_NUM_THREADS=", "PYTHONHOME=",      "PYTHONPATH="};

bool is_passed(std::string_view variable) {
  return variable.starts_with(prefix_for_tests) ||
         std::any_of(passed.begin(), passed.end(), [&](std::string_view name) { return variable.starts_with(name); });
}

}  // namespace

std::vector<std::string> passed_environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; variable && *variable; ++variable)
    if (is_passed(*variable)) variables.emplace_back(*variable);
  std::sort(variables.begin(), variables.end());
  return variables;
}

void reduce_environment(const std::string& scratch) {
  const std::vector<std::string> variables = passed_environment();
  clearenv();
  for (const std::string& variable : variables) {
    const std::size_t end = variable.find('=');
    setenv(variable.substr(0, end).c_str(), variable.c_str() + end + 1, 1);
  }
  setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 1);
  setenv("LANG", "C.UTF-8", 1);
  for (const char* const folder : {"HOME", "TMPDIR"}) setenv(folder, scratch.empty() ? "/tmp" : scratch.c_str(), 1);
}

}  // namespace dmrp::host
