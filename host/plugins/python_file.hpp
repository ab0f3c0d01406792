// SPDX-License-Identifier: MIT
// python_file.hpp: a Python file as a plugin library. Its guest is python3, which runs the guest's program from a shared
// library, libdmrp_guest.so; the file's plugins are an entry as that of any library, whose functions Python has made.
#pragma once

#include <dmrp/entry.h>

#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host {

// By its extension.
bool is_python_file(const std::filesystem::path& file);

// python3 of the active virtual environment (VIRTUAL_ENV, CONDA_PREFIX), otherwise the first program of that name in PATH
// that has numpy. Throws std::runtime_error, one line, if there is none.
std::filesystem::path python_interpreter();

// lib/dmrp/python, which holds the module that python3 runs, beside lib/dmrp/libdmrp_guest.so.
std::filesystem::path python_guest_path();

// What a guest of python3 sees besides the system: the environment of its interpreter, and dmrp's own part.
std::vector<std::filesystem::path> files_of_python();

// What python3 offers its guest. Texts are valid until the next call.
struct PythonFunctions {
  const dmrp_entry* (*open)(const char* file);  // imports it; NULL: error() says why, in one line
  const char* (*error)();
  const char* (*modules)();   // the files that it has imported from its folder, one a line
  const char* (*versions)();  // of Python and its packages, one a line
};

// Those of this process, NULL where it is not python3.
const PythonFunctions*& python_functions();

// The lines of a text.
std::vector<std::string> lines_of(const char* text);

}  // namespace dmrp::host
