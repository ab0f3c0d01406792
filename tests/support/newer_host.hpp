// SPDX-License-Identifier: MIT
// newer_host.hpp: array elements and outputs as a newer host makes them: longer than a plugin knows.
#pragma once

#include <cstdint>
#include <vector>

namespace dmrp::test {

// An array element of a newer host, with a field that the plugin does not know.
template <class T>
struct Longer {
  T known;
  std::uint64_t unknown = 0x5555555555555555u;
};

template <class T>
std::uint32_t count_of(const std::vector<T>& elements) {
  return static_cast<std::uint32_t>(elements.size());
}

// An output struct of a newer host: zeroed, with its size.
template <class T>
Longer<T> longer_output() {
  Longer<T> output{};
  output.known.struct_size = sizeof(output);
  return output;
}

}  // namespace dmrp::test
