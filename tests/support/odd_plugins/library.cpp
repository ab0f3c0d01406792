// SPDX-License-Identifier: MIT
// libdmrp_odd_plugins.so: plugins that use the contract in rare ways, or break it as their parameter `does` says. Written
// against the C headers, whose structs the C++ layer would fill in correctly.
//
// The entry and the descriptors can be written to: a test changes them before it loads the library.
#include <dmrp/entry.h>
#include <dmrp/ext/annotate.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/walking_grid.h>

#include <cstring>
#include <iterator>
#include <memory>

#include "tests/support/odd_plugins/controller.hpp"
#include "tests/support/odd_plugins/life_cycle.hpp"
#include "tests/support/odd_plugins/metric.hpp"
#include "tests/support/odd_plugins/people.hpp"
#include "tests/support/odd_plugins/planner.hpp"

namespace dmrp::test {
namespace {

const dmrp_param_spec does = {"does", DMRP_PARAM_STRING, 0,   0,   0.0,     "", nullptr, nullptr,
                              "",     "what it does",    0.0, 0.0, nullptr, 0,  0};
const char* const of_controllers[] = {DMRP_EXT_ANNOTATE, DMRP_EXT_LIDAR};
const char* const of_metrics[] = {DMRP_EXT_WALKING_GRID};
const dmrp_metric_value_spec odd_value = {"odd", "1", "free cells", DMRP_DIRECTION_NONE, 1u << DMRP_SUBJECT_SYSTEM, 0,
                                          0,     0.0, 0.0};
dmrp_planner_traits planner_traits = {sizeof(planner_traits), DMRP_CONNECTIVITY_4};
dmrp_metric_traits metric_traits = {sizeof(metric_traits), 0, &odd_value, 1, sizeof(odd_value)};

dmrp_descriptor described(std::uint32_t kind, const char* id, std::uint32_t flags = 0) {
  dmrp_descriptor out{};
  out.struct_size = sizeof(out);
  out.kind = kind;
  out.id = id;
  out.name = id;
  out.version = "1.0.0";
  out.flags = flags;
  out.params = &does;
  out.param_count = 1;
  out.param_stride = sizeof(does);
  if (kind == DMRP_KIND_GLOBAL_PLANNER) out.traits = &planner_traits;
  if (kind == DMRP_KIND_LOCAL_CONTROLLER) {
    out.uses = of_controllers;
    out.uses_count = std::size(of_controllers);
  }
  if (kind == DMRP_KIND_METRIC) {
    out.needed = of_metrics;
    out.needed_count = std::size(of_metrics);
    out.traits = &metric_traits;
  }
  return out;
}

struct Kind {
  dmrp_descriptor descriptor;
  const void* table;
  std::uint32_t table_size;
};

Kind kinds[] = {
    {described(DMRP_KIND_GLOBAL_PLANNER, "test.odd.planner"), &planner_table, sizeof(planner_table)},
    {described(DMRP_KIND_LOCAL_CONTROLLER, "test.odd.controller"), &controller_table, sizeof(controller_table)},
    {described(DMRP_KIND_LOCAL_CONTROLLER, "test.odd.central", DMRP_FLAG_CENTRAL), &central_table,
     sizeof(central_table)},
    {described(DMRP_KIND_PEDESTRIAN_MODEL, "test.odd.people"), &people_table, sizeof(people_table)},
    {described(DMRP_KIND_METRIC, "test.odd.metric"), &metric_table, sizeof(metric_table)},
    {described(77, "test.odd.stranger"), nullptr, 0},  // of a kind that no host of v1.0 knows
};

const void* table_of(const Kind& kind, dmrp_instance& self) {
  const int extra = self.extra("table");
  if (extra == 0 && !self.is("reserved table")) return kind.table;
  self.table.fill(unknown_byte);
  std::memcpy(self.table.data(), kind.table, kind.table_size);
  const auto size = static_cast<std::uint32_t>(static_cast<int>(kind.table_size) + extra);
  const std::uint32_t begin[] = {size, self.is("reserved table") ? 7u : 0u};
  std::memcpy(self.table.data(), begin, sizeof(begin));
  return self.table.data();
}

std::int32_t create(const dmrp_entry*, const dmrp_host* host, const char* id, const dmrp_params* params,
                    dmrp_plugin* out) {
  for (const Kind& kind : kinds) {
    if (std::strcmp(kind.descriptor.id, id) != 0) continue;
    auto self = std::make_unique<dmrp_instance>();
    self->host = host;
    self->does = DMRP_AT(dmrp_param_value, params->values, params->stride, 0)->text;
    const std::string beyond = self->after("overrun create");
    if (!beyond.empty()) std::memset(out, 0, out->struct_size + std::stoul(beyond));
    const std::int32_t status = self->status_of("create");
    out->table = table_of(kind, *self);
    out->start = &start;
    out->destroy = &destroy;
    out->trial_end = &trial_end;
    out->reserved = self->is("reserved plugin") ? 7 : 0;
    if (status > DMRP_WARNING) return status;
    out->self = self.get();
    living[out->self] = std::move(self);
    return status;
  }
  return DMRP_ERROR;
}

}  // namespace
}  // namespace dmrp::test

using namespace dmrp::test;

extern "C" {
extern DMRP_EXPORT dmrp_entry dmrp_entry_v1;
dmrp_entry dmrp_entry_v1 = {
    sizeof(dmrp_entry),
    DMRP_ABI_MINOR,
    0,
    DMRP_ABI_DRAFT,
    [](const dmrp_entry*, const dmrp_host*) -> std::int32_t { return DMRP_OK; },
    [](const dmrp_entry*) {},
    [](const dmrp_entry*) -> std::uint32_t { return std::size(kinds); },
    [](const dmrp_entry*, std::uint32_t index) -> const dmrp_descriptor* { return &kinds[index].descriptor; },
    &create};
}
