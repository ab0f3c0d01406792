// SPDX-License-Identifier: MIT
// page_packing.hpp: large text as a page carries it: gzip in base64, which a browser unpacks by DecompressionStream.
#pragma once

#include <string>
#include <string_view>

namespace dmrp::host {

// Equal texts give equal results: no time and no file name goes in. Throws std::runtime_error.
std::string gzip(std::string_view text);

std::string base64(std::string_view bytes);  // on one line, padded

}  // namespace dmrp::host
