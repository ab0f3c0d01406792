// SPDX-License-Identifier: MIT
// The local controllers of dmrp, as one plugin library.
#include <dmrp/plugin.hpp>

#include "dwa/dwa.hpp"
#include "e3mop/e3mop.hpp"
#include "pure_pursuit/pure_pursuit.hpp"

DMRP_PLUGINS(dmrp::controllers::PurePursuit, dmrp::controllers::Dwa, dmrp::controllers::E3mop)
