// SPDX-License-Identifier: MIT
// instance_pool.hpp: the plugin libraries of an experiment in the process of a test or a benchmark, and their instances.
#pragma once

#include <compare>
#include <map>
#include <memory>
#include <vector>

#include "host/plugins/instance.hpp"

namespace dmrp::host {

class InstancePool {
 public:
  // Loads and initialises all libraries. Throws std::runtime_error in one line, or PluginFault.
  InstancePool(const std::vector<LibraryUse>& libraries, CallGuard& guard, LogSink log);
  ~InstancePool();
  InstancePool(const InstancePool&) = delete;
  InstancePool& operator=(const InstancePool&) = delete;

  // The instance for this use of a plugin, created by the first call. `use` is identified by its address and outlives the
  // pool. `robot`: of a local controller, -1 otherwise. Throws PluginFault.
  Instance& get(const PluginUse& use, std::int32_t robot);

  // Destroys all instances: after an error, new ones are safer.
  void clear() { instances_.clear(); }

 private:
  struct Key {
    const PluginUse* use;  // only for identity: no result depends on the order of the keys
    std::int32_t robot;
    auto operator<=>(const Key&) const = default;
  };

  CallGuard& guard_;
  LogSink log_;
  struct LoadedLibrary {
    std::unique_ptr<Library> library;
    std::unique_ptr<PluginHost> host;
  };
  std::vector<LoadedLibrary> libraries_;
  std::map<Key, std::unique_ptr<Instance>> instances_;
};

}  // namespace dmrp::host
