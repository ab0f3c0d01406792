// SPDX-License-Identifier: MIT
// commit.hpp: the commit that the program was built from. Its definition is written at every build (commit.cmake).
#pragma once

namespace dmrp::host {

extern const char* const commit;  // "597cdd0a1b2c", "597cdd0a1b2c-dirty", "unknown"

}  // namespace dmrp::host
