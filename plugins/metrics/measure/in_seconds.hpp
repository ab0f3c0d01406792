// SPDX-License-Identifier: MIT
// in_seconds.hpp: conversion of times for results.
#pragma once

#include <cstdint>

namespace dmrp::metrics {

// Rounds once, so that 0.3 s is the double nearest to 0.3.
inline double in_seconds(std::int64_t ns) {
  return static_cast<double>(ns) / 1e9;
}

}  // namespace dmrp::metrics
