// SPDX-License-Identifier: MIT
// report_page.hpp: assembles a page, such as report.html: one file that needs no network.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace dmrp::host {

// A replay in the page: <script type="application/gzip" id="ELEMENT">BASE64</script>.
struct EmbeddedReplay {
  std::string element;
  std::string base64;
};

// Reads from `folder`, for the page NAME: NAME.html with the lines <!-- dmrp:styles -->, <!-- dmrp:data --> and
// <!-- dmrp:scripts -->; NAME.css; NAME.js; and three.min.js, which is packed like a replay as #dmrp-three if there are replays. The data
// become <script type="application/json" id="dmrp-data">. Throws InputError where a part is missing.
std::string report_page(const std::filesystem::path& folder, const std::string& name, const std::string& data_json,
                        std::span<const EmbeddedReplay> replays);

}  // namespace dmrp::host
