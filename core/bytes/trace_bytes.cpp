// SPDX-License-Identifier: MIT
#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

std::uint8_t* lengthen(TraceBytes& bytes, std::size_t count) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + count);
  return bytes.data() + begin;
}

}  // namespace dmrp::core
