// SPDX-License-Identifier: MIT
// same_outputs.hpp: what a rehearsal of a new instance gives, and whether another gives the same.
#pragma once

#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"

namespace dmrp::host {

// Fails at the first number that differs, to the bit.
void expect_same(Examination& it, const Outputs& outputs, const Outputs& expected);

// What a new instance gives.
Outputs alone(Examination& it, std::uint64_t seed);

}  // namespace dmrp::host
