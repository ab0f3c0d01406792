// SPDX-License-Identifier: MIT
// grown_struct.hpp: a struct that the host hands to plugins, as long as this host's or longer, as that of a later minor
// version. `dmrp-host check` makes them longer.
#pragma once

#include <array>
#include <cstdint>

namespace dmrp::host {

inline constexpr std::uint32_t most_grown_bytes = 64;

template <class Struct>
struct GrownStruct {
  GrownStruct(const Struct& value, std::uint32_t grown_bytes) : c(value) {
    c.struct_size = static_cast<std::uint32_t>(sizeof(Struct)) + grown_bytes;
    rest.fill(0xa5);
  }

  Struct c;
  std::array<std::uint8_t, most_grown_bytes> rest;  // fields that no plugin knows
};

}  // namespace dmrp::host
