// SPDX-License-Identifier: MIT
#include "host/plugins/parameter_text.hpp"

#include <fmt/format.h>

#include "host/toml/toml_text.hpp"

namespace dmrp::host {

std::string toml_text(const ParameterValue& value) {
  switch (value.type) {
    case DMRP_PARAM_BOOL:
      return value.integer ? "true" : "false";
    case DMRP_PARAM_INT:
      return fmt::format("{}", value.integer);
    case DMRP_PARAM_DOUBLE:
      return toml_text(value.number);
    case DMRP_PARAM_DOUBLE_ARRAY:
      return toml_text(value.numbers);
    case DMRP_PARAM_STRING_ARRAY:
      return toml_text(value.texts);
    default:
      return toml_text(value.text);
  }
}

}  // namespace dmrp::host
