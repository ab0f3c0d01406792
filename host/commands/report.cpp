// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command.hpp"
#include "host/report/write_report.hpp"

namespace dmrp::host {
namespace {

struct ReportOptions {
  std::filesystem::path run_directory;
  std::vector<std::uint64_t> replayed;  // trials, besides those that the report chooses
};

}  // namespace

void add_report(CLI::App& app) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "write report.html: the results of a run in one file");
  command->add_option("run", options->run_directory, "run directory")->required()->type_name("RUN_DIR");
  command->add_option("--replay", options->replayed, "trial to replay, in addition to the chosen ones")
      ->type_name("TRIAL");
  finish_command(command, "dmrp-host report runs/quickstart --replay 0", [options] {
    write_report(options->run_directory, options->replayed);
    fmt::print("{}\n", (options->run_directory / "report.html").string());
    return exit_status::done;
  });
}

}  // namespace dmrp::host
