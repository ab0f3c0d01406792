/* SPDX-License-Identifier: MIT */
// status.h: what a plugin function returns, and what may still be called after it.
#ifndef DMRP_STATUS_H
#define DMRP_STATUS_H

#include "abi.h"

// Every plugin function that can fail returns one of these as int32_t. Text goes to host->set_error().
#define DMRP_OK 0             // done; outputs are valid
#define DMRP_WARNING 1        // done, outputs are valid; the text of set_error() is logged
#define DMRP_NO_SOLUTION 2    // a correct answer: there is none. State unchanged, outputs ignored. Never a fault
#define DMRP_TIMEOUT 3        // the budget or should_stop() ended the call; outputs are valid if they are complete
#define DMRP_OUT_OF_MEMORY 4  // like DMRP_ERROR, recorded under its own name
#define DMRP_ERROR 5          // the instance is unusable until the next start(); the trial ends as a fault
#define DMRP_FATAL 6          // the library is unusable; no function of it but deinit() is called again

#endif
