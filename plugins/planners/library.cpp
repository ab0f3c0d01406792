// SPDX-License-Identifier: MIT
// libdmrp_planners.so: the built-in global planners.
#include "cbs/cbs.hpp"
#include "ecbs/ecbs.hpp"
#include "ecbs8/ecbs8.hpp"
#include "eecbs/eecbs.hpp"
#include "individual/individual.hpp"
#include "sipp/sipp.hpp"

DMRP_PLUGINS(dmrp::planners::Individual, dmrp::planners::Cbs, dmrp::planners::Ecbs, dmrp::planners::Ecbs8,
             dmrp::planners::Eecbs, dmrp::planners::Sipp)
