// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/commands.hpp"
#include "host/report/write_report.hpp"

namespace dmrp::host {

int report_command(const std::filesystem::path& run_directory, const std::vector<std::uint64_t>& replayed) {
  write_report(run_directory, replayed);
  fmt::print("{}\n", (run_directory / "report.html").string());
  return exit_status::done;
}

}  // namespace dmrp::host
