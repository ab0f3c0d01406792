// SPDX-License-Identifier: MIT
// v1_sizes.hpp: the sizes that plugin-made structs had in v1.0 of the contract, and copies of structs that are shorter or
// longer than this host's.
//
// A plugin is compiled with any v1 header: its structs and array elements have v1.0's size at least, and more if its
// header is newer than v1.0. The host copies the part that both know; the rest is zero.
#pragma once

#include <dmrp/entry.h>
#include <dmrp/ext/annotate.h>
#include <dmrp/ext/walking_grid.h>
#include <dmrp/global_planner.h>
#include <dmrp/local_controller.h>
#include <dmrp/metric.h>
#include <dmrp/pedestrian_model.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace dmrp::host {

// Never changed: a field appended later is not in v1.0.
template <class Struct>
inline constexpr std::size_t size_v1_0 = 0;
template <>
inline constexpr std::size_t size_v1_0<dmrp_entry> = 56;
template <>
inline constexpr std::size_t size_v1_0<dmrp_descriptor> = 144;
template <>
inline constexpr std::size_t size_v1_0<dmrp_planner_traits> = 8;
template <>
inline constexpr std::size_t size_v1_0<dmrp_controller_traits> = 8;
template <>
inline constexpr std::size_t size_v1_0<dmrp_metric_traits> = 24;
template <>
inline constexpr std::size_t size_v1_0<dmrp_param_spec> = 104;
template <>
inline constexpr std::size_t size_v1_0<dmrp_metric_value_spec> = 56;
template <>
inline constexpr std::size_t size_v1_0<dmrp_global_planner> = 16;
template <>
inline constexpr std::size_t size_v1_0<dmrp_local_controller> = 32;
template <>
inline constexpr std::size_t size_v1_0<dmrp_pedestrian_model> = 16;
template <>
inline constexpr std::size_t size_v1_0<dmrp_metric> = 32;
template <>
inline constexpr std::size_t size_v1_0<dmrp_path> = 24;
template <>
inline constexpr std::size_t size_v1_0<dmrp_waypoint> = 40;
template <>
inline constexpr std::size_t size_v1_0<dmrp_metric_result> = 40;
template <>
inline constexpr std::size_t size_v1_0<dmrp_event> = 72;
template <>
inline constexpr std::size_t size_v1_0<dmrp_subject> = 16;
template <>
inline constexpr std::size_t size_v1_0<dmrp_trajectory> = 32;
template <>
inline constexpr std::size_t size_v1_0<dmrp_note> = 16;
template <>
inline constexpr std::size_t size_v1_0<dmrp_walking_grid_request> = 24;

// Whether a struct of this many bytes holds all fields of v1.0.
template <class Struct>
constexpr bool has_v1_0(std::size_t bytes) {
  static_assert(size_v1_0<Struct> > 0 && size_v1_0<Struct> <= sizeof(Struct));
  static_assert(size_v1_0<Struct> == sizeof(Struct) || DMRP_ABI_MINOR > 0, "this is v1.0");
  return bytes >= size_v1_0<Struct>;
}

// The same of an array's elements, whose strides are multiples of 8.
template <class Element>
constexpr bool has_stride_v1_0(std::size_t stride) {
  return has_v1_0<Element>(stride) && stride % 8 == 0;
}

// The struct that has `bytes` bytes in its maker's version.
template <class Struct>
Struct copy_known_part(const void* theirs, std::size_t bytes) {
  Struct ours{};
  std::memcpy(&ours, theirs, std::min(bytes, sizeof(ours)));
  return ours;
}

// A growable struct.
template <class Struct>
Struct copy_struct(const Struct& theirs) {
  return copy_known_part<Struct>(&theirs, theirs.struct_size);
}

// An array element.
template <class Element>
Element copy_element(const Element* base, std::size_t stride, std::size_t index) {
  return copy_known_part<Element>(reinterpret_cast<const char*>(base) + index * stride, stride);
}

}  // namespace dmrp::host
