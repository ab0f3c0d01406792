// SPDX-License-Identifier: MIT
// sanitized.hpp: sanitizers reserve terabytes of address space, and start processes of their own.
#pragma once

namespace dmrp::host {

// Whether the host is built with the address or thread sanitizer.
extern const bool is_sanitized;

}  // namespace dmrp::host
