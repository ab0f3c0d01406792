// SPDX-License-Identifier: MIT
#include "tests/unit/controllers/tuned_parameters.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <stdexcept>

namespace dmrp::test {

ParamOverrides tuned_parameters(const std::string& controller) {
  const std::string name = controller.substr(controller.rfind('.') + 1);
  const std::string file = std::string(DMRP_PARAMETER_SETS "/tuned/") + name + ".toml";
  ParamOverrides overrides;
  if (!std::filesystem::exists(file)) return overrides;
  const toml::table table = toml::parse_file(file);
  for (const auto& [key, value] : table) {
    ParamOverride& to = overrides[std::string(key.str())];
    if (const auto* flag = value.as_boolean())
      to = flag->get();
    else if (const auto* integer = value.as_integer())
      to = integer->get();
    else if (const auto* number = value.as_floating_point())
      to = number->get();
    else if (const auto* text = value.as_string())
      to = text->get();
    else
      throw std::runtime_error(file + ": " + std::string(key.str()) + " is no plain value");
  }
  return overrides;
}

}  // namespace dmrp::test
