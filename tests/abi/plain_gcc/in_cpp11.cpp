// SPDX-License-Identifier: MIT
// A pedestrian model in C++11 with the C headers alone: everybody stands still.
#include <dmrp/dmrp.h>

#include <cstdint>
#include <cstring>
#include <new>

struct dmrp_instance {
  std::uint64_t steps;
};

namespace {

std::int32_t step(dmrp_instance* self, const dmrp_crowd*, dmrp_motions*) {
  ++self->steps;
  return DMRP_OK;
}
const dmrp_pedestrian_model model = {sizeof(dmrp_pedestrian_model), 0, step};

const dmrp_descriptor& describe() {
  static dmrp_descriptor still;
  still.struct_size = sizeof(still);
  still.kind = DMRP_KIND_PEDESTRIAN_MODEL;
  still.id = "org.example.still";
  still.name = "Still";
  still.version = "1.0.0";
  return still;
}

std::int32_t init(const dmrp_entry*, const dmrp_host*) {
  return DMRP_OK;
}
void deinit(const dmrp_entry*) {}
std::uint32_t plugin_count(const dmrp_entry*) {
  return 1;
}
const dmrp_descriptor* descriptor(const dmrp_entry*, std::uint32_t index) {
  return index == 0 ? &describe() : nullptr;
}

std::int32_t start(dmrp_instance* self, const dmrp_start*) {
  self->steps = 0;
  return DMRP_OK;
}
void destroy(dmrp_instance* self) {
  delete self;
}

std::int32_t create(const dmrp_entry*, const dmrp_host*, const char* id, const dmrp_params*, dmrp_plugin* out) {
  if (std::strcmp(id, describe().id) != 0) return DMRP_ERROR;
  out->self = new (std::nothrow) dmrp_instance();
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->table = &model;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

}  // namespace

DMRP_ENTRY = {sizeof(dmrp_entry),
              DMRP_TARGET_MINOR,
              DMRP_TARGET_MINOR,
              DMRP_ABI_DRAFT,
              init,
              deinit,
              plugin_count,
              descriptor,
              create};
