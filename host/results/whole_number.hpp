// SPDX-License-Identifier: MIT
// whole_number.hpp: integers in messages of other processes, which may say anything.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/results/result_json.hpp"

namespace dmrp::host {

// json::get() takes 1e300 for an integer, and 2^40 for a small one. Throws UnbelievableMessage.
template <class T>
T whole_number(const nlohmann::json& json) {
  if (json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>()))
    return json.get<T>();
  throw UnbelievableMessage("with a number that none can be");
}

}  // namespace dmrp::host
