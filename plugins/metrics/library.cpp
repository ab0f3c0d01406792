// SPDX-License-Identifier: MIT
// The built-in metrics as one plugin library.
#include "outcome/completion_time.hpp"
#include "outcome/path_length.hpp"
#include "outcome/planning_time.hpp"
#include "outcome/speed.hpp"
#include "outcome/success.hpp"
#include "paper/ibtr.hpp"
#include "paper/ldf.hpp"
#include "paper/pfd.hpp"
#include "paper/sto.hpp"
#include "safety/collisions.hpp"
#include "social/people_nearby.hpp"

DMRP_PLUGINS(dmrp::metrics::Success, dmrp::metrics::PathLength, dmrp::metrics::PlanningTime,
             dmrp::metrics::CompletionTime, dmrp::metrics::Speed, dmrp::metrics::Collisions, dmrp::metrics::Sto,
             dmrp::metrics::Ibtr, dmrp::metrics::Ldf, dmrp::metrics::Pfd, dmrp::metrics::PeopleNearby)
