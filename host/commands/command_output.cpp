// SPDX-License-Identifier: MIT
#include "host/commands/command_output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <set>
#include <system_error>

#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/experiment/experiment.hpp"
#include "host/files/atomic_file.hpp"
#include "host/terminal/colors.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

std::string plural(std::uint64_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string map_lines(const Experiment& experiment) {
  std::string lines = experiment.chosen_cells.empty() ? "" : experiment.chosen_cells + "\n";
  std::set<std::string> seen;
  for (const ScenarioVariant& variant : experiment.scenarios)
    if (variant.census && seen.insert(variant.file.string()).second)
      lines += fmt::format("{}: {}\n", variant.census->file, census_text(*variant.census));
  return lines;
}

void warn(const std::string& text) {
  fmt::print(stderr, "{} {}\n", colored("warning:", TextColor::yellow, has_colors(STDERR_FILENO)), text);
}

void check_output_file(const char* option, const fs::path& file) {
  if (file.empty()) return;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw InputError(fmt::format("{} {}: there is no folder {}", option, file.string(), folder.string()));
  if (fs::is_directory(file, ignored)) throw InputError(fmt::format("{} {}: is a folder", option, file.string()));
}

void write_output(const char* option, const fs::path& file, std::string_view content) {
  if (file.empty()) {
    if (std::fwrite(content.data(), 1, content.size(), stdout) != content.size())
      throw MachineError("standard output", errno);
    return;
  }
  try {
    write_named_file(file, content);
  } catch (const std::system_error& error) {
    throw_path_error(fmt::format("{} {}", option, file.string()), error.code());
  }
}

}  // namespace dmrp::host
