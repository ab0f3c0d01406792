// SPDX-License-Identifier: MIT
// instance.hpp: a plugin instance and its dmrp_host.
#pragma once

#include <dmrp/plugin.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/plugins/call_guard.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/plugin_use.hpp"

namespace dmrp::host {

// Receives the log lines of plugins: level (DMRP_LOG_*), plugin id, text.
using LogSink = std::function<void(std::int32_t level, const std::string& plugin, const std::string& text)>;

class Instance {
 public:
  // Creates it. `robot` is the robot of a local controller, -1 otherwise. Throws PluginFault.
  Instance(const Library& library, const PluginUse& use, std::int32_t robot, CallGuard& guard, LogSink log);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Sets the function behind get_extension(), which returns nullptr for unknown ids. Call it before start().
  void offer(std::function<const void*(const char* id)> extensions) { extensions_ = std::move(extensions); }

  // Begins a trial. Throws PluginFault.
  void start(const dmrp_world& world, std::uint64_t seed, std::int64_t budget_ns);

  // The kind's function table; functions that an older plugin lacks are nullptr.
  template <class Table>
  Table table() const {
    const auto& theirs = *static_cast<const Table*>(plugin_.interface_);
    Table ours{};
    std::memcpy(&ours, &theirs, std::min<std::size_t>(theirs.struct_size, sizeof(ours)));
    return ours;
  }

  dmrp_instance* self() const { return plugin_.self; }
  CallGuard& guard() const { return guard_; }
  CallSite site(const char* function, std::int64_t step) const { return {id_, function, step, robot_}; }
  const std::string& id() const { return id_; }

  // Calls `function` of the plugin through the guard; logs the text of a DMRP_WARNING.
  template <class Function>
  CallGuard::Result call(const char* name, std::int64_t step, std::int64_t budget_ns, Function&& function) {
    const CallGuard::Result result = guard_.call(site(name, step), budget_ns, std::forward<Function>(function));
    if (result.status == DMRP_WARNING) log_(DMRP_LOG_WARNING, id_, guard_.error());
    return result;
  }

 private:
  std::string id_;
  std::int32_t robot_;
  CallGuard& guard_;
  LogSink log_;
  std::function<const void*(const char*)> extensions_;
  dmrp_host host_{};
  dmrp_plugin plugin_{};
};

}  // namespace dmrp::host
