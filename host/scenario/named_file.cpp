// SPDX-License-Identifier: MIT
#include "host/scenario/named_file.hpp"

#include <fmt/format.h>

#include <system_error>

namespace dmrp::host {

NamedFile named_file(const TomlValue& value, const std::filesystem::path& scenario_file, const std::string& shown_path,
                     ScenarioFile& out) {
  namespace fs = std::filesystem;
  const std::string name = value.line();
  const fs::path file = (scenario_file.parent_path() / name).lexically_normal();
  if (std::error_code ignored; !fs::is_regular_file(file, ignored))
    value.fail(fmt::format("no file '{}' beside the scenario file", name));
  out.files.push_back(file);
  return {file, (fs::path(shown_path).parent_path() / name).lexically_normal().string()};
}

}  // namespace dmrp::host
