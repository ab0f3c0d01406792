/* SPDX-License-Identifier: MIT */
// A local controller in C99, without the C++ layer: it turns on the spot at a rate that is its only parameter.
#include <dmrp/dmrp.h>
#include <stdlib.h>
#include <string.h>

struct dmrp_instance {
  double rate;
};

static const dmrp_param_spec params[] = {{.key = "rate",
                                          .type = DMRP_PARAM_DOUBLE,
                                          .number = 0.5,
                                          .unit = "rad/s",
                                          .doc = "how fast it turns",
                                          .minimum = 0.0,
                                          .maximum = 1.0}};

static const dmrp_controller_traits traits = {.struct_size = sizeof(dmrp_controller_traits),
                                              .kinematics = 1u << DMRP_KINEMATICS_DIFFERENTIAL};

static const dmrp_descriptor turner = {.struct_size = sizeof(dmrp_descriptor),
                                       .kind = DMRP_KIND_LOCAL_CONTROLLER,
                                       .id = "org.example.turner",
                                       .name = "Turner",
                                       .version = "1.0.0",
                                       .vendor = "Example",
                                       .license = "MIT",
                                       .summary = "turns on the spot",
                                       .params = params,
                                       .param_count = 1,
                                       .param_stride = sizeof(dmrp_param_spec),
                                       .traits = &traits};

static int32_t set_path(dmrp_instance* self, const dmrp_path_update* update) {
  (void)self;
  return update->path->count > 0 ? DMRP_OK : DMRP_ERROR;
}

static int32_t step(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command) {
  (void)observation;
  command->omega = self->rate;
  return DMRP_OK;
}

static const dmrp_local_controller controller = {
    .struct_size = sizeof(dmrp_local_controller), .set_path = set_path, .step = step};

static int32_t start(dmrp_instance* self, const dmrp_start* begin) {
  (void)self;
  return begin->robot == DMRP_NO_ROBOT ? DMRP_ERROR : DMRP_OK;
}

static void destroy(dmrp_instance* self) {
  free(self);
}

static int32_t init(const dmrp_entry* self, const dmrp_host* host) {
  (void)self;
  (void)host;
  return DMRP_OK;
}
static void deinit(const dmrp_entry* self) {
  (void)self;
}
static uint32_t plugin_count(const dmrp_entry* self) {
  (void)self;
  return 1;
}
static const dmrp_descriptor* descriptor(const dmrp_entry* self, uint32_t index) {
  (void)self;
  return index == 0 ? &turner : NULL;
}

static int32_t create(const dmrp_entry* self, const dmrp_host* host, const char* id, const dmrp_params* values,
                      dmrp_plugin* out) {
  (void)self;
  if (strcmp(id, turner.id) != 0) {
    host->set_error(host, "no plugin of that id in this library");
    return DMRP_ERROR;
  }
  out->self = malloc(sizeof(dmrp_instance));
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->self->rate = DMRP_AT(dmrp_param_value, values->values, values->stride, 0)->number;
  out->table = &controller;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_ENTRY = {sizeof(dmrp_entry), DMRP_ABI_MINOR, DMRP_TARGET_MINOR, DMRP_ABI_DRAFT, init, deinit, plugin_count,
              descriptor,         create};
