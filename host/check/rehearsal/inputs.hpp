// SPDX-License-Identifier: MIT
// inputs.hpp: what a case passes to a plugin function: copies behind a fence, as long as a later minor version would make
// them.
#pragma once

#include <dmrp/path.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "host/check/rehearsal/fence.hpp"
#include "host/plugins/calls/plugin_fault.hpp"

namespace dmrp::host {

class Inputs {
 public:
  // `grown_bytes`, a multiple of 8: what structs and array elements have beyond this host's fields.
  explicit Inputs(std::uint32_t grown_bytes) : grown_bytes_(grown_bytes) {}

  template <class Element>
  std::uint32_t stride() const {
    return static_cast<std::uint32_t>(sizeof(Element)) + grown_bytes_;
  }

  // Elements with that stride. Write to them before the call only.
  template <class Element>
  Element* array(const Element* elements, std::size_t count) {
    std::uint8_t* const bytes = add(std::max<std::size_t>(count, 1) * stride<Element>());
    for (std::size_t i = 0; i < count; ++i) std::memcpy(bytes + i * stride<Element>(), elements + i, sizeof(Element));
    return reinterpret_cast<Element*>(bytes);
  }

  // A struct with struct_size.
  template <class Struct>
  Struct* one(Struct value) {
    value.struct_size = stride<Struct>();
    return array(&value, 1);
  }

  // Paths and their waypoints.
  dmrp_path* paths(const dmrp_path* first, std::uint32_t count) {
    dmrp_path* const copies = array(first, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      dmrp_path& path = at(copies, i);
      path.struct_size = stride<dmrp_path>();
      path.waypoints = array(path.waypoints, path.count);
      path.stride = stride<dmrp_waypoint>();
    }
    return copies;
  }

  template <class Element>
  Element& at(Element* base, std::size_t index) const {
    return *reinterpret_cast<Element*>(reinterpret_cast<std::uint8_t*>(base) + index * stride<Element>());
  }

  // Before a call: the plugin may only read it.
  void seal() { fence_.seal(); }
  // Before the next one: the plugin may not touch it any more.
  void clear() {
    fence_.release();
    first_ = nullptr;
  }

  // Of the first array, if it is a plugin's output: that only the fields of `count` elements were written to.
  template <class Element>
  void check_output(std::size_t count, const CallSite& site) const {
    for (std::size_t i = 0; i < first_bytes_; ++i) {
      const bool is_field = i / stride<Element>() < count && i % stride<Element>() < sizeof(Element);
      if (!is_field && first_[i] != unknown)
        throw PluginFault(fault_kind::abi_breach, site, "wrote beyond the end of its output");
    }
  }

 private:
  static constexpr std::uint8_t unknown = 0xa5;  // in the fields that no plugin knows

  std::uint8_t* add(std::size_t bytes) {
    std::uint8_t* const block = fence_.add(bytes, unknown);
    if (!first_) {
      first_ = block;
      first_bytes_ = bytes;
    }
    return block;
  }

  std::uint32_t grown_bytes_;
  Fence fence_;
  const std::uint8_t* first_ = nullptr;
  std::size_t first_bytes_ = 0;
};

}  // namespace dmrp::host
