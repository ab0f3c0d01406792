// SPDX-License-Identifier: MIT
#include "host/plugins/calls/input_copy.hpp"

#include <cstring>
#include <string>

namespace dmrp::host {

void InputCopy::clear() {
  parts_.clear();
  copies_.clear();
}

void InputCopy::add_bytes(const void* original, std::size_t bytes) {
  if (bytes == 0) return;
  parts_.push_back({original, bytes});
  const auto* const first = static_cast<const std::uint8_t*>(original);
  copies_.insert(copies_.end(), first, first + bytes);
}

void InputCopy::check(const CallSite& site, const char* what) const {
  const std::uint8_t* copy = copies_.data();
  for (const Part& part : parts_) {
    if (std::memcmp(part.original, copy, part.bytes) != 0)
      throw PluginFault(fault_kind::abi_breach, site, std::string("wrote into ") + what + ", which it may only read",
                        true);
    copy += part.bytes;
  }
}

}  // namespace dmrp::host
