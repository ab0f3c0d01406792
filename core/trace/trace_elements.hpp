// SPDX-License-Identifier: MIT
// trace_elements.hpp: the sizes of elements of arrays that are stored as in memory, which may grow with the plugin
// contract. Internal to traces.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>

#include <cstddef>
#include <limits>

namespace dmrp::core {

// The size of an element in format version 1, and its least size in later ones: that of version 1.0 of the contract.
struct TraceElementSize {
  std::size_t format_1;
  std::size_t least;
};

template <class Element>
inline constexpr TraceElementSize trace_element_size = Element::not_stored_as_in_memory;
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_goal> = {56, 56};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_waypoint> = {36, 40};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_robot_sample> = {88, 96};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_person> = {112, 120};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_contact> = {40, 40};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_call> = {20, 24};
template <>
inline constexpr TraceElementSize trace_element_size<dmrp_robot_end> = {16, 16};

// The fields that an older trace does not have: zero, unless the contract names another value.
template <class Element>
inline constexpr Element absent_fields = {};
template <>
inline constexpr dmrp_contact absent_fields<dmrp_contact> = {
    0, 0, 0, 0, 0.0, {0.0, 0.0}, std::numeric_limits<double>::quiet_NaN()};
template <>
inline constexpr dmrp_robot_end absent_fields<dmrp_robot_end> = {0, 0, 0, 0, DMRP_NOBODY};

}  // namespace dmrp::core
