// SPDX-License-Identifier: MIT
// page_packing.hpp: packs large text for the page as gzip in base64, which browsers unpack by DecompressionStream.
#pragma once

#include <string>
#include <string_view>

namespace dmrp::host {

// Deterministic: the header contains no time and no file name. Throws std::runtime_error.
std::string gzip(std::string_view text);

std::string base64(std::string_view bytes);  // on one line, padded

}  // namespace dmrp::host
