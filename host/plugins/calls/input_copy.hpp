// SPDX-License-Identifier: MIT
// input_copy.hpp: a copy of what a plugin may read, to find that it wrote there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/plugins/calls/plugin_fault.hpp"

namespace dmrp::host {

class InputCopy {
 public:
  void clear();

  // The memory stays where it is until check().
  template <class Element>
  void add(std::span<const Element> elements) {
    add_bytes(elements.data(), elements.size_bytes());
  }
  template <class Struct>
  void add(const Struct& one) {
    add(std::span(&one, 1));
  }

  // Throws a fatal PluginFault (abi_breach) if the memory has changed: later trials of this process would read it, too.
  // `what`: "the observation".
  void check(const CallSite& site, const char* what) const;

 private:
  struct Part {
    const void* original;
    std::size_t bytes;
  };
  void add_bytes(const void* original, std::size_t bytes);

  std::vector<Part> parts_;
  std::vector<std::uint8_t> copies_;  // of all parts, one after the other
};

}  // namespace dmrp::host
