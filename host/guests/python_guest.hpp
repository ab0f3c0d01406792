// SPDX-License-Identifier: MIT
// python_guest.hpp: the process of a guest becomes python3, which loads libdmrp_guest.so and runs the guest's program in it.
#pragma once

#include "host/guests/inside/guest_program.hpp"

namespace dmrp::host {

// Only returns if python3 cannot be started.
void become_python(const GuestOrder& order);

}  // namespace dmrp::host
