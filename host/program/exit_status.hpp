// SPDX-License-Identifier: MIT
// exit_status.hpp: the exit statuses of `dmrp-host`.
#pragma once

namespace dmrp::host::exit_status {

inline constexpr int done = 0;
inline constexpr int faults = 1;  // some trials ended in a fault
inline constexpr int bad_input = 2;
inline constexpr int machine_failed = 3;  // a full disk, an I/O error, no memory
inline constexpr int findings = 1;        // check: a case failed or crashed
inline constexpr int different = 1;       // verify: a trial has other bits
inline constexpr int worse = 1;           // compare --fail-if: a condition holds
inline constexpr int undecided = 4;       // compare --fail-if: the trials cannot decide
inline constexpr int interrupted = 130;

}  // namespace dmrp::host::exit_status
