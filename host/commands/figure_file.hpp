// SPDX-License-Identifier: MIT
// figure_file.hpp: pictures and figures as files.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/picture/painter.hpp"

namespace dmrp::host {

// By the ending of `file`; SVG if it has none, or is empty for standard output. Throws InputError for other endings.
core::PictureFormat picture_format(const char* option, const std::filesystem::path& file);

// Writes an SVG document to `file`: as PNG or PDF if its name ends so, to standard output if it is empty. `option`: its
// name on the command line, for messages. Throws InputError, and MachineError if there is no rsvg-convert on the path.
void write_figure(const char* option, const std::filesystem::path& file, std::string_view svg);

}  // namespace dmrp::host
