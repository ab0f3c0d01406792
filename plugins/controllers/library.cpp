// SPDX-License-Identifier: MIT
// The local controllers of dmrp, as one plugin library.
#include <dmrp/plugin.hpp>

#include "controllers/dwa/dwa.hpp"
#include "controllers/e3mop/e3mop.hpp"
#include "controllers/mpc/mpc.hpp"
#include "controllers/mppi/mppi.hpp"
#include "controllers/orca/orca.hpp"
#include "controllers/pure_pursuit/pure_pursuit.hpp"
#include "controllers/stop_and_wait/stop_and_wait.hpp"
#include "controllers/teb/teb.hpp"

DMRP_PLUGINS(dmrp::controllers::PurePursuit, dmrp::controllers::Dwa, dmrp::controllers::Teb, dmrp::controllers::Mpc,
             dmrp::controllers::E3mop, dmrp::controllers::StopAndWait, dmrp::controllers::Mppi,
             dmrp::controllers::OrcaController)
