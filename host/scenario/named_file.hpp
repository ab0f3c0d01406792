// SPDX-License-Identifier: MIT
// named_file.hpp: files that scenario.toml names relative to itself.
#pragma once

#include <filesystem>
#include <string>

#include "host/scenario/read_scenario.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

struct NamedFile {
  std::filesystem::path path;  // absolute
  std::string shown_path;      // for messages
};

// The file in `value`; adds it to out.files. `scenario_file`, `shown_path`: of scenario.toml. Throws InputError if
// there is no such file.
NamedFile named_file(const TomlValue& value, const std::filesystem::path& scenario_file, const std::string& shown_path,
                     ScenarioFile& out);

}  // namespace dmrp::host
