// SPDX-License-Identifier: MIT
// instance.hpp: a plugin instance.
#pragma once

#include <dmrp/plugin.h>

#include <functional>
#include <string>

#include "host/plugins/calls/call_guard.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/plugin_host.hpp"
#include "host/plugins/plugin_use.hpp"
#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {

class Instance {
 public:
  // Creates it. `robot` is the robot of a local controller, DMRP_NO_ROBOT otherwise. `grown_bytes`, a multiple of 8: by
  // which its dmrp_host, parameters and sinks are longer than this host's. Throws PluginFault.
  Instance(const Library& library, const PluginUse& use, std::int32_t robot, CallGuard& guard, LogSink log,
           std::uint32_t grown_bytes = 0);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Sets the function behind get_extension(), which returns nullptr for unknown ids. Call it before start().
  void offer(std::function<const void*(const char* id)> extensions) { host_.offer(std::move(extensions)); }

  // Begins a trial. Throws PluginFault.
  void start(const dmrp_world& world, std::uint64_t seed, std::int64_t budget_ns);

  // Ends a trial that had no fault. Throws PluginFault.
  void end_trial(const dmrp_trial_end& end, std::int64_t step, std::int64_t budget_ns);

  // The kind's function table; functions that an older plugin lacks are nullptr.
  template <class Table>
  Table table() const {
    return copy_struct(*static_cast<const Table*>(plugin_.table));
  }

  const dmrp_plugin& plugin() const { return plugin_; }
  dmrp_instance* self() const { return plugin_.self; }
  CallGuard& guard() const { return guard_; }
  CallSite site(const char* function, std::int64_t step) const { return {id_, function, step, robot_}; }
  const std::string& id() const { return id_; }
  std::uint32_t grown_bytes() const { return grown_bytes_; }

  // Calls `function` of the plugin through the guard; logs the text of a DMRP_WARNING. `answers`: the statuses that
  // the function may return besides success and errors.
  template <class Function>
  CallGuard::Result call(const char* name, std::int64_t step, std::int64_t budget_ns, Answers answers,
                         Function&& function) {
    const CallGuard::Result result =
        guard_.call(host_.c(), site(name, step), budget_ns, answers, std::forward<Function>(function));
    if (result.status == DMRP_WARNING) host_.log(DMRP_LOG_WARNING, guard_.error());
    return result;
  }

 private:
  std::string id_;
  std::int32_t robot_;
  CallGuard& guard_;
  std::uint32_t grown_bytes_;
  PluginHost host_;
  dmrp_plugin plugin_{};
};

}  // namespace dmrp::host
