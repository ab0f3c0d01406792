/* SPDX-License-Identifier: MIT */
// status.h: the status that a plugin function returns, which calls may follow it, and which function may return it.
#ifndef DMRP_STATUS_H
#define DMRP_STATUS_H

#include "abi.h"

// Every plugin function that can fail returns one of these as int32_t. Text goes to host->set_error().
#define DMRP_OK 0             // done; outputs are valid
#define DMRP_WARNING 1        // done; outputs are valid; the host logs the text of set_error()
#define DMRP_NO_SOLUTION 2    // a correct answer: no solution exists. State unchanged, outputs ignored. Never a fault
#define DMRP_TIMEOUT 3        // the budget or should_stop() ended the call; outputs are valid if they are complete
#define DMRP_OUT_OF_MEMORY 4  // like DMRP_ERROR, recorded under its own name
#define DMRP_ERROR 5          // the instance is unusable until the next start(); the trial ends with a fault
#define DMRP_FATAL 6          // the library is unusable; the host calls none of its functions again but deinit()
#define DMRP_UNSUPPORTED 7    // this trial is not for this plugin, and ends with an outcome of its own. Never a fault

// What a function may return:
//
//   every function that returns a status   DMRP_OK, DMRP_WARNING, DMRP_OUT_OF_MEMORY, DMRP_ERROR, DMRP_FATAL
//   start() of every kind                  also DMRP_UNSUPPORTED
//   plan() of a global planner             also DMRP_NO_SOLUTION, DMRP_TIMEOUT and DMRP_UNSUPPORTED
//   step() of a local controller           also DMRP_NO_SOLUTION; step_all() says so in each command's status
//   begin() of a metric                    also DMRP_UNSUPPORTED: it has no values for this trial
//
// Any other status is a fault (abi_breach): the host uses no output of that call. Open list: a minor version may add
// answers from 16 to 31, which a reader takes for DMRP_NO_SOLUTION, and errors from 32 to 63, for DMRP_ERROR.

#endif
