/* SPDX-License-Identifier: MIT */
// recovery.h: how a trace tells of recoveries: what a robot does by itself, without its controller, when it makes no
// progress. Only hosts and metrics that know of them need this header.
#ifndef DMRP_RECOVERY_H
#define DMRP_RECOVERY_H

#include "sample.h"

// A kind of dmrp_call, beside those of sample.h. No call: the recovery of `robot` began the step that `status` names, or
// ended.
#define DMRP_CALL_RECOVERY 5

// The status of such a call: the step that began, until the next one or the end. Open list.
#define DMRP_RECOVERY_NONE 0  // the recovery ended: the controller drives again
#define DMRP_RECOVERY_CLEAR_COSTMAP 1
#define DMRP_RECOVERY_SPIN 2
#define DMRP_RECOVERY_WAIT 3
#define DMRP_RECOVERY_BACKUP 4
#define DMRP_RECOVERY_REPLAN 5

// A bit of descriptor.channels, beside those of descriptor.h: a metric of recoveries. An experiment that names no metrics
// measures it only where robots have recoveries.
#define DMRP_CHANNEL_RECOVERIES 8u

#endif
