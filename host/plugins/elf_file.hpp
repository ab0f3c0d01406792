// SPDX-License-Identifier: MIT
// elf_file.hpp: what a shared object says of itself before it is loaded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host {

// Why this host cannot load the file, in one line: it is no shared object, or one for another machine. "" if nothing
// speaks against it.
std::string why_not_loadable(const std::filesystem::path& file);

// A defined dynamic symbol that other libraries see.
struct ExportedSymbol {
  std::string name;  // mangled
  bool weak = false;
};

// Those of a shared object of this machine; empty if they cannot be read.
std::vector<ExportedSymbol> exported_symbols(const std::filesystem::path& file);

// The library, and those which the loader may take for what it needs from folders that they or LD_LIBRARY_PATH name. Those of
// the system are not in it.
std::vector<std::filesystem::path> files_of_library(const std::filesystem::path& file);

// SHA-256, hexadecimal, of all that is loaded of it, but for what names folders and builds: equal for a library in the
// build tree, installed (another RUNPATH) and stripped. Of the whole file if it is no ELF file.
std::string code_digest(const std::filesystem::path& file);

}  // namespace dmrp::host
