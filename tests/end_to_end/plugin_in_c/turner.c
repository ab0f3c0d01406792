/* SPDX-License-Identifier: MIT */
// A local controller in C99, without the C++ layer: it turns on the spot at a rate that is its only parameter.
#include <dmrp/c_plugin.h>
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

static int32_t make(const dmrp_host* host, const dmrp_descriptor* plugin, const dmrp_params* values, dmrp_plugin* out) {
  (void)host;
  (void)plugin;
  out->self = malloc(sizeof(dmrp_instance));
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->self->rate = dmrp_param_of(values, "rate")->number;
  out->table = &controller;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_C_PLUGINS(make, &turner);
