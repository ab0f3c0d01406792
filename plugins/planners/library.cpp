// SPDX-License-Identifier: MIT
// libdmrp_planners.so: the built-in global planners.
#include "cbs/cbs.hpp"
#include "individual/individual.hpp"
#include "sipp/sipp.hpp"

DMRP_PLUGINS(dmrp::planners::Individual, dmrp::planners::Cbs, dmrp::planners::Sipp)
