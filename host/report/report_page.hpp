// SPDX-License-Identifier: MIT
// report_page.hpp: report.html from its parts: one file that needs no network.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dmrp::host {

// A replay as the page holds it: <script type="application/gzip" id="ELEMENT">BASE64</script>.
struct EmbeddedReplay {
  std::string element;
  std::string base64;
};

// `folder`: page.html with the lines <!-- dmrp:styles -->, <!-- dmrp:data --> and <!-- dmrp:scripts -->; style sheets
// (*.css) and scripts (*.js) that take their place in the order of their names, but style.css, d3.min.js and three.min.js first. The
// data become <script type="application/json" id="dmrp-data">. Throws InputError where a part is missing.
std::string report_page(const std::filesystem::path& folder, const std::string& data_json,
                        std::span<const EmbeddedReplay> replays);

}  // namespace dmrp::host
