// SPDX-License-Identifier: MIT
// answers LIBRARY: prints all numbers that each plugin of the library gives on the stage of `dmrp-host check`, in a trial
// of its own: plans, commands, velocities, values, statuses.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "host/check/examination.hpp"

namespace {

using namespace dmrp::host;

void print_answers(const std::filesystem::path& file, const PluginInfo& info) {
  CallNote note{};
  Examination examination(file, &info, 1, note, [](const std::string&) {});
  const Outputs outputs = alone(examination, 1);
  fmt::print("{} {}\n", info.id, outputs.size());
  constexpr std::size_t in_a_line = 5;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    fmt::print(" {:.17g}{}", outputs[i], (i + 1) % in_a_line == 0 || i + 1 == outputs.size() ? "\n" : "");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const Library library(argv[1]);
    for (const PluginInfo& info : library.plugins()) print_answers(library.file(), info);
  } catch (const PluginFault& fault) {
    fmt::print(stderr, "{}\n", fault.text());
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[1], error.what());
    return 1;
  }
}
