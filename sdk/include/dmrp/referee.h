/* SPDX-License-Identifier: MIT */
// referee.h: how a trace tells what the referee saw: which robots make progress, and what keeps the others from it. Only
// hosts and metrics that know of it need this header.
#ifndef DMRP_REFEREE_H
#define DMRP_REFEREE_H

#include "sample.h"
#include "trial_end.h"

// A kind of dmrp_call, beside those of sample.h. No call: the class of the active robot `robot` is `status` from this
// control tick on; `other` is the robot that holds or blocks it, or DMRP_NOBODY. The first sample has the class of every
// active robot, MOVING, later ones have changes.
#define DMRP_CALL_CLASS 7

// Likewise no call: at this control tick nothing could move any more. Such a trial ends, but this one is drawn to run to
// its limit. Once in a trial, for each active robot.
#define DMRP_CALL_RUNS_ON 8

// What an active robot does: exactly one of these, and bits. Open list.
#define DMRP_CLASS_MOVING 0      // gained 0.2 m in its last 20 s, or begins
#define DMRP_CLASS_SETTLING 1    // meets its goal's conditions
#define DMRP_CLASS_RECOVERING 2  // drives by itself (recovery.h)
#define DMRP_CLASS_HELD 3        // waits, as the plan's order says, for `other`
#define DMRP_CLASS_BLOCKED_PERSON 4
#define DMRP_CLASS_BLOCKED_ROBOT 5  // by `other`, on the next metre of its course
#define DMRP_CLASS_STUCK 6          // nobody holds or blocks it
#define DMRP_CLASS_MASK 0xFF
#define DMRP_CLASS_CIRCLING 0x100  // a bit: not moving, but it travels over 1 m or turns over 4 pi in 20 s

#endif
