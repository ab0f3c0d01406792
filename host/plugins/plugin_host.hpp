// SPDX-License-Identifier: MIT
// plugin_host.hpp: the dmrp_host of a library or an instance.
#pragma once

#include <dmrp/ext/timing.h>
#include <dmrp/host.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "host/plugins/calls/call_guard.hpp"
#include "host/plugins/grown_struct.hpp"

namespace dmrp::host {

// Receives the log lines of plugins, from any thread: level (DMRP_LOG_*), plugin id, text.
using LogSink = std::function<void(std::int32_t level, const std::string& plugin, const std::string& text)>;

// Its functions throw nothing, whatever the plugin passes and from whichever thread.
class PluginHost {
 public:
  // `id`: of the plugin, for log lines. `declared`: the extensions of its descriptor; others are not given. The guard
  // outlives this object. `grown_bytes`: by which the plugin's dmrp_host is longer than this host's.
  PluginHost(std::string id, const std::string& library_path, std::vector<std::string> declared, CallGuard& guard,
             LogSink log, std::uint32_t grown_bytes = 0);
  PluginHost(const PluginHost&) = delete;
  PluginHost& operator=(const PluginHost&) = delete;

  const dmrp_host* c() const { return &c_; }

  // Sets the function behind get_extension(), which returns nullptr for unknown ids. ext/timing.h needs no trial: it is
  // always there.
  void offer(std::function<const void*(const char* id)> extensions) { extensions_ = std::move(extensions); }

  void log(std::int32_t level, const std::string& text) const { log_(level, id_, text); }

 private:
  static PluginHost& of(const dmrp_host* host) { return *static_cast<PluginHost*>(host->context); }
  static PluginHost& of(const dmrp_timing* timing) { return *static_cast<PluginHost*>(timing->context); }
  const void* extension(const char* id);

  std::string id_;
  std::string library_path_;
  std::vector<std::string> declared_;
  CallGuard& guard_;
  LogSink log_;
  std::function<const void*(const char*)> extensions_;
  std::set<std::string> refused_;  // the undeclared extensions that it asked for
  GrownStruct<dmrp_host> host_;
  dmrp_host& c_ = host_.c;
  GrownStruct<dmrp_timing> timing_;
};

}  // namespace dmrp::host
