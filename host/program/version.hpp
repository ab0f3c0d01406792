// SPDX-License-Identifier: MIT
// version.hpp: the version of the program.
#pragma once

namespace dmrp::host {

inline constexpr const char* version = DMRP_VERSION;

}  // namespace dmrp::host
