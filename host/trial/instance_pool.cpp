// SPDX-License-Identifier: MIT
#include "host/trial/instance_pool.hpp"

#include "host/program/version.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t init_budget_ns = 10'000'000'000;

}  // namespace

InstancePool::InstancePool(const std::vector<LibraryUse>& libraries, CallGuard& guard, LogSink log)
    : guard_(guard), log_(std::move(log)) {
  for (const LibraryUse& use : libraries) {
    libraries_.push_back(std::make_unique<Library>(use.file));
    auto host = std::make_unique<dmrp_host>();
    host->struct_size = sizeof(dmrp_host);
    host->context = this;
    host->name = "dmrp-host";
    host->version = version;
    host->log = [](const dmrp_host* self, std::int32_t level, const char* text) {
      static_cast<const InstancePool*>(self->context)->log_(level, "library", text ? text : "");
    };
    host->set_error = [](const dmrp_host* self, const char* text) {
      static_cast<const InstancePool*>(self->context)->guard_.set_error(text);
    };
    host->should_stop = [](const dmrp_host* self) -> std::int32_t {
      return static_cast<const InstancePool*>(self->context)->guard_.should_stop();
    };
    host->get_extension = [](const dmrp_host*, const char*) -> const void* { return nullptr; };
    library_hosts_.push_back(std::move(host));
    guard_.call({use.written, "init", 0, -1}, init_budget_ns,
                [&] { return libraries_.back()->entry().init(library_hosts_.back().get()); });
  }
}

InstancePool::~InstancePool() {
  clear();
  for (const auto& library : libraries_) {
    try {
      guard_.call({"library", "deinit", 0, -1}, init_budget_ns, [&] { return library->entry().deinit(), DMRP_OK; });
    } catch (const PluginFault& fault) {
      log_(DMRP_LOG_ERROR, "library", std::string("deinit: ") + fault.what());
    }
  }
}

Instance& InstancePool::get(const PluginUse& use, std::int32_t robot) {
  auto& instance = instances_[{&use, robot}];
  if (!instance) instance = std::make_unique<Instance>(*libraries_.at(use.library), use, robot, guard_, log_);
  return *instance;
}

}  // namespace dmrp::host
