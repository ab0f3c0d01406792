// SPDX-License-Identifier: MIT
#include "host/commands/command.hpp"

#include <algorithm>
#include <sstream>
#include <thread>

namespace dmrp::host {

std::string help_footer(const std::string& example) {
  return "Example:\n  " + example +
         "\n\n"
         "Exit status: 0 done; 1 a trial ended in a fault, or check, verify or compare\n"
         "--fail-if found something; 2 bad input; 3 the machine failed (full disk, no\n"
         "memory); 4 compare --fail-if: the trials cannot decide; 130 interrupted.";
}

void finish_command(CLI::App* command, const std::string& example, std::function<int()> run) {
  command->footer(help_footer(example));
  command->callback([run = std::move(run)] { throw CLI::RuntimeError(run()); });
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  constexpr std::size_t width = 80;
  std::istringstream lines(CLI::Formatter::make_help(app, std::move(name), mode));
  std::string help;
  for (std::string line; std::getline(lines, line);) {
    // where the text of an option begins; options of a group are indented by two more
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::string indent(begin > 0 && begin < get_column_width() ? get_column_width() + begin - 2 : begin, ' ');
    while (line.size() > width) {
      const std::size_t space = line.rfind(' ', width);
      if (space == std::string::npos || line.find_first_not_of(' ') > space) break;  // one long word
      help += line.substr(0, space) + "\n";
      line = indent + line.substr(space + 1);
    }
    help += line + "\n";
  }
  return help;
}

unsigned default_jobs() {
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace dmrp::host
