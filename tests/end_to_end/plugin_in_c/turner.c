/* SPDX-License-Identifier: MIT */
// A local controller in C99, without the C++ layer: it turns on the spot at a rate that is its only parameter.
#include <dmrp/dmrp.h>
#include <stdlib.h>
#include <string.h>

struct dmrp_instance {
  double rate;
};

static const dmrp_param_spec params[] = {
    {{"rate", DMRP_PARAM_DOUBLE, 0, 0, 0.5, NULL, NULL, NULL}, "rad/s", "how fast it turns", 0.0, 1.0, NULL, 0, 0}};

static const dmrp_descriptor turner = {.struct_size = sizeof(dmrp_descriptor),
                                       .kind = DMRP_KIND_LOCAL_CONTROLLER,
                                       .id = "org.example.turner",
                                       .name = "Turner",
                                       .version = "1.0.0",
                                       .vendor = "Example",
                                       .license = "MIT",
                                       .summary = "turns on the spot",
                                       .source = "",
                                       .params = params,
                                       .param_count = 1,
                                       .param_stride = sizeof(dmrp_param_spec)};

static int32_t set_path(dmrp_instance* self, const dmrp_path* path, uint64_t revision) {
  (void)self;
  (void)revision;
  return path->count > 0 ? DMRP_OK : DMRP_ERROR;
}

static int32_t step(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command) {
  (void)observation;
  command->omega = self->rate;
  return DMRP_OK;
}

static const dmrp_local_controller controller = {sizeof(dmrp_local_controller), 0, set_path, step};

static int32_t start(dmrp_instance* self, const dmrp_world* world, uint64_t seed) {
  (void)self;
  (void)world;
  (void)seed;
  return DMRP_OK;
}

static void destroy(dmrp_instance* self) {
  free(self);
}

static int32_t init(const dmrp_host* host) {
  (void)host;
  return DMRP_OK;
}
static void deinit(void) {}
static uint32_t plugin_count(void) {
  return 1;
}
static const dmrp_descriptor* descriptor(uint32_t index) {
  return index == 0 ? &turner : NULL;
}

static int32_t create(const dmrp_host* host, const char* id, const dmrp_params* values, dmrp_plugin* out) {
  if (strcmp(id, turner.id) != 0) {
    host->set_error(host, "no plugin of that id in this library");
    return DMRP_ERROR;
  }
  out->self = malloc(sizeof(dmrp_instance));
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->self->rate = DMRP_AT(dmrp_param_value, values->values, values->stride, 0)->number;
  out->interface_ = &controller;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_ENTRY = {sizeof(dmrp_entry), DMRP_ABI_MINOR, 0, DMRP_ABI_DRAFT, init, deinit, plugin_count, descriptor, create};
