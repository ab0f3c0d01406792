// SPDX-License-Identifier: MIT
// output.hpp: memory that a plugin function writes to, with a margin that shows whether it wrote too far.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/plugins/calls/plugin_fault.hpp"

namespace dmrp::host {

namespace detail {
inline constexpr std::size_t margin_bytes = 256;
inline constexpr std::uint8_t margin_byte = 0xA5;

inline void check_margin(const std::uint8_t* margin, const CallSite& site, const char* type) {
  if (!std::all_of(margin, margin + margin_bytes, [](std::uint8_t byte) { return byte == margin_byte; }))
    throw PluginFault(fault_kind::abi_breach, site, std::string("wrote beyond the end of ") + type);
}
}  // namespace detail

// An output struct: zeroed and sized.
template <class Struct>
class Output {
 public:
  Output() { clear(); }

  void clear() {
    margin_.fill(detail::margin_byte);
    value = {};
    value.struct_size = sizeof(Struct);
  }

  // Throws PluginFault (abi_breach) if the function at `site` wrote beyond it. `type`: the struct's name.
  void check(const CallSite& site, const char* type) const { detail::check_margin(margin_.data(), site, type); }

  Struct value{};

 private:
  std::array<std::uint8_t, detail::margin_bytes> margin_;
};

// An output array.
template <class Element>
class OutputArray {
 public:
  // `count` zeroed elements.
  void resize(std::size_t count) {
    count_ = count;
    elements_.assign(count + margin_elements, Element{});
    std::fill_n(margin(), detail::margin_bytes, detail::margin_byte);
  }

  Element* data() { return elements_.data(); }
  const Element& operator[](std::size_t index) const { return elements_[index]; }
  Element& operator[](std::size_t index) { return elements_[index]; }
  std::size_t size() const { return count_; }

  void check(const CallSite& site, const char* type) { detail::check_margin(margin(), site, type); }

 private:
  static constexpr std::size_t margin_elements = detail::margin_bytes / sizeof(Element) + 1;
  std::uint8_t* margin() { return reinterpret_cast<std::uint8_t*>(elements_.data() + count_); }

  std::size_t count_ = 0;
  std::vector<Element> elements_;
};

}  // namespace dmrp::host
