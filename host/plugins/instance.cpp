// SPDX-License-Identifier: MIT
#include "host/plugins/instance.hpp"

#include <dmrp/global_planner.h>
#include <dmrp/local_controller.h>
#include <dmrp/metric.h>
#include <dmrp/pedestrian_model.h>

#include "host/plugins/parameter_table.hpp"
#include "host/program/version.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t create_budget_ns = 10'000'000'000;

// Every function of v1.0 must be there.
bool table_is_whole(const void* table, std::uint32_t kind) {
  if (!table) return false;
  switch (kind) {
    case DMRP_KIND_GLOBAL_PLANNER: {
      const auto& t = *static_cast<const dmrp_global_planner*>(table);
      return DMRP_HAS(&t, plan) && t.plan;
    }
    case DMRP_KIND_LOCAL_CONTROLLER: {
      const auto& t = *static_cast<const dmrp_local_controller*>(table);
      return DMRP_HAS(&t, step) && t.set_path && t.step;
    }
    case DMRP_KIND_PEDESTRIAN_MODEL: {
      const auto& t = *static_cast<const dmrp_pedestrian_model*>(table);
      return DMRP_HAS(&t, step) && t.step;
    }
    case DMRP_KIND_METRIC: {
      const auto& t = *static_cast<const dmrp_metric*>(table);
      return DMRP_HAS(&t, finish) && t.begin && t.observe && t.finish;
    }
    default:
      return false;
  }
}

}  // namespace

Instance::Instance(const Library& library, const PluginUse& use, std::int32_t robot, CallGuard& guard, LogSink log)
    : id_(use.info.id), robot_(robot), guard_(guard), log_(std::move(log)) {
  host_.struct_size = sizeof(host_);
  host_.context = this;
  host_.name = "dmrp-host";
  host_.version = version;
  host_.log = [](const dmrp_host* host, std::int32_t level, const char* text) {
    const auto& instance = *static_cast<const Instance*>(host->context);
    instance.log_(level, instance.id_, text ? text : "");
  };
  host_.set_error = [](const dmrp_host* host, const char* text) {
    static_cast<const Instance*>(host->context)->guard_.set_error(text);
  };
  host_.should_stop = [](const dmrp_host* host) -> std::int32_t {
    return static_cast<const Instance*>(host->context)->guard_.should_stop();
  };
  host_.get_extension = [](const dmrp_host* host, const char* id) -> const void* {
    const auto& instance = *static_cast<const Instance*>(host->context);
    return id && instance.extensions_ ? instance.extensions_(id) : nullptr;
  };

  const ParameterTable parameters(use.parameters);
  dmrp_plugin made{};
  made.struct_size = sizeof(made);
  call("create", 0, create_budget_ns,
       [&] { return library.entry().create(&host_, id_.c_str(), &parameters.get(), &made); });
  if (!made.self || !made.start || !made.destroy || !table_is_whole(made.interface_, use.info.kind))
    throw PluginFault(fault_kind::abi_breach, site("create", 0), "returned OK but did not fill in all of dmrp_plugin");
  plugin_ = made;
}

Instance::~Instance() {
  try {
    if (plugin_.self)
      guard_.call(site("destroy", 0), create_budget_ns, [&] { return plugin_.destroy(plugin_.self), 0; });
  } catch (const PluginFault& fault) {
    log_(DMRP_LOG_ERROR, id_, std::string("destroy: ") + fault.what());
  }
}

void Instance::start(const dmrp_world& world, std::uint64_t seed, std::int64_t budget_ns) {
  call("start", 0, budget_ns, [&] { return plugin_.start(plugin_.self, &world, seed); });
}

}  // namespace dmrp::host
