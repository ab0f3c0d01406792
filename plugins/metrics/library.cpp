// SPDX-License-Identifier: MIT
// The built-in metrics as one plugin library.
#include "compute/compute_time.hpp"
#include "execution/idle_time.hpp"
#include "execution/smoothness.hpp"
#include "interaction/blocked_time.hpp"
#include "interaction/deadlock.hpp"
#include "interaction/neighbours.hpp"
#include "outcome/arrivals.hpp"
#include "outcome/completion_time.hpp"
#include "outcome/path_length.hpp"
#include "outcome/planning_time.hpp"
#include "outcome/speed.hpp"
#include "outcome/spl.hpp"
#include "outcome/success.hpp"
#include "paper/ibtr.hpp"
#include "paper/ldf.hpp"
#include "paper/pfd.hpp"
#include "paper/sto.hpp"
#include "safety/clearance.hpp"
#include "safety/collisions.hpp"
#include "safety/time_to_collision.hpp"
#include "social/group_intrusion.hpp"
#include "social/pedestrian_progress.hpp"
#include "social/people_nearby.hpp"
#include "social/proxemics.hpp"
#include "social/social_work.hpp"

// In the order in which they are listed, documented and, where an experiment names none, measured.
DMRP_PLUGINS(dmrp::metrics::Success, dmrp::metrics::PathLength, dmrp::metrics::PlanningTime,
             dmrp::metrics::CompletionTime, dmrp::metrics::Speed, dmrp::metrics::Arrivals, dmrp::metrics::Spl,
             dmrp::metrics::Sto, dmrp::metrics::Ibtr, dmrp::metrics::Ldf, dmrp::metrics::Pfd, dmrp::metrics::Collisions,
             dmrp::metrics::Clearance, dmrp::metrics::TimeToCollision, dmrp::metrics::BlockedTime,
             dmrp::metrics::Deadlock, dmrp::metrics::Neighbours, dmrp::metrics::PeopleNearby, dmrp::metrics::Proxemics,
             dmrp::metrics::GroupIntrusion, dmrp::metrics::SocialWork, dmrp::metrics::PedestrianProgress,
             dmrp::metrics::Smoothness, dmrp::metrics::IdleTime, dmrp::metrics::ComputeTime)
