// SPDX-License-Identifier: MIT
#include "host/plugins/instance.hpp"

#include <dmrp/parameter.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "host/plugins/calls/output.hpp"
#include "host/plugins/grown_struct.hpp"
#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

namespace {

// Parameter values as the C structs that create() reads. Refers to `values`, which outlives it. The table and its
// elements are longer than this host's by `grown_bytes`, a multiple of 8.
class ParameterTable {
 public:
  explicit ParameterTable(const std::vector<ParameterValue>& values, std::uint32_t grown_bytes = 0)
      : table_({}, grown_bytes) {
    const std::size_t words = (sizeof(dmrp_param_value) + grown_bytes) / sizeof(std::uint64_t);
    elements_.resize(values.size() * words);
    texts_.reserve(values.size());
    for (const ParameterValue& value : values) {
      auto& texts = texts_.emplace_back();
      for (const std::string& text : value.texts) texts.push_back(text.c_str());
      const dmrp_param_value element = {
          value.key.c_str(),    value.type,   static_cast<std::uint32_t>(value.numbers.size() + value.texts.size()),
          value.integer,        value.number, value.text.c_str(),
          value.numbers.data(), texts.data()};
      std::memcpy(&elements_[(texts_.size() - 1) * words], &element, sizeof(element));
    }
    table_.c.count = static_cast<std::uint32_t>(values.size());
    table_.c.stride = static_cast<std::uint32_t>(words * sizeof(std::uint64_t));
    table_.c.values = reinterpret_cast<const dmrp_param_value*>(elements_.data());
  }
  ParameterTable(const ParameterTable&) = delete;
  ParameterTable& operator=(const ParameterTable&) = delete;

  const dmrp_params& get() const { return table_.c; }

 private:
  std::vector<std::vector<const char*>> texts_;
  std::vector<std::uint64_t> elements_;  // dmrp_param_value, each with the stride
  GrownStruct<dmrp_params> table_;
};

constexpr std::int64_t create_budget_ns = 10'000'000'000;

std::vector<std::string> declared_extensions(const PluginInfo& info) {
  std::vector<std::string> ids = info.needs;
  ids.insert(ids.end(), info.uses.begin(), info.uses.end());
  return ids;
}

// The first function that a kind's table lacks; "" if it is whole.
std::string missing_function(const dmrp_global_planner& table, const PluginInfo&) {
  return table.plan ? "" : "plan";
}
std::string missing_function(const dmrp_local_controller& table, const PluginInfo& info) {
  if (!table.set_path) return "set_path";
  if (info.has_flag(DMRP_FLAG_CENTRAL)) return table.step_all ? "" : "step_all (its descriptor has DMRP_FLAG_CENTRAL)";
  return table.step ? "" : "step (its descriptor lacks DMRP_FLAG_CENTRAL)";
}
std::string missing_function(const dmrp_pedestrian_model& table, const PluginInfo&) {
  return table.step ? "" : "step";
}
std::string missing_function(const dmrp_metric& table, const PluginInfo&) {
  return !table.begin ? "begin" : !table.observe ? "observe" : !table.finish ? "finish" : "";
}

template <class Table>
std::string missing_in(const void* table, const PluginInfo& info) {
  const auto& theirs = *static_cast<const Table*>(table);
  if (!has_v1_0<Table>(theirs.struct_size))
    return fmt::format("table->struct_size ({}, at least {})", theirs.struct_size, size_v1_0<Table>);
  const std::string function = missing_function(theirs, info);
  return function.empty() ? "" : "table->" + function;
}

std::string missing_in_interface(const void* table, const PluginInfo& info) {
  switch (info.kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return missing_in<dmrp_global_planner>(table, info);
    case DMRP_KIND_LOCAL_CONTROLLER:
      return missing_in<dmrp_local_controller>(table, info);
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return missing_in<dmrp_pedestrian_model>(table, info);
    default:
      return missing_in<dmrp_metric>(table, info);
  }
}

// The first part that create() left out; "" if it is whole.
std::string missing_part(const dmrp_plugin& plugin, const PluginInfo& info) {
  if (!plugin.self) return "self";
  if (!plugin.start) return "start";
  if (!plugin.destroy) return "destroy";
  if (!plugin.table) return "table";
  return missing_in_interface(plugin.table, info);
}

// A later minor version may give it a meaning that this host does not know.
void refuse_reserved(const char* field, std::uint32_t value, const CallSite& site) {
  if (value != 0)
    throw PluginFault(fault_kind::abi_breach, site,
                      fmt::format("returned OK with {} in dmrp_plugin.{}, which must be 0", value, field));
}

// All tables begin alike.
std::uint32_t reserved_in(const void* table) {
  static_assert(offsetof(dmrp_global_planner, reserved) == offsetof(dmrp_metric, reserved) &&
                offsetof(dmrp_local_controller, reserved) == offsetof(dmrp_pedestrian_model, reserved) &&
                offsetof(dmrp_global_planner, reserved) == offsetof(dmrp_local_controller, reserved));
  return static_cast<const dmrp_metric*>(table)->reserved;
}

}  // namespace

Instance::Instance(const Library& library, const PluginUse& use, std::int32_t robot, CallGuard& guard, LogSink log,
                   std::uint32_t grown_bytes)
    : id_(use.info.id),
      robot_(robot),
      guard_(guard),
      grown_bytes_(grown_bytes),
      host_(id_, library.file().string(), declared_extensions(use.info), guard, std::move(log), grown_bytes) {
  const ParameterTable parameters(use.parameters, grown_bytes);
  Output<dmrp_plugin> made;
  call("create", 0, create_budget_ns, Answers::no_other,
       [&] { return library.create(host_.c(), id_.c_str(), &parameters.get(), &made.value); });
  made.check(site("create", 0), "dmrp_plugin");
  const dmrp_plugin& plugin = made.value;
  if (const std::string missing = missing_part(plugin, use.info); !missing.empty())
    throw PluginFault(fault_kind::abi_breach, site("create", 0),
                      "returned OK but did not fill in dmrp_plugin." + missing);
  refuse_reserved("reserved", plugin.reserved, site("create", 0));
  refuse_reserved("table->reserved", reserved_in(plugin.table), site("create", 0));
  plugin_ = plugin;
}

Instance::~Instance() {
  try {
    if (plugin_.self)
      guard_.call(host_.c(), site("destroy", 0), create_budget_ns, Answers::no_other,
                  [&] { return plugin_.destroy(plugin_.self), DMRP_OK; });
  } catch (const PluginFault& fault) {
    host_.log(DMRP_LOG_ERROR, std::string("destroy: ") + fault.what());
  }
}

void Instance::start(const dmrp_world& world, std::uint64_t seed, std::int64_t budget_ns) {
  const dmrp_start start = {sizeof(start), robot_, seed, &world};
  call("start", 0, budget_ns, Answers::unsupported, [&] { return plugin_.start(plugin_.self, &start); });
}

void Instance::end_trial(const dmrp_trial_end& end, std::int64_t step, std::int64_t budget_ns) {
  if (!plugin_.trial_end) return;
  call("trial_end", step, budget_ns, Answers::no_other, [&] { return plugin_.trial_end(plugin_.self, &end); });
}

}  // namespace dmrp::host
