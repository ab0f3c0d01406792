/* SPDX-License-Identifier: MIT */
// c_plugin.h: the entry of a library of plugins in C, by one macro at the end of its source. What it writes is compiled
// into the library, like the C++ layer, and is no part of the binary contract.
//
//   static int32_t make(const dmrp_host* host, const dmrp_descriptor* plugin, const dmrp_params* params,
//                       dmrp_plugin* out) {
//     out->self = calloc(1, sizeof(dmrp_instance));
//     if (!out->self) return DMRP_OUT_OF_MEMORY;
//     out->self->gain = dmrp_param_of(params, "gain")->number;
//     out->table = &controller;
//     out->start = start;
//     out->destroy = destroy;
//     return DMRP_OK;
//   }
//   DMRP_C_PLUGINS(make, &hold);
#ifndef DMRP_C_PLUGIN_H
#define DMRP_C_PLUGIN_H

#include <string.h>

#include "dmrp.h"

#ifdef __cplusplus
extern "C" {
#endif

// The value of a declared key; NULL for another one.
static inline const dmrp_param_value* dmrp_param_of(const dmrp_params* params, const char* key) {
  uint32_t i;
  for (i = 0; i < params->count; ++i) {
    const dmrp_param_value* value = DMRP_AT(dmrp_param_value, params->values, params->stride, i);
    if (strcmp(value->key, key) == 0) return value;
  }
  return NULL;
}

// `make` fills in `out` for the plugin with this descriptor, as entry.h says of create(); the descriptors follow.
#define DMRP_C_PLUGINS(make, ...)                                                                                    \
  static const dmrp_descriptor* const dmrp_c_descriptors[] = {__VA_ARGS__};                                          \
  static int32_t dmrp_c_init(const dmrp_entry* self_, const dmrp_host* host_) {                                      \
    (void)self_;                                                                                                     \
    (void)host_;                                                                                                     \
    return DMRP_OK;                                                                                                  \
  }                                                                                                                  \
  static void dmrp_c_deinit(const dmrp_entry* self_) {                                                               \
    (void)self_;                                                                                                     \
  }                                                                                                                  \
  static uint32_t dmrp_c_count(const dmrp_entry* self_) {                                                            \
    (void)self_;                                                                                                     \
    return (uint32_t)(sizeof(dmrp_c_descriptors) / sizeof(dmrp_c_descriptors[0]));                                   \
  }                                                                                                                  \
  static const dmrp_descriptor* dmrp_c_descriptor(const dmrp_entry* self_, uint32_t index_) {                        \
    return index_ < dmrp_c_count(self_) ? dmrp_c_descriptors[index_] : NULL;                                         \
  }                                                                                                                  \
  static int32_t dmrp_c_create(const dmrp_entry* self_, const dmrp_host* host_, const char* id_,                     \
                               const dmrp_params* params_, dmrp_plugin* out_) {                                      \
    uint32_t at_;                                                                                                    \
    for (at_ = 0; at_ < dmrp_c_count(self_); ++at_)                                                                  \
      if (strcmp(id_, dmrp_c_descriptors[at_]->id) == 0) return make(host_, dmrp_c_descriptors[at_], params_, out_); \
    host_->set_error(host_, "no plugin of that id in this library");                                                 \
    return DMRP_ERROR;                                                                                               \
  }                                                                                                                  \
  DMRP_ENTRY = {sizeof(dmrp_entry), DMRP_TARGET_MINOR, DMRP_TARGET_MINOR, DMRP_ABI_DRAFT, dmrp_c_init,               \
                dmrp_c_deinit,      dmrp_c_count,      dmrp_c_descriptor, dmrp_c_create}

#ifdef __cplusplus
}
#endif

#endif
