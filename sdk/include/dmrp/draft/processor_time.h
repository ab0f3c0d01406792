/* SPDX-License-Identifier: MIT */
// draft/processor_time.h: how a trace tells of the processor time of planning. Only hosts and metrics that know of it need
// this header.
//
// Rationale: the wall time of a call has what else the machine did in it. A thread's own time would leave out the threads
// that a planner starts.
//
// A draft: it may change or go with any version, and dmrp.h does not include it.
#ifndef DMRP_DRAFT_PROCESSOR_TIME_H
#define DMRP_DRAFT_PROCESSOR_TIME_H

#include "../sample.h"

// A kind of dmrp_call, beside those of sample.h. No call: duration_ns is the processor time, of all threads of its
// process, of the DMRP_CALL_PLAN before it. Processes that plan() started do not count. Traces of hosts that do not know
// this header have none.
#define DMRP_CALL_PLAN_PROCESSOR_TIME 6

#endif
