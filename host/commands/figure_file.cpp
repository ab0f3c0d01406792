// SPDX-License-Identifier: MIT
#include "host/commands/figure_file.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "host/commands/command_output.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/machine_error.hpp"
#include "host/files/read_file.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// A file that is gone at the end, whatever happens.
struct TemporaryFile {
  explicit TemporaryFile(fs::path file) : path(std::move(file)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path path;
};

void run_converter(std::vector<std::string> arguments) {
  std::vector<char*> list;
  for (std::string& argument : arguments) list.push_back(argument.data());
  list.push_back(nullptr);
  pid_t child = -1;
  const int error = posix_spawnp(&child, list[0], nullptr, nullptr, list.data(), environ);
  if (error == ENOENT)
    throw MachineError(
        "there is no rsvg-convert on the path, which makes PNG and PDF of SVG (Debian: apt-get install librsvg2-bin)");
  if (error != 0) throw MachineError("cannot start rsvg-convert", error);
  int status = 0;
  pid_t ended = -1;
  do ended = waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) throw MachineError("rsvg-convert failed");
}

}  // namespace

core::PictureFormat picture_format(const char* option, const fs::path& file) {
  const fs::path ending = file.extension();
  if (ending == ".png") return core::PictureFormat::png;
  if (ending == ".pdf") return core::PictureFormat::pdf;
  if (!ending.empty() && ending != ".svg")
    throw InputError(fmt::format("{} {}: ends in none of .svg, .png, .pdf", option, file.string()));
  return core::PictureFormat::svg;
}

void write_figure(const char* option, const fs::path& file, std::string_view svg) {
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".pdf") return write_output(option, file, svg);
  const TemporaryFile drawing(file.string() + ".svg.part");
  write_output(option, drawing.path, svg);
  const TemporaryFile converted(file.string() + ".part");
  std::vector<std::string> arguments = {"rsvg-convert", "--format", ending.substr(1)};
  if (ending == ".png") arguments.insert(arguments.end(), {"--zoom", "2"});  // legible when printed
  arguments.insert(arguments.end(), {"--output", converted.path.string(), drawing.path.string()});
  run_converter(std::move(arguments));
  write_output(option, file, read_file(converted.path, converted.path.string()));
}

}  // namespace dmrp::host
