// SPDX-License-Identifier: MIT
// trace_elements.hpp: the sizes of elements of arrays that are stored as in memory, which may grow with the plugin
// contract. Internal to traces.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/trial_end.h>

#include <cstddef>

namespace dmrp::core {

// The least size of an element: that of version 1.0 of the contract.
template <class Element>
inline constexpr std::size_t least_element_bytes = Element::not_stored_as_in_memory;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_goal> = 56;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_waypoint> = 40;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_robot_sample> = 128;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_person> = 120;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_contact> = 48;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_call> = 24;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_robot_event> = 24;
template <>
inline constexpr std::size_t least_element_bytes<dmrp_robot_end> = 24;

// The fields that an older trace does not have: zero, unless the contract names another value.
template <class Element>
inline constexpr Element absent_fields = {};

}  // namespace dmrp::core
