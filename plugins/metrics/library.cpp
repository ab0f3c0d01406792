// SPDX-License-Identifier: MIT
// The plugin library of the built-in metrics.
#include "metrics/compute/compute_time.hpp"
#include "metrics/execution/clipped_commands.hpp"
#include "metrics/execution/idle_time.hpp"
#include "metrics/execution/interventions.hpp"
#include "metrics/execution/recoveries.hpp"
#include "metrics/execution/smoothness.hpp"
#include "metrics/interaction/blocked_time.hpp"
#include "metrics/interaction/deadlock.hpp"
#include "metrics/interaction/encounters.hpp"
#include "metrics/interaction/mini_game.hpp"
#include "metrics/interaction/neighbours.hpp"
#include "metrics/interaction/open_standstill.hpp"
#include "metrics/interaction/person_standoff.hpp"
#include "metrics/outcome/arrivals.hpp"
#include "metrics/outcome/completion_time.hpp"
#include "metrics/outcome/first_cause.hpp"
#include "metrics/outcome/path_length.hpp"
#include "metrics/outcome/planning_time.hpp"
#include "metrics/outcome/speed.hpp"
#include "metrics/outcome/spl.hpp"
#include "metrics/outcome/success.hpp"
#include "metrics/paper/ibtr.hpp"
#include "metrics/paper/ldf.hpp"
#include "metrics/paper/pfd.hpp"
#include "metrics/paper/sto.hpp"
#include "metrics/safety/braking_response.hpp"
#include "metrics/safety/clearance.hpp"
#include "metrics/safety/collisions.hpp"
#include "metrics/safety/time_to_collision.hpp"
#include "metrics/schedule/root_conflicts.hpp"
#include "metrics/schedule/schedule_error.hpp"
#include "metrics/schedule/sto_physical.hpp"
#include "metrics/social/group_intrusion.hpp"
#include "metrics/social/pedestrian_progress.hpp"
#include "metrics/social/people_nearby.hpp"
#include "metrics/social/proxemics.hpp"
#include "metrics/social/social_work.hpp"

// The order of lists and documents, and of measurement where an experiment names no metrics.
DMRP_PLUGINS(dmrp::metrics::Success, dmrp::metrics::PathLength, dmrp::metrics::PlanningTime,
             dmrp::metrics::CompletionTime, dmrp::metrics::Speed, dmrp::metrics::Arrivals, dmrp::metrics::Spl,
             dmrp::metrics::FirstCause, dmrp::metrics::Sto, dmrp::metrics::Ibtr, dmrp::metrics::Ldf, dmrp::metrics::Pfd,
             dmrp::metrics::StoPhysical, dmrp::metrics::ScheduleError, dmrp::metrics::RootConflicts,
             dmrp::metrics::Collisions, dmrp::metrics::BrakingResponse, dmrp::metrics::Clearance,
             dmrp::metrics::TimeToCollision, dmrp::metrics::BlockedTime, dmrp::metrics::Deadlock,
             dmrp::metrics::PersonStandoff, dmrp::metrics::OpenStandstill, dmrp::metrics::Encounters,
             dmrp::metrics::MiniGame, dmrp::metrics::Neighbours, dmrp::metrics::PeopleNearby, dmrp::metrics::Proxemics,
             dmrp::metrics::GroupIntrusion, dmrp::metrics::SocialWork, dmrp::metrics::PedestrianProgress,
             dmrp::metrics::Smoothness, dmrp::metrics::IdleTime, dmrp::metrics::ClippedCommands,
             dmrp::metrics::Recoveries, dmrp::metrics::Interventions, dmrp::metrics::ComputeTime)
