// SPDX-License-Identifier: MIT
#include "host/plugins/python_file.hpp"

#include <elf.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "host/program/executable.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

namespace {

// No script that asks another program which python3 to start: the box would refuse that.
bool is_program(const fs::path& file) {
  std::string head(SELFMAG, '\0');
  std::ifstream(file, std::ios::binary).read(head.data(), SELFMAG);
  return head == ELFMAG;
}

// In the folders of packages of its installation, lib/python3 (Debian's) and lib/python3.N.
bool has_numpy(const fs::path& python) {
  std::error_code missing;
  for (const auto& library : fs::directory_iterator(fs::canonical(python).parent_path().parent_path() / "lib", missing))
    if (library.path().filename().string().starts_with("python3"))
      for (const char* const packages : {"dist-packages", "site-packages"})
        if (fs::exists(library.path() / packages / "numpy", missing)) return true;
  return false;
}

}  // namespace

bool is_python_file(const fs::path& file) {
  return file.extension() == ".py";
}

fs::path python_interpreter() {
  for (const char* const variable : {"VIRTUAL_ENV", "CONDA_PREFIX"}) {
    const char* const folder = std::getenv(variable);
    if (!folder || !*folder) continue;
    const fs::path python = fs::path(folder) / "bin/python3";
    if (access(python.c_str(), X_OK) == 0) return python;
    throw std::runtime_error("is a Python file, and the environment that " + std::string(variable) +
                             " names has no bin/python3");
  }
  for (const fs::path& folder : folders_of_variable("PATH"))
    if (const fs::path python = folder / "python3";
        access(python.c_str(), X_OK) == 0 && is_program(python) && has_numpy(python))
      return python;
  throw std::runtime_error("is a Python file, and no python3 in PATH has numpy (Debian package python3-numpy)");
}

fs::path python_guest_path() {
  return installation_path() / "lib/dmrp/python";
}

std::vector<fs::path> files_of_python() {
  const fs::path python = python_interpreter();
  return {python_guest_path(), python_guest_path().parent_path() / "libdmrp_guest.so",
          python.parent_path().parent_path(), fs::canonical(python).parent_path().parent_path()};
}

const PythonFunctions*& python_functions() {
  static const PythonFunctions* functions = nullptr;
  return functions;
}

std::vector<std::string> lines_of(const char* text) {
  std::vector<std::string> lines;
  std::istringstream all(text ? text : "");
  for (std::string line; std::getline(all, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace dmrp::host
