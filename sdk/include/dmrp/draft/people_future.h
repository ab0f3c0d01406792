/* SPDX-License-Identifier: MIT */
// draft/people_future.h: where all people would be in the next seconds, in the same crowd without robots. An extension of
// the host for local controllers that bound what prediction is worth; no robot can know this.
//
// A draft: it may change or go with any version, and dmrp.h does not include it.
#ifndef DMRP_DRAFT_PEOPLE_FUTURE_H
#define DMRP_DRAFT_PEOPLE_FUTURE_H

#include "../observation.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DMRP_DRAFT_PEOPLE_FUTURE "draft/dmrp.people_future/1"

// All people at one time.
typedef struct dmrp_people_frame {
  uint32_t struct_size;
  uint32_t count;
  uint32_t stride;  // of people
  uint32_t reserved;
  int64_t t_ns;
  const dmrp_agent* people;  // NULL if there are none
} dmrp_people_frame;

typedef struct dmrp_people_future dmrp_people_future;
struct dmrp_people_future {
  uint32_t struct_size;
  uint32_t last;  // the greatest `periods_ahead`
  void* context;  // the host's own

  // The people `periods_ahead` control periods after the present one. People have the ids of the observation, whose
  // agents are elsewhere where robots have held them up. NULL beyond `last`. Valid until the current call returns.
  // [step]
  const dmrp_people_frame* (*at)(const dmrp_people_future* extension, uint32_t periods_ahead);
};

DMRP_ASSERT_SIZE(dmrp_people_frame, 32);
DMRP_ASSERT_SIZE(dmrp_people_future, 24);

#ifdef __cplusplus
}
#endif

#endif
