// SPDX-License-Identifier: MIT
// figure_file.hpp: figures as files: SVG, and by rsvg-convert PNG and PDF.
#pragma once

#include <filesystem>
#include <string_view>

namespace dmrp::host {

// Writes an SVG document to `file`: as PNG or PDF if its name ends so, to standard output if it is empty. `option`: its
// name on the command line, for messages. Throws InputError, and MachineError if there is no rsvg-convert on the path.
void write_figure(const char* option, const std::filesystem::path& file, std::string_view svg);

}  // namespace dmrp::host
