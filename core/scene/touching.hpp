// SPDX-License-Identifier: MIT
// The tolerance of the scene's geometry.
#pragma once

namespace dmrp::core {

// Lengths that differ by no more are equal: rounding must not close a gap of exactly the size that a body needs.
inline constexpr double touching_m = 1e-9;

}  // namespace dmrp::core
