// SPDX-License-Identifier: MIT
// map_image.hpp: reads the images of maps: PGM, plain (P2) and raw (P5), and PNG of every kind.
// Every mistake in a file is an InputError in one line, `file:line:column: what was expected`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dmrp::host {

// Row-major from the upper left.
struct MapImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t white = 255;         // the level of white; 0 is black
  std::vector<std::uint32_t> level;  // the sum of the colour channels: their mean is level / white
  std::vector<std::uint8_t> alpha;   // 255: opaque. Empty if the image has no alpha channel
};

// Recognises the format by the first bytes of the file, not by its name.
MapImage read_map_image(const std::filesystem::path& file, const std::string& shown_path);

// One format each, from the bytes of a file.
MapImage read_pgm(std::string_view bytes, const std::string& shown_path);
MapImage read_png(std::string_view bytes, const std::string& shown_path);

// Throws InputError if there are no cells or more than the maximum. `place`: "file:line:column" for the message.
void check_map_size(std::uint64_t width, std::uint64_t height, const std::string& place);

}  // namespace dmrp::host
