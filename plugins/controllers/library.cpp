// SPDX-License-Identifier: MIT
// The local controllers of dmrp, as one plugin library.
#include <dmrp/plugin.hpp>

#include "dwa/dwa.hpp"
#include "e3mop/e3mop.hpp"
#include "mpc/mpc.hpp"
#include "pure_pursuit/pure_pursuit.hpp"
#include "teb/teb.hpp"

DMRP_PLUGINS(dmrp::controllers::PurePursuit, dmrp::controllers::Dwa, dmrp::controllers::Teb, dmrp::controllers::Mpc,
             dmrp::controllers::E3mop)
