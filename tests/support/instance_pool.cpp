// SPDX-License-Identifier: MIT
#include "tests/support/instance_pool.hpp"

namespace dmrp::host {

InstancePool::InstancePool(const std::vector<LibraryUse>& libraries, CallGuard& guard, LogSink log)
    : guard_(guard), log_(std::move(log)) {
  for (const LibraryUse& use : libraries) {
    auto library = std::make_unique<Library>(use.file);
    auto host =
        std::make_unique<PluginHost>("library", library->file().string(), std::vector<std::string>(), guard_, log_);
    guard_.call(host->c(), {use.written, "init", 0, -1}, init_budget_ns, Answers::no_other,
                [&] { return library->init(host->c()); });
    libraries_.push_back({std::move(library), std::move(host)});
  }
}

InstancePool::~InstancePool() {
  clear();
  for (const LoadedLibrary& loaded : libraries_) {
    try {
      guard_.call(loaded.host->c(), {"library", "deinit", 0, -1}, init_budget_ns, Answers::no_other,
                  [&] { return loaded.library->deinit(), DMRP_OK; });
    } catch (const PluginFault& fault) {
      log_(DMRP_LOG_ERROR, "library", std::string("deinit: ") + fault.what());
    }
  }
}

Instance& InstancePool::get(const PluginUse& use, std::int32_t robot) {
  auto& instance = instances_[{&use, robot}];
  if (!instance) instance = std::make_unique<Instance>(*libraries_.at(use.library).library, use, robot, guard_, log_);
  return *instance;
}

}  // namespace dmrp::host
