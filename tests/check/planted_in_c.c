/* SPDX-License-Identifier: MIT */
// Controllers in C that cannot be used: of another major version (PLANTED_MAJOR), with an undefined symbol
// (PLANTED_UNDEFINED), or else with the part of dmrp_plugin left out that the environment variable DMRP_TEST_FAULT names;
// "reads freed memory" is for AddressSanitizer.
#include <dmrp/dmrp.h>
#include <stdlib.h>
#include <string.h>

#ifdef PLANTED_MAJOR
extern DMRP_EXPORT const int dmrp_entry_v2;
const int dmrp_entry_v2 = 2;
#else

#ifdef PLANTED_UNDEFINED
void planted_missing(void);
#endif

struct dmrp_instance {
  int unused;
};
static struct dmrp_instance instance;

static const dmrp_descriptor descriptor_of_it = {.struct_size = sizeof(dmrp_descriptor),
                                                 .kind = DMRP_KIND_LOCAL_CONTROLLER,
                                                 .id = "test.check.in_c",
                                                 .name = "In C",
                                                 .version = "1.0.0"};

static int32_t start(dmrp_instance* self, const dmrp_start* begin) {
  (void)self;
  (void)begin;
#ifdef PLANTED_UNDEFINED
  planted_missing();
#endif
  return DMRP_OK;
}
static int32_t set_path(dmrp_instance* self, const dmrp_path_update* update) {
  (void)self;
  (void)update;
  return DMRP_OK;
}
static int has(const char* fault) {
  const char* const planted = getenv("DMRP_TEST_FAULT");
  return planted && strcmp(planted, fault) == 0;
}

static int32_t step(dmrp_instance* self, const dmrp_observation* observation, dmrp_command* command) {
  (void)self;
  (void)observation;
  if (has("reads freed memory")) {
    double* volatile speed = malloc(sizeof(double));
    *speed = 0.5;
    free(speed);
    command->v_x = *speed;
  }
  return DMRP_OK;
}
static void destroy(dmrp_instance* self) {
  (void)self;
}

static const dmrp_local_controller whole = {
    .struct_size = sizeof(dmrp_local_controller), .set_path = set_path, .step = step};
static const dmrp_local_controller without_step = {.struct_size = sizeof(dmrp_local_controller), .set_path = set_path};

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
  return index == 0 ? &descriptor_of_it : NULL;
}

static int32_t create(const dmrp_entry* self, const dmrp_host* host, const char* id, const dmrp_params* params,
                      dmrp_plugin* out) {
  (void)self;
  (void)host;
  (void)id;
  (void)params;
  if (!has("no self")) out->self = &instance;
  if (!has("no interface")) out->table = has("no step") ? &without_step : &whole;
  if (!has("no start")) out->start = start;
  if (!has("no destroy")) out->destroy = destroy;
  return DMRP_OK;
}

// of a later minor version, which can do without it
DMRP_ENTRY = {sizeof(dmrp_entry), DMRP_ABI_MINOR + 1, 0,     DMRP_ABI_DRAFT, init, deinit,
              plugin_count,       descriptor,         create};
#endif
