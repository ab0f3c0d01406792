/* SPDX-License-Identifier: MIT */
// A controller in C99 that reads all that it is handed, and lets it decide its command.
#include <dmrp/c_plugin.h>
#include <mixed_fields.h>
#include <stdlib.h>

struct dmrp_instance {
  const dmrp_host* host;
  const dmrp_lidar* lidar;
  double gain;
  mixed all;
};

static const char* const uses[] = {DMRP_EXT_LIDAR};
static const dmrp_param_spec gain = {
    .key = "gain", .type = DMRP_PARAM_DOUBLE, .number = 0.5, .unit = "1", .doc = "of all", .maximum = 1.0};
static const dmrp_descriptor mixing = {.struct_size = sizeof(dmrp_descriptor),
                                       .kind = DMRP_KIND_LOCAL_CONTROLLER,
                                       .id = "org.example.mixing_in_c",
                                       .name = "Mixing",
                                       .version = "1.0.0",
                                       .uses = uses,
                                       .uses_count = 1,
                                       .params = &gain,
                                       .param_count = 1,
                                       .param_stride = sizeof(dmrp_param_spec)};

static int32_t start(dmrp_instance* self, const dmrp_start* start) {
  self->all.sum = 0.0;
  mix_start(&self->all, start);
  self->lidar = (const dmrp_lidar*)self->host->get_extension(self->host, DMRP_EXT_LIDAR);
  return DMRP_OK;
}

static int32_t set_path(dmrp_instance* self, const dmrp_path_update* update) {
  mix_path_update(&self->all, update);
  return DMRP_OK;
}

static int32_t step(dmrp_instance* self, const dmrp_observation* now, dmrp_command* command) {
  mixed* all = &self->all;
  mix_observation(all, now);
  if (self->lidar) mix_scan(all, self->lidar->scan(self->lidar, now->robot));
  command->v_x = 0.2 + 0.1 * mixed_value(all);
  command->omega = self->gain * mixed_value(all);
  return DMRP_OK;
}

static void destroy(dmrp_instance* self) {
  free(self);
}
static const dmrp_local_controller controller = {
    .struct_size = sizeof(dmrp_local_controller), .set_path = set_path, .step = step};

static int32_t make(const dmrp_host* host, const dmrp_descriptor* plugin, const dmrp_params* params, dmrp_plugin* out) {
  (void)plugin;
  dmrp_instance* instance = (dmrp_instance*)calloc(1, sizeof(dmrp_instance));
  if (!instance) return DMRP_OUT_OF_MEMORY;
  instance->host = host;
  instance->gain = dmrp_param_of(params, "gain")->number;
  out->self = instance;
  out->table = &controller;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_C_PLUGINS(make, &mixing);
