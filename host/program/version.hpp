// SPDX-License-Identifier: MIT
// version.hpp: of the program, as the build states it.
#pragma once

namespace dmrp::host {

inline constexpr const char* version = DMRP_VERSION;

}  // namespace dmrp::host
