// SPDX-License-Identifier: MIT
// parameter_table.hpp: parameter values as the C structs that create() reads.
#pragma once

#include <dmrp/parameter.h>

#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// Refers to `values`, which outlives it.
class ParameterTable {
 public:
  explicit ParameterTable(const std::vector<ParameterValue>& values) {
    texts_.reserve(values.size());
    for (const ParameterValue& value : values) {
      auto& texts = texts_.emplace_back();
      for (const std::string& text : value.texts) texts.push_back(text.c_str());
      values_.push_back({value.key.c_str(), value.type,
                         static_cast<std::uint32_t>(value.numbers.size() + value.texts.size()), value.integer,
                         value.number, value.text.c_str(), value.numbers.data(), texts.data()});
    }
    c_ = {sizeof(c_), static_cast<std::uint32_t>(values_.size()), sizeof(dmrp_param_value), 0, values_.data()};
  }
  ParameterTable(const ParameterTable&) = delete;
  ParameterTable& operator=(const ParameterTable&) = delete;

  const dmrp_params& get() const { return c_; }

 private:
  std::vector<std::vector<const char*>> texts_;
  std::vector<dmrp_param_value> values_;
  dmrp_params c_{};
};

}  // namespace dmrp::host
