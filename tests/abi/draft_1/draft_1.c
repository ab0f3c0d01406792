/* SPDX-License-Identifier: MIT */
// The entry of a library that was built with draft 1 of the contract, as a host sees it before it calls anything.
#include <stdint.h>
#include <stdlib.h>

static int32_t init(const void* host) {
  (void)host;
  abort();  // a host of another draft calls nothing
}
static void deinit(void) {
  abort();
}
static uint32_t plugin_count(void) {
  abort();
}
static const void* descriptor(uint32_t index) {
  (void)index;
  abort();
}
static int32_t create(const void* host, const char* id, const void* params, void* out) {
  (void)host;
  (void)id;
  (void)params;
  (void)out;
  abort();
}

extern const struct entry_of_draft_1 {
  uint32_t struct_size;
  uint32_t abi_minor;
  uint32_t min_host_minor;
  uint32_t abi_draft;
  int32_t (*init)(const void* host);
  void (*deinit)(void);
  uint32_t (*plugin_count)(void);
  const void* (*descriptor)(uint32_t index);
  int32_t (*create)(const void* host, const char* id, const void* params, void* out);
} dmrp_entry_v1;
const struct entry_of_draft_1 dmrp_entry_v1 = {
    sizeof(struct entry_of_draft_1), 0, 0, 1, init, deinit, plugin_count, descriptor, create};
