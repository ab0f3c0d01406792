// SPDX-License-Identifier: MIT
// libdmrp_planners.so: the built-in global planners.
#include "planners/cbs/cbs.hpp"
#include "planners/ecbs/ecbs.hpp"
#include "planners/ecbs8/ecbs8.hpp"
#include "planners/eecbs/eecbs.hpp"
#include "planners/individual/individual.hpp"
#include "planners/lacam/lacam.hpp"
#include "planners/lns/lns.hpp"
#include "planners/pibt/pibt.hpp"
#include "planners/sipp/sipp.hpp"

DMRP_PLUGINS(dmrp::planners::Individual, dmrp::planners::Cbs, dmrp::planners::Ecbs, dmrp::planners::Ecbs8,
             dmrp::planners::Eecbs, dmrp::planners::Sipp, dmrp::planners::Pibt, dmrp::planners::Lacam,
             dmrp::planners::Lns)
