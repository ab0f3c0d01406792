// SPDX-License-Identifier: MIT
#include <dmrp/abi.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "host/check/case_process.hpp"
#include "host/commands/command.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/guests/fork_server.hpp"
#include "host/process/box.hpp"
#include "host/program/commit.hpp"
#include "host/program/version.hpp"
#include "host/terminal/colors.hpp"
#include "host/terminal/mistake_text.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/workers/worker.hpp"

namespace {

using namespace dmrp::host;

// The commands of child processes: internal, and not in the help.
std::optional<int> run_as_child(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "fork-server") == 0)
    return ForkServer::run(std::atoi(argv[2]), &run_case_in_guest);
  if (argc == 9 && std::strcmp(argv[1], "worker") == 0)
    return run_worker({argv[2], static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)),
                       static_cast<unsigned>(std::strtoul(argv[4], nullptr, 10)),
                       static_cast<unsigned>(std::strtoul(argv[5], nullptr, 10)), argv[6], std::atoi(argv[7]),
                       std::atoi(argv[8])});
  return std::nullopt;
}

// If the standard streams are closed, the first files to be opened would take their numbers.
void open_standard_streams() {
  int descriptor = open("/dev/null", O_RDWR);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDWR);
  if (descriptor >= 0) close(descriptor);
}

// "dmrp-host 0.1.0 (commit 597cdd0a1b2c, ABI v1.0, draft 2)"
std::string version_text() {
  std::string text = std::string("dmrp-host ") + version + " (commit " + commit + ", ABI v" +
                     std::to_string(DMRP_ABI_MAJOR) + "." + std::to_string(DMRP_ABI_MINOR);
  if (DMRP_ABI_DRAFT > 0) text += ", draft " + std::to_string(DMRP_ABI_DRAFT);
  return text + ")";
}

// Throws InputError at the first option that neither the command nor the program has: the parser would complain of what is
// missing first, and knows no nearest name.
void check_options(const CLI::App& program, const std::vector<std::string>& arguments) {
  const CLI::App* const command = program.get_subcommand(arguments.front());
  std::vector<const CLI::App*> apps = command->get_subcommands({});  // groups of options
  apps.insert(apps.end(), {command, &program});
  std::vector<std::string> known;
  for (const CLI::App* app : apps)
    for (const CLI::Option* option : app->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    const std::string name = argument.substr(0, argument.find('='));
    if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("dmrp-host " + command->get_name() + ": there is no option '" + name + "'" +
                       did_you_mean(name, known) + " (see --help)");
  }
}

// The arguments with a command or an option first. `EXPERIMENT.toml` means `run EXPERIMENT.toml`, also with options before
// it, and `help COMMAND` means `COMMAND --help`. Throws InputError if the program has no such command.
std::vector<std::string> arguments_with_command(const CLI::App& program, std::vector<std::string> arguments) {
  if (arguments.empty()) return {"--help"};
  const auto is_file = [](const std::string& argument) { return argument.ends_with(".toml"); };
  if (arguments[0] == "help" && (arguments.size() == 1 || !arguments[1].starts_with("-"))) {
    std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
    arguments.back() = "--help";
  } else if ((arguments[0].starts_with("-") || is_file(arguments[0])) &&
             std::any_of(arguments.begin(), arguments.end(), is_file)) {
    arguments.insert(arguments.begin(), "run");
  }

  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  const std::string& written = arguments.front();
  if (written.starts_with("-")) return arguments;
  if (std::find(names.begin(), names.end(), written) != names.end()) {
    check_options(program, arguments);
    return arguments;
  }
  throw InputError("dmrp-host: there is no command '" + written + "'" + did_you_mean(written, names) +
                   "; commands are " + join_names(names));
}

int run_main(int argc, char** argv) {
  CLI::App app("Benchmarks multi-robot motion planning among moving people.", "dmrp-host");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag_callback("--no-box", &box::disable, "let plugins see and do what you can: for debuggers of plugins");
  app.footer(help_footer("dmrp-host examples/quickstart.toml"));
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("dmrp-host: ") + error.what() + " (see --help)\n";
  });
#define DMRP_ADD(name) add_##name(app);
  DMRP_COMMANDS(DMRP_ADD)
#undef DMRP_ADD
  app.add_subcommand("help", "print this help, or that of a command")->add_option("command")->type_name("COMMAND");

  std::vector<std::string> arguments = arguments_with_command(app, {argv + 1, argv + argc});
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::RuntimeError& ended) {  // by a command
    return ended.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_status::done : exit_status::bad_input;
  }
  return exit_status::done;
}

// What was printed is buffered: a full disk shows only here.
void flush_output() {
  if (std::fflush(stdout) != 0) throw MachineError("standard output", errno);
  if (std::ferror(stdout)) throw MachineError("standard output: not everything could be written");
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of `ulimit -f`: write() fails instead
  if (const auto status = run_as_child(argc, argv)) return *status;
  try {
    const int status = run_main(argc, argv);
    flush_output();
    return status;
  } catch (const InputError& error) {
    std::fputs(mistake_text(error, has_colors(STDERR_FILENO)).c_str(), stderr);
    return exit_status::bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dmrp-host: %s\n", error_text(error).c_str());
    return is_machine_failure(error) ? exit_status::machine_failed : exit_status::bad_input;
  }
}
