/* SPDX-License-Identifier: MIT */
// messages.h: an extension that no contract has yet, declared by the author of a plugin for hosts that want to try it.
#ifndef DMRP_TESTS_MESSAGES_H
#define DMRP_TESTS_MESSAGES_H

#include <dmrp/abi.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DRAFT_MESSAGES "draft/org.example.messages/1"

// A message as it arrives. Array element.
typedef struct draft_message {
  uint32_t from;  // robot
  uint32_t size;  // bytes
  int64_t t_ns;   // when it was sent
  const void* data;
} draft_message;

// What has arrived for a robot since its last call. Valid until the call returns.
typedef struct draft_inbox {
  uint32_t struct_size;
  uint32_t count;
  uint32_t stride;
  uint32_t reserved;
  const draft_message* messages;
} draft_inbox;

typedef struct draft_messages draft_messages;
struct draft_messages {
  uint32_t struct_size;
  uint32_t reserved;
  void* context;  // the host's own

  // Sends to all other robots; `data` is copied. It arrives at their next control tick.
  // [step]
  int32_t (*send)(const draft_messages* messages, uint32_t from, const void* data, uint32_t size);

  // [step]
  const draft_inbox* (*receive)(const draft_messages* messages, uint32_t robot);
};

DMRP_ASSERT_SIZE(draft_message, 24);
DMRP_ASSERT_SIZE(draft_inbox, 24);
DMRP_ASSERT_SIZE(draft_messages, 32);

#ifdef __cplusplus
}
#endif

#endif
