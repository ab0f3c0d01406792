/* SPDX-License-Identifier: MIT */
// A controller in C99 that reads all that it is handed, and lets it decide its command.
#include <dmrp/dmrp.h>
#include <stdlib.h>

#include "tests/abi/old_plugins/mixed_world.h"

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
  mix(&self->all, (double)start->robot), mix(&self->all, (double)start->seed);
  mix_world(&self->all, start->world);
  self->lidar = (const dmrp_lidar*)self->host->get_extension(self->host, DMRP_EXT_LIDAR);
  return DMRP_OK;
}

static int32_t set_path(dmrp_instance* self, const dmrp_path_update* update) {
  mixed* all = &self->all;
  mix(all, update->robot), mix(all, (double)update->revision), mix(all, update->flags), mix(all, update->path->flags);
  for (uint32_t i = 0; i < update->path->count; ++i) {
    const dmrp_waypoint* waypoint = DMRP_AT(dmrp_waypoint, update->path->waypoints, update->path->stride, i);
    mix(all, waypoint->x), mix(all, waypoint->y), mix(all, waypoint->theta);
    mix_time(all, waypoint->t_ns), mix(all, waypoint->goal_index);
  }
  return DMRP_OK;
}

static int32_t step(dmrp_instance* self, const dmrp_observation* now, dmrp_command* command) {
  mixed* all = &self->all;
  mix(all, now->robot), mix_time(all, now->t_ns), mix_time(all, now->dt_ns), mix_pose(all, now->pose);
  mix_twist(all, now->velocity), mix_twist(all, now->applied), mix_goal(all, now->goal), mix(all, now->goal_index);
  mix(all, now->goal_count), mix(all, now->progress_m), mix(all, now->progress_waypoint);
  mix_limits(all, now->limits), mix_footprint(all, now->footprint), mix(all, now->steering_angle);
  for (uint32_t i = 0; i < now->agent_count; ++i) {
    const dmrp_agent* agent = DMRP_AT(dmrp_agent, now->agents, now->agent_stride, i);
    mix(all, (double)agent->id), mix(all, agent->kind), mix(all, agent->state), mix_pose(all, agent->pose);
    mix_vec2(all, agent->velocity), mix(all, agent->radius_m);
  }
  if (self->lidar) {
    const dmrp_scan* scan = self->lidar->scan(self->lidar, now->robot);
    mix_time(all, scan->t_ns), mix(all, scan->angle_min), mix(all, scan->angle_increment), mix(all, scan->range_min);
    mix(all, scan->range_max);
    for (uint32_t i = 0; i < scan->count; ++i) mix(all, (double)scan->ranges[i]);
  }
  command->v_x = 0.2 + 0.1 * mixed_value(all);
  command->omega = self->gain * mixed_value(all);
  return DMRP_OK;
}

static void destroy(dmrp_instance* self) {
  free(self);
}
static const dmrp_local_controller controller = {
    .struct_size = sizeof(dmrp_local_controller), .set_path = set_path, .step = step};

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
  return index == 0 ? &mixing : NULL;
}

static int32_t create(const dmrp_entry* self, const dmrp_host* host, const char* id, const dmrp_params* params,
                      dmrp_plugin* out) {
  (void)self;
  if (strcmp(id, mixing.id) != 0) return DMRP_ERROR;
  dmrp_instance* instance = (dmrp_instance*)calloc(1, sizeof(dmrp_instance));
  if (!instance) return DMRP_OUT_OF_MEMORY;
  instance->host = host;
  instance->gain = DMRP_AT(dmrp_param_value, params->values, params->stride, 0)->number;
  out->self = instance;
  out->table = &controller;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_ENTRY = {sizeof(dmrp_entry), DMRP_ABI_MINOR, DMRP_TARGET_MINOR, DMRP_ABI_DRAFT, init, deinit, plugin_count,
              descriptor,         create};
