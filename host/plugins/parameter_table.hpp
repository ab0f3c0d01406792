// SPDX-License-Identifier: MIT
// parameter_table.hpp: parameter values as the C structs that create() reads.
#pragma once

#include <dmrp/parameter.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "host/plugins/grown_struct.hpp"
#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// Refers to `values`, which outlives it. The table and its elements are longer than this host's by `grown_bytes`, a
// multiple of 8.
class ParameterTable {
 public:
  explicit ParameterTable(const std::vector<ParameterValue>& values, std::uint32_t grown_bytes = 0)
      : table_({}, grown_bytes) {
    const std::size_t words = (sizeof(dmrp_param_value) + grown_bytes) / sizeof(std::uint64_t);
    elements_.resize(values.size() * words);
    texts_.reserve(values.size());
    for (const ParameterValue& value : values) {
      auto& texts = texts_.emplace_back();
      for (const std::string& text : value.texts) texts.push_back(text.c_str());
      const dmrp_param_value element = {
          value.key.c_str(),    value.type,   static_cast<std::uint32_t>(value.numbers.size() + value.texts.size()),
          value.integer,        value.number, value.text.c_str(),
          value.numbers.data(), texts.data()};
      std::memcpy(&elements_[(texts_.size() - 1) * words], &element, sizeof(element));
    }
    table_.c.count = static_cast<std::uint32_t>(values.size());
    table_.c.stride = static_cast<std::uint32_t>(words * sizeof(std::uint64_t));
    table_.c.values = reinterpret_cast<const dmrp_param_value*>(elements_.data());
  }
  ParameterTable(const ParameterTable&) = delete;
  ParameterTable& operator=(const ParameterTable&) = delete;

  const dmrp_params& get() const { return table_.c; }

 private:
  std::vector<std::vector<const char*>> texts_;
  std::vector<std::uint64_t> elements_;  // dmrp_param_value, each with the stride
  GrownStruct<dmrp_params> table_;
};

}  // namespace dmrp::host
