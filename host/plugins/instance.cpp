// SPDX-License-Identifier: MIT
#include "host/plugins/instance.hpp"

#include <vector>

#include "host/plugins/output.hpp"
#include "host/plugins/parameter_table.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t create_budget_ns = 10'000'000'000;

std::vector<std::string> declared_extensions(const PluginInfo& info) {
  std::vector<std::string> ids = info.needs;
  ids.insert(ids.end(), info.uses.begin(), info.uses.end());
  return ids;
}

bool is_whole(const dmrp_global_planner& table, const PluginInfo&) {
  return table.plan;
}
bool is_whole(const dmrp_local_controller& table, const PluginInfo& info) {
  return table.set_path && (info.has_flag(DMRP_FLAG_CENTRAL) ? table.step_all != nullptr : table.step != nullptr);
}
bool is_whole(const dmrp_pedestrian_model& table, const PluginInfo&) {
  return table.step;
}
bool is_whole(const dmrp_metric& table, const PluginInfo&) {
  return table.begin && table.observe && table.finish;
}

// Every function of v1.0 is there.
template <class Table>
bool table_is_whole(const void* table, const PluginInfo& info) {
  const auto& theirs = *static_cast<const Table*>(table);
  return has_v1_0<Table>(theirs.struct_size) && is_whole(theirs, info);
}

bool interface_is_whole(const void* table, const PluginInfo& info) {
  if (!table) return false;
  switch (info.kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return table_is_whole<dmrp_global_planner>(table, info);
    case DMRP_KIND_LOCAL_CONTROLLER:
      return table_is_whole<dmrp_local_controller>(table, info);
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return table_is_whole<dmrp_pedestrian_model>(table, info);
    case DMRP_KIND_METRIC:
      return table_is_whole<dmrp_metric>(table, info);
    default:
      return false;
  }
}

}  // namespace

Instance::Instance(const Library& library, const PluginUse& use, std::int32_t robot, CallGuard& guard, LogSink log)
    : id_(use.info.id),
      robot_(robot),
      guard_(guard),
      host_(id_, library.file().string(), declared_extensions(use.info), guard, std::move(log)) {
  const ParameterTable parameters(use.parameters);
  Output<dmrp_plugin> made;
  call("create", 0, create_budget_ns, Answers::no_other,
       [&] { return library.entry().create(host_.c(), id_.c_str(), &parameters.get(), &made.value); });
  made.check(site("create", 0), "dmrp_plugin");
  const dmrp_plugin& plugin = made.value;
  if (!plugin.self || !plugin.start || !plugin.destroy || !interface_is_whole(plugin.interface_, use.info))
    throw PluginFault(fault_kind::abi_breach, site("create", 0), "returned OK but did not fill in all of dmrp_plugin");
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
  call("start", 0, budget_ns, Answers::no_other, [&] { return plugin_.start(plugin_.self, &start); });
}

void Instance::end_trial(const dmrp_trial_end& end, std::int64_t step, std::int64_t budget_ns) {
  if (!plugin_.trial_end) return;
  call("trial_end", step, budget_ns, Answers::no_other, [&] { return plugin_.trial_end(plugin_.self, &end); });
}

}  // namespace dmrp::host
